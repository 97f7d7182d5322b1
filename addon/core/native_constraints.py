# SPDX-License-Identifier: GPL-3.0-or-later
"""From what a mesh's layers say to the constraints of native calls. Needs no Blender."""

from collections import defaultdict
from dataclasses import dataclass, field
from itertools import product

import numpy as np

from .edge_paths import common_edges, contour_edges
from .parameters import native_options
from .refusals import Refusal

_BESIDE = tuple(product((-1, 0, 1), repeat=3))  # a cell and those around it
_NO_FACES = np.empty(0, dtype=np.int32)


def _ids(*shape):
    return field(default_factory=lambda: np.empty(shape, dtype=np.int32))


class OutsideBand(Refusal):
    """Required vertices that lie where nothing is searched; the message is meant for the user."""

    def __init__(self, vertices):
        self.vertices = vertices
        noun = "vertex lies" if len(vertices) == 1 else "vertices lie"
        super().__init__(
            f"{len(vertices)} required {noun} outside the band that is searched: "
            "widen it, or take them out of the vertex group",
            vertices,
        )


@dataclass(frozen=True)
class Constraints:
    """What the layers of one mesh ask of its contours."""

    points: np.ndarray  # (V, 3)
    face_offsets: np.ndarray
    face_vertices: np.ndarray
    required: np.ndarray = _ids(0)  # vertex ids
    barriers: np.ndarray = _ids(0, 2)  # vertex pairs
    pulls: np.ndarray = _ids(0)  # a weight for each vertex, or nothing
    attracting: np.ndarray = _ids(0, 2)  # vertex pairs, edges whose vertices have weight 1
    strength: float = 0.0
    radius: float = 1.0  # of an attractor, in edge lengths of the given contours
    density: np.ndarray | None = None  # of each face
    region_strength: float = 0.0

    def keywords(self, mrc, surface, contours, options):
        """Keyword arguments of mrc.optimize_all for native contours; `options`: those of mrc.Options, as a dict.

        Marks along the given contours are not counted: they move with them. A contour in error is given nothing, and
        changes nothing for the others; the search says what is wrong with it. Raises OutsideBand.
        """
        found = {"barriers": self.barriers_beside(contours)}
        if len(self.required):
            bands = self._bands(mrc, surface, contours, options)
            found["required_vertices"] = assign(self.required, self.points, contours, bands)
        weights = self._weights(_edges(contours))
        if len(weights):
            found["attractors"] = self._attractors(mrc, surface, contours, weights, options)
        if self.density is not None:
            found["region_density"] = self.density
        # Painted constraints override min_salience; and the native weight is a cost.
        painted = len(weights) or self.density is not None
        changed = options | ({"min_salience": None} if painted else {})
        changed |= {"region_weight": -self.region_strength} if self.density is not None else {}
        return found | {"options": mrc.Options(**changed)}

    def barriers_beside(self, contours):
        """The barriers but those along the contours."""
        return _without(self.barriers, _edges(contours))

    def paints_the_right(self, mrc, surface, contour):
        """Whether what lies near a closed contour is painted more to its right than to its left."""
        assert self.density is not None
        faces, sides = mrc.band(surface, contour, options=mrc.Options(width=4), sides=True)
        right, left = (self.density[faces[sides == side]] for side in (-1, 1))
        return _mean(right) > _mean(left)

    def _attractors(self, mrc, surface, contours, weights, options):
        sound = [contour for contour in contours if mrc.check_contour(surface, contour) is None]
        if not sound:
            return ()
        length = np.concatenate([_lengths(self.points, contour) for contour in sound]).mean()
        near = np.unique(np.concatenate(self._bands(mrc, surface, sound, _of_all_iterations(options))))
        felt = near[weights[near] > 0]
        return attractors(self.points, felt, weights[felt], float(self.radius * length), self.strength)

    def _bands(self, mrc, surface, contours, options):
        """The vertices of the faces that are searched, for each contour by itself; none for one in error."""
        options, bands = mrc.Options(**options), []
        for contour in contours:
            in_error = mrc.check_contour(surface, contour) is not None
            faces = _NO_FACES if in_error else mrc.band(surface, contour, options=options)
            bands.append(np.unique(self._corners(faces)))
        return bands

    def _corners(self, faces):
        """The vertices of some faces, face by face."""
        counts = self.face_offsets[faces + 1] - self.face_offsets[faces]
        before = np.cumsum(counts) - counts
        shift = np.repeat(self.face_offsets[faces] - before, counts)
        return self.face_vertices[shift + np.arange(len(shift))]

    def _weights(self, edges):
        """The pull of each vertex, or nothing where there is none."""
        marked = _without(self.attracting, edges)
        if not len(marked):
            return self.pulls
        weights = self.pulls.copy() if len(self.pulls) else np.zeros(len(self.points))
        weights[marked.ravel()] = 1.0
        return weights


def native_keywords(mrc, surface, contours, settings, constraints=None):
    """Keyword arguments of mrc.optimize_all for settings of the table, and for Constraints where there are some.

    contours: native ones.
    """
    options = native_options(**settings)
    if constraints is None:
        return {"options": mrc.Options(**options)}
    return constraints.keywords(mrc, surface, contours, options)


def attractors(points, vertices, weights, radius, strength):
    """Rows (vertex, radius, strength) that together pull as strongly as the weights say, however dense the mesh is.

    Gaussians of sigma = radius / 2 (4.5) add up. So no vertex is kept within a sigma of one of more weight, and each is
    divided by the sum of what is felt there of those around it.
    """
    order = np.lexsort((vertices, -weights))
    kept = order[_apart(points[vertices[order]], radius / 2)]
    places = points[vertices[kept]]
    grid = _Grid(radius)
    for place in places:
        grid.add(place)
    rows = np.empty((len(kept), 3))
    for row, place, vertex, weight in zip(rows, places, vertices[kept], weights[kept]):
        squares = ((places[grid.near(place)] - place) ** 2).sum(axis=1)
        row[:] = vertex, radius, strength * weight / np.exp(-2 * squares[squares <= radius**2] / radius**2).sum()
    return rows


def assign(required, points, contours, bands):
    """The required vertices of each native contour: of those in whose band one lies, the nearest takes it."""
    taken, outside = [[] for _ in contours], []
    for vertex in required.tolist():
        able = [i for i, band in enumerate(bands) if vertex in band]
        distances = [np.linalg.norm(_positions(points, contours[i]) - points[vertex], axis=1).min() for i in able]
        if able:
            taken[able[int(np.argmin(distances))]].append(vertex)
        else:
            outside.append(vertex)
    if outside:
        raise OutsideBand(outside)
    return [np.array(vertices, dtype=np.int32) for vertices in taken]


def face_means(face_offsets, corner_values):
    """The mean over each face's corners."""
    if not len(corner_values):
        return np.zeros(len(face_offsets) - 1)
    return np.add.reduceat(corner_values, face_offsets[:-1]) / np.diff(face_offsets)


def _apart(points, distance):
    """The points, by their numbers, that are not within a distance of one that comes earlier and is kept."""
    grid, kept = _Grid(distance), []
    for index, point in enumerate(points):
        near = [kept[i] for i in grid.near(point)]
        if not near or (((points[near] - point) ** 2).sum(axis=1) > distance**2).all():
            kept.append(index)
            grid.add(point)
    return np.array(kept, dtype=int)


class _Grid:
    """Points, by the cells that they lie in: what lies within `reach` of a point is in its cell or one beside it."""

    def __init__(self, reach):
        self._size = 1.001 * reach or 1.0  # a little more, against rounding
        self._cells, self._count = defaultdict(list), 0

    def add(self, point):
        self._cells[self._cell(point)].append(self._count)
        self._count += 1

    def near(self, point):
        """At least the points within reach, by their numbers in ascending order."""
        x, y, z = self._cell(point)
        beside = ((x + i, y + j, z + k) for i, j, k in _BESIDE)
        return sorted(index for cell in beside if cell in self._cells for index in self._cells[cell])

    def _cell(self, point):
        return tuple((point // self._size).tolist())


def _edges(contours):
    """(n, 2) vertex pairs along native contours; -1 stands for points between vertices."""
    return np.concatenate([contour_edges(contour.vertices, contour.closed) for contour in contours])


def _positions(points, contour):
    (a, b), t = contour.edge_vertices.T, contour.edge_parameters[:, None]
    return (1 - t) * points[a] + t * points[b]


def _lengths(points, contour):
    """Of the segments from each point of a contour to the next."""
    places = _positions(points, contour)
    steps = np.roll(places, -1, axis=0) - places
    return np.linalg.norm(steps if contour.closed else steps[:-1], axis=1)


def _mean(values):
    return values.mean() if len(values) else 0.0


def _without(edges, others):
    """The (n, 2) edges that are not among the others, in either direction."""
    among = {frozenset(pair) for pair in common_edges(edges, others).tolist()}
    return edges[[frozenset(pair) not in among for pair in edges.tolist()]] if among else edges


def _of_all_iterations(options):
    """Options whose band reaches as far as the bands of all iterations together."""
    rounds = max(1, options["iterations"] + options["regular_iterations"])
    farther = {name: options[name] and options[name] * rounds for name in ("width", "band_distance")}
    return options | farther
