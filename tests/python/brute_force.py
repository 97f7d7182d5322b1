# SPDX-License-Identifier: GPL-3.0-or-later
"""The minimum ratio contour by enumeration, as an independent check of the native module.

It takes a mesh, a given closed contour and the options. The only input from the module is the increments of the flow on
the band. Everything else (scales, curvature, energy, admissible turns, levels, and the contours themselves) is computed
here, simply and slowly, from the equations of Clements (2006). It shares no code with the module, and is meant for
small meshes."""

from collections import defaultdict
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import pairwise
from math import acos, floor, inf, pi

import numpy as np

DEFAULTS = {
    "width": 4,
    "curvature_radius": 1.6,
    "curvature_smoothing": 1.0,
    "flow": "gates",
    "kappa0_factor": 3.0,
    "feature_exponent": 1.0,
    "direction_exponent": 1.0,
    "feature": "valley",
    "max_turn": pi / 2,
    "iterations": 1,
}
SIZE_RINGS = 4  # the scales are taken within this many edges of the contour,
SIZE_REACH = 7  # and this many times h
MOST_AREA = 3  # that a vertex counts with, in the square of its h
ENOUGH = 0.4  # of the angles at a vertex: the polygons up to there decide about its h
NOTHING = 1e-4  # curvatures below this / h count as 0, and principal curvatures that differ by less as umbilic
TURN_TOLERANCE = 1e-6
LEVEL = 1e-9  # vertices joined by an edge with a smaller increment are on one level


def edges_of(loop):
    return list(zip(loop, loop[1:] + loop[:1], strict=True))


def corners_of(loop):
    return list(zip(loop, loop[1:] + loop[:1], loop[2:] + loop[:2], strict=True))


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def sector(u, w, radius):
    return 0.5 * radius**2 * np.arctan2(cross(u, w), (u * w).sum(axis=-1))


def line_in_ball(p, q, radius):
    """The parameters between which the segments pq (rows, relative to the center) lie in a ball. Both are 0 or both 1
    where no part of a segment does."""
    d = q - p
    a, b, c = (d * d).sum(axis=-1), (p * d).sum(axis=-1), (p * p).sum(axis=-1) - radius**2
    root = b * b - a * c
    with np.errstate(divide="ignore", invalid="ignore"):
        half = np.sqrt(np.maximum(root, 0.0))
        first, last = (-b - half) / a, (-b + half) / a
    point = a == 0.0
    first = np.where(point, np.where(c < 0, 0.0, 1.0), first)
    last = np.where(point, 1.0, last)
    empty = root <= 0
    return np.where(empty & ~point, 0.0, np.clip(first, 0, 1)), np.where(empty & ~point, 0.0, np.clip(last, 0, 1))


def triangle_content(p, q, weight):
    """The signed integral of a weight, quadratic in the point, over the triangles 0, p, q: by their sides' middles."""
    return 0.5 * cross(p, q) * (weight(0.5 * p) + weight(0.5 * q) + weight(0.5 * (p + q))) / 3


def content_in_disk(corners, reach, radius):
    """The integral of 1 - d^2 / radius^2 over flat triangles (n, 3, 2) inside disks of the given reaches (n) around the
    origin, where d is the distance from a point above it, the center of a ball that meets the plane in that disk. An
    infinite radius gives the area. It is the sum of signed sectors outside the disk and triangles inside."""
    if np.isinf(radius):
        return area_of_parts(corners, reach, lambda p, q: 0.5 * cross(p, q), lambda p, q: sector(p, q, reach))

    def weight(x):
        return (reach**2 - (x * x).sum(axis=-1)) / radius**2

    def part(p, q):
        return sector(p, q, reach) * 0.5 * reach**2 / radius**2

    return area_of_parts(corners, reach, lambda p, q: triangle_content(p, q, weight), part)


def area_of_parts(corners, radius, triangle, sector):
    total = np.zeros(len(corners))
    for i in range(3):
        p, q = corners[:, i], corners[:, (i + 1) % 3]
        start, end = line_in_ball(p, q, radius)
        enter, leave = p + start[:, None] * (q - p), p + end[:, None] * (q - p)
        inside = end > start
        # No sector at an end inside the disk: at the origin, rounding would give it an arbitrary angle.
        before = np.where(start > 0, sector(p, enter), 0.0)
        after = np.where(end < 1, sector(leave, q), 0.0)
        within = before + triangle(enter, leave) + after
        total += np.where(inside, within, sector(p, q))
    return np.abs(total)


def area_in_ball(corners, radius, soft):
    """The area of triangles in space (n, 3, 3) inside a ball around the origin; soft: each part times
    1 - d^2 / radius^2."""
    side, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(side, other)
    size = np.linalg.norm(normal, axis=1)
    result = np.zeros(len(corners))
    proper = size > 0
    corners, side, normal = corners[proper], side[proper], normal[proper] / size[proper, None]
    x_axis = side / np.linalg.norm(side, axis=1, keepdims=True)
    y_axis = np.cross(normal, x_axis)
    height = (normal * corners[:, 0]).sum(axis=1)
    flat = np.stack([np.einsum("nij,nj->ni", corners, x_axis), np.einsum("nij,nj->ni", corners, y_axis)], axis=-1)
    reach = np.sqrt(np.maximum(radius**2 - height**2, 0.0))
    met = reach > 0
    result[np.flatnonzero(proper)[met]] = content_in_disk(flat[met], reach[met], radius if soft else inf)
    return result


class Geometry:
    """The adjacency, lengths, normals and areas of a mesh."""

    def __init__(self, mesh):
        self.mesh, self.x = mesh, mesh.positions
        self.face_edges = [edges_of(face) for face in mesh.faces]
        self.left_face = {edge: i for i, edges in enumerate(self.face_edges) for edge in edges}
        self.neighbors = defaultdict(dict)
        for edges in self.face_edges:
            for a, b in edges:
                self.neighbors[a][b] = self.neighbors[b][a] = float(np.linalg.norm(self.x[a] - self.x[b]))
        self._polygons()
        self._triangles()

    def _polygons(self):
        """Vertex areas: each polygon's area divided equally among its vertices. Vertex normals: polygon normals
        weighted by corner angle."""
        self.area, self.normal = np.zeros(len(self.x)), np.zeros((len(self.x), 3))
        self.corners, self._scale = defaultdict(list), {}
        for face in self.mesh.faces:
            p = self.x[list(face)]
            ahead, behind = np.roll(p, -1, axis=0) - p, np.roll(p, 1, axis=0) - p
            vector_area = 0.5 * np.cross(p, np.roll(p, -1, axis=0)).sum(axis=0)
            size = np.linalg.norm(vector_area)
            angles = np.arctan2(np.linalg.norm(np.cross(ahead, behind), axis=1), (ahead * behind).sum(axis=1))
            for v, angle in zip(face, angles, strict=True):
                self.corners[v].append((face, angle))
                if size == 0:
                    continue
                self.area[v] += size / len(face)
                self.normal[v] += angle * vector_area / size
        lengths = np.linalg.norm(self.normal, axis=1, keepdims=True)
        self.normal = np.divide(self.normal, lengths, out=np.zeros_like(self.normal), where=lengths > 0)

    def _triangles(self):
        """The triangulated surface: the triangles at each vertex and edge, and the signed bend of each edge."""
        self.triangles = [tuple(map(int, t)) for t in self.mesh.triangles]
        self.at_vertex, self.at_edge = defaultdict(list), defaultdict(list)
        for i, (a, b, c) in enumerate(self.triangles):
            for v in (a, b, c):
                self.at_vertex[v].append(i)
            for edge in ((a, b), (b, c), (c, a)):
                self.at_edge[tuple(sorted(edge))].append((i, edge))
        self.edge_ends = np.array(list(self.at_edge))
        corners = self.x[np.array(self.triangles)]
        vectors = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.bend = {edge: self._bend(pair, vectors) for edge, pair in self.at_edge.items()}

    def _bend(self, pair, vectors):
        """beta of eq. 3.4: the signed angle between the normals of the two triangles, positive where convex."""
        if len(pair) != 2:
            return 0.0
        (one, (a, b)), (two, _) = pair
        n1, n2 = vectors[one], vectors[two]
        along = self.x[b] - self.x[a]
        length = np.linalg.norm(along)
        if not n1.any() or not n2.any() or length == 0:
            return 0.0
        return float(np.arctan2(np.cross(n1, n2) @ along / length, n1 @ n2))

    def distances(self, sources, limit=inf):
        """Lengths of shortest paths along real edges."""
        found, queue = {}, [(0.0, int(v)) for v in sources]
        while queue:
            d, v = heappop(queue)
            if v in found:
                continue
            found[v] = d
            for w, length in self.neighbors[v].items():
                if w not in found and d + length <= limit:
                    heappush(queue, (d + length, w))
        return found

    def rings(self, sources, count):
        """The vertices at most `count` real edges from the sources."""
        seen = front = set(map(int, sources))
        for _ in range(count):
            front = {w for v in front for w in self.neighbors[v]} - seen
            seen = seen | front
        return seen

    def extent(self, face):
        """How wide a polygon is across, from the moments of its corners, the roots of a polynomial of which their sum
        and product are known: their product is, by the area, that of a triangle or of a rectangle."""
        p = self.x[list(face)]
        trace = ((p - p.mean(axis=0)) ** 2).sum() / len(p)
        area = np.linalg.norm(0.5 * np.cross(p, np.roll(p, -1, axis=0)).sum(axis=0))
        factor, product = (6, 4 * area**2 / 27) if len(face) == 3 else (4, area**2 / 16)
        moments = np.roots([1.0, -trace, min(product, trace**2 / 4)]).real
        size = np.sqrt((moments**2).sum())
        return np.sqrt(factor * moments.prod() / size) if size > 0 else 0.0

    def own_scale(self, v):
        """The extent up to which the polygons at a vertex, from narrow to wide, have 40 % of its angle."""
        found = sorted((self.extent(face), angle) for face, angle in self.corners[v])
        found = [(extent, angle) for extent, angle in found if extent > 0]
        whole, sum_ = sum(angle for _, angle in found), 0.0
        for extent, angle in found:
            sum_ += angle
            if sum_ >= ENOUGH * whole * (1 - 1e-12):
                return extent
        lengths = [d for d in self.neighbors[v].values() if d > 0]
        return sum(lengths) / len(lengths) if lengths else 0.0

    def scale(self, v, passes=2):
        """The local scale h: what the polygons say, averaged twice over neighbors."""
        if (v, passes) not in self._scale:
            self._scale[v, passes] = self.own_scale(v) if passes == 0 else self._mean_scale(v, passes - 1)
        return self._scale[v, passes]

    def _mean_scale(self, v, passes):
        own = self.scale(v, passes)
        weights = {w: min(1.0, own / d) ** 2 if own * d > 0 else 1.0 for w, d in self.neighbors[v].items()}
        parts = [(1.0, own)] + [(weight, self.scale(w, passes)) for w, weight in weights.items()]
        parts = [(weight, h) for weight, h in parts if h > 0]
        return sum(weight * h for weight, h in parts) / sum(weight for weight, _ in parts) if parts else 0.0

    def near(self, contour, distances, h):
        """Where the scales of a contour are taken."""
        return {v for v in self.rings(contour, SIZE_RINGS) if distances[v] <= SIZE_REACH * h}

    def counted_area(self, v):
        return min(self.area[v], MOST_AREA * self.scale(v) ** 2)

    def disk_tensor(self, v, radius, soft):
        """Eq. 3.4 at a vertex. The disk B is the part of the triangulated surface inside the ball that is connected to
        the vertex; soft: with the weight 1 - d^2 / radius^2, where d is the distance from the vertex."""
        center = self.x[v]
        start, end = line_in_ball(*(self.x[self.edge_ends] - center).transpose(1, 0, 2), radius)
        inside = end - start
        if soft:
            p, q = self.x[self.edge_ends].transpose(1, 0, 2) - center
            gauss = [0.5 * (start + end) + sign * (end - start) / np.sqrt(12) for sign in (-1, 1)]
            at = [p + t[:, None] * (q - p) for t in gauss]
            inside = inside * (1 - 0.5 * sum((x * x).sum(axis=1) for x in at) / radius**2)
        fractions = dict(zip(self.at_edge, inside.tolist(), strict=True))
        seen, stack, met = set(self.at_vertex[v]), list(self.at_vertex[v]), {}
        while stack:
            a, b, c = self.triangles[stack.pop()]
            for edge in ((a, b), (b, c), (c, a)):
                edge = tuple(sorted(edge))
                if edge in met:
                    continue
                met[edge] = fractions[edge]
                if met[edge] > 0:
                    fresh = [i for i, _ in self.at_edge[edge] if i not in seen]
                    seen.update(fresh)
                    stack += fresh
        tensor = np.zeros((3, 3))
        for edge, fraction in met.items():
            d = self.x[edge[1]] - self.x[edge[0]]
            if fraction > 0 and d.any():
                tensor += self.bend[edge] * fraction * np.outer(d, d) / np.linalg.norm(d)
        corners = self.x[np.array([self.triangles[i] for i in sorted(seen)])] - center if seen else np.zeros((0, 3, 3))
        area = area_in_ball(corners, radius, soft).sum()
        return tensor / area if area > 0 else tensor * 0.0


@dataclass
class Curvature:
    kappa_min: float
    kappa_max: float
    direction_min: np.ndarray
    direction_max: np.ndarray


class Curvatures:
    """Principal curvatures and directions (thesis 3.4), computed on demand.

    Smoothing widens the disk, in which nearer parts then count for more: it has the second moment of the disk convolved
    with the Gaussian."""

    def __init__(self, geometry, options):
        self.geometry, self.soft = geometry, options["curvature_smoothing"] > 0
        self.radius = options["curvature_radius"]
        if self.soft:
            variance = self.radius**2 / 4 + options["curvature_smoothing"] ** 2  # along each axis
            self.radius = np.sqrt(6 * variance)
        self._found = {}

    def tensor(self, v):
        return self.geometry.disk_tensor(v, self.radius * self.geometry.scale(v), self.soft)

    def __getitem__(self, v):
        if v not in self._found:
            normal = self.geometry.normal[v]
            x_axis = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
            x_axis /= np.linalg.norm(x_axis)
            basis = np.stack([x_axis, np.cross(normal, x_axis)])
            values, vectors = np.linalg.eigh(basis @ self.tensor(v) @ basis.T)
            directions = vectors.T @ basis
            # The eigenvector of beta e e^T is along the crease, but its curvature is the one across it: swap them.
            self._found[v] = Curvature(values[0], values[1], directions[1], directions[0])
        return self._found[v]


class Energy:
    """Scales at the given contour, and eq. 3.1 and 3.2 for a pair of directed edges."""

    def __init__(self, mesh, contour, options):
        self.options = {**DEFAULTS, **options}
        self.geometry = Geometry(mesh)
        self.ridge = self.options["feature"] == "ridge"
        contour = [int(v) for v in contour]
        scale, sizes = self.geometry.scale, [(a, b, self.geometry.neighbors[a][b]) for a, b in edges_of(contour)]
        self.length = sum(size for _, _, size in sizes)
        self.h = sum(size * (scale(a) + scale(b)) / 2 for a, b, size in sizes) / self.length
        near = self.geometry.near(contour, self.geometry.distances(contour), self.h)
        self.curvatures = Curvatures(self.geometry, self.options)
        area = sum(self.geometry.counted_area(v) for v in near)
        mean = sum(self.geometry.counted_area(v) * abs(self.feature_curvature(v)) for v in near) / area
        self.scale = max(mean, 0.01 / self.length)
        self.kappa_0 = self.options["kappa0_factor"] * self.scale

    def feature_curvature(self, v):
        """kappa_min, or -kappa_max for ridges: negative where there is a feature. Tiny values count as 0."""
        kappa = -self.curvatures[v].kappa_max if self.ridge else self.curvatures[v].kappa_min
        return kappa if abs(kappa) >= NOTHING / self.geometry.scale(v) else 0.0

    def projected(self, a, b, v):
        """The edge ab projected onto the tangent plane of v."""
        normal, edge = self.geometry.normal[v], self.geometry.x[b] - self.geometry.x[a]
        return edge - (edge @ normal) * normal

    def turn(self, a, b, c):
        one, two = self.projected(a, b, b), self.projected(b, c, b)
        size = np.linalg.norm(one) * np.linalg.norm(two)
        return acos(np.clip(one @ two / size, -1, 1)) if size > 0 else 0.0

    def admissible(self, a, b, c):
        return self.turn(a, b, c) <= self.options["max_turn"] + TURN_TOLERANCE

    def cosine(self, projected, direction):
        size = np.linalg.norm(projected) * np.linalg.norm(direction)
        c = projected @ direction / size if size > 0 else 0.0
        return np.sign(c) * abs(c) ** self.options["direction_exponent"]

    def arc(self, a, b, c):
        """(f, g) of the arc from ab to bc."""
        lengths = self.geometry.neighbors[a][b], self.geometry.neighbors[b][c]
        one, two = self.projected(a, b, b), self.projected(b, c, b)
        here = self.curvatures[b]
        direction = here.direction_min if self.ridge else here.direction_max
        if here.kappa_max - here.kappa_min < NOTHING / self.geometry.scale(b):
            direction = one + two
        along = abs(lengths[0] * self.cosine(one, direction) + lengths[1] * self.cosine(two, direction))
        g = 0.5 * sum(lengths)
        kappa = self.feature_curvature(b)
        if kappa < 0:
            return -0.5 * self.scale * (abs(kappa) / self.scale) ** self.options["feature_exponent"] * along, g
        return 0.5 * self.kappa_0 * (sum(lengths) - along), g

    def sums(self, contour):
        contour = [int(v) for v in contour]
        arcs = [self.arc(*corner) for corner in corners_of(contour)]
        return sum(f for f, _ in arcs), sum(g for _, g in arcs)

    def ratio(self, contour):
        f, g = self.sums(contour)
        return f / g


def signed_ranks(geometry, contour, band_faces):
    """The distance from the contour along real edges, positive on its left, which is flooded from the faces there."""
    contour = [int(v) for v in contour]
    distance = geometry.distances(contour)
    fence = set(edges_of(contour))
    band = set(map(int, band_faces))
    stack = [geometry.left_face[edge] for edge in fence if geometry.left_face.get(edge) in band]
    left = set(stack)
    while stack:
        for a, b in geometry.face_edges[stack.pop()]:
            other = geometry.left_face.get((b, a))
            if other in band and other not in left and (a, b) not in fence and (b, a) not in fence:
                left.add(other)
                stack.append(other)
    on_left = {v for face in left for v in geometry.mesh.faces[face]}
    return {v: d if v in on_left else -d for v, d in distance.items()}


class Levels:
    """The flow on the band as values modulo 1, one for each class of vertices joined by level real edges."""

    def __init__(self, geometry, space):
        self.real = {}
        links = defaultdict(dict)
        for (a, b), increment in zip(space["edges"].tolist(), space["increments"].tolist(), strict=True):
            links[a][b], links[b][a] = increment, -increment
            if b in geometry.neighbors[a]:
                self.real[a, b], self.real[b, a] = increment, -increment
        self._classes()
        value = self._values(links)
        sums = defaultdict(list)
        for v, name in self.name.items():
            sums[name].append(value[v])
        # Members differ by rounding errors: measure them from the first, so that none wraps around from 1 to 0.
        mean = {name: of[0] + sum(self.nearest(x - of[0]) for x in of) / len(of) for name, of in sums.items()}
        self.value = {v: mean[self.name[v]] for v in value}
        self._increments(value)

    @staticmethod
    def nearest(x):
        return x - round(x)

    def _classes(self):
        level = defaultdict(list)
        for (a, b), increment in self.real.items():
            level[a] += [b] if abs(increment) < LEVEL else []
        self.name = {}
        for start in sorted(level):
            stack = [] if start in self.name else [start]
            while stack:
                v = stack.pop()
                if v not in self.name:
                    self.name[v] = start
                    stack += level[v]

    @staticmethod
    def _values(links):
        start = min(links)
        value, stack = {start: 0.0}, [start]
        while stack:
            v = stack.pop()
            for w, increment in links[v].items():
                if w not in value:
                    value[w] = value[v] + increment
                    stack.append(w)
        return value

    def _increments(self, value):
        """Sets increments to the differences of class values; an edge inside a class is level."""
        for a, b in list(self.real):
            shift = self.nearest(self.value[b] - value[b]) - self.nearest(self.value[a] - value[a])
            self.real[a, b] = 0.0 if self.name[a] == self.name[b] else self.real[a, b] + shift


class BruteForce:
    """Every closed contour of the regular graph, by depth-first search over its nodes."""

    def __init__(self, mesh, contour, options, space):
        self.energy = Energy(mesh, contour, options)
        self.given = [int(v) for v in contour]
        self.levels = Levels(self.energy.geometry, space)
        self.rank = signed_ranks(self.energy.geometry, contour, space["faces"])
        self._nodes()
        self._arcs()

    def _nodes(self):
        """Directed edges: (a, b, kind), kind 0 where the flow rises, 1 and -1 where only the rank rises or falls."""
        self.nodes = []
        tiny = 1e-12 * self.energy.length
        faces = self.energy.geometry.left_face
        for (a, b), increment in self.levels.real.items():
            if (a, b) not in faces or (b, a) not in faces:  # on the mesh border, where no contour runs
                continue
            climb = self.rank[b] - self.rank[a]
            if self.levels.name[a] == self.levels.name[b]:
                if abs(climb) > tiny:
                    self.nodes.append((a, b, 1 if climb > 0 else -1))
            elif increment > 0:
                self.nodes.append((a, b, 0))

    def _arcs(self):
        given = set(corners_of(self.given))
        leaving = defaultdict(list)
        for i, (a, _, _) in enumerate(self.nodes):
            leaving[a].append(i)
        self.arcs = defaultdict(list)
        for i, (a, b, kind) in enumerate(self.nodes):
            for j in leaving[b]:
                _, c, next_kind = self.nodes[j]
                opposed = kind * next_kind == -1
                if c != a and not opposed and ((a, b, c) in given or self.energy.admissible(a, b, c)):
                    self.arcs[i].append((j, *self.energy.arc(a, b, c)))

    def crossing(self):
        """The nodes that cross one level through no vertex: the level in the middle of the widest gap."""
        values = sorted({value - floor(value) for value in self.levels.value.values()})
        gaps = [(following - value, value) for value, following in pairwise([*values, values[0] + 1])]
        gap, value = max(gaps)
        level = value + gap / 2
        passed = {v: floor(x - level) for v, x in self.levels.value.items()}
        return [
            i
            for i, (a, b, kind) in enumerate(self.nodes)
            if kind == 0 and floor(self.levels.value[a] + self.levels.real[a, b] - level) > passed[a]
        ]

    def cycles(self):
        """All closed contours: (vertices, sum of f, sum of g)."""
        sources = set(self.crossing())
        for source in sorted(sources):
            useful = reaching(self.arcs.items(), [source], sources)
            stack = [(source, (self.nodes[source][0],), 0.0, 0.0)]
            while stack:
                node, path, f, g = stack.pop()
                for following, arc_f, arc_g in self.arcs[node]:
                    if following == source:
                        yield path, f + arc_f, g + arc_g
                    elif following in useful:
                        stack.append((following, (*path, self.nodes[following][0]), f + arc_f, g + arc_g))

    def count(self):
        """The number of closed contours, by dynamic programming, to decide whether enumeration is affordable."""
        sources = set(self.crossing())
        return sum(self._count_paths(source, source, sources, {}) for source in sources)

    def _count_paths(self, node, source, sources, known):
        if node not in known:
            ends = [j for j, _, _ in self.arcs[node]]
            known[node] = ends.count(source) + sum(
                self._count_paths(j, source, sources, known) for j in ends if j not in sources
            )
        return known[node]

    def best(self):
        """(ratio, vertices, status) of the best contour, including the given one."""
        given_ratio = self.energy.ratio(self.given)
        found = min(((f / g, path) for path, f, g in self.cycles()), default=(inf, ()))
        if found[0] < given_ratio and not same_cycle(found[1], self.given):
            return found[0], found[1], "improved"
        return given_ratio, tuple(self.given), "unchanged"


def reaching(arcs, goals, stops):
    """The nodes from which a goal can be reached without passing a stop; arcs: pairs of a node and its successors."""
    before = defaultdict(list)
    for i, following in arcs:
        for j, _, _ in following:
            before[j].append(i)
    seen, stack = set(), list(goals)
    while stack:
        for i in before[stack.pop()]:
            if i not in seen and i not in stops:
                seen.add(i)
                stack.append(i)
    return seen


def same_cycle(one, two):
    """Whether two closed contours have the same vertices in the same order and direction."""
    one, two = [int(v) for v in one], [int(v) for v in two]
    if len(one) != len(two) or set(one) != set(two):
        return False
    start = two.index(one[0])
    return one == two[start:] + two[:start]
