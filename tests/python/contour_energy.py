# SPDX-License-Identifier: GPL-3.0-or-later
"""The energy of contours through vertices and Steiner points, closed or open, with all its terms: eq. 3.1 to 3.3 and
what the options add, computed simply from the mesh. It shares no code with the module.

A point is (a, b, n) with a < b: the point at the fraction n / UNITS of the edge from a to b. A vertex is (v, v, 0).
"""

from itertools import pairwise
from math import acos, ceil, exp, inf, pi, sin

import numpy as np
from brute_force import DEFAULTS, NOTHING, TURN_TOLERANCE, Curvatures, Geometry, edges_of

EXTRA = {
    "refinement": 0,
    "anchor": 0.0,
    "feature_clamp": None,
    "crease": 0.0,
    "length_bias": 0.0,
    "length_floor": 0.0,
    "length_measure": "arc",
    "denominator": "length",
    "ends": "edges",
    "region_weight": 0.0,
    "region_side": "left",
}


UNITS = 5040  # of an edge: divisible by every number up to ten


def vertex(v):
    return int(v), int(v), 0


def point_on(a, b, t):
    """The canonical form of the point (1 - t) a + t b."""
    a, b, n = int(a), int(b), round(t * UNITS)
    assert abs(t * UNITS - n) < 1e-6, "not an equally spaced point"
    if a == b or n == 0:
        return vertex(a)
    if n == UNITS:
        return vertex(b)
    return (a, b, n) if a < b else (b, a, UNITS - n)


def points_of(result):
    """The points of a result from the module."""
    pairs = zip(result.edge_vertices.tolist(), result.edge_parameters.tolist(), strict=True)
    return [point_on(a, b, t) for (a, b), t in pairs]


def with_steiner_points(points, closed, k):
    """The same curve, with all k equally spaced points of the edges that it runs along."""
    path = [*points, points[0]] if closed else list(points)
    dense = []
    for p, q in pairwise(path):
        dense.append(p)
        edge = edge_of(p, q)
        if edge is None:
            continue
        start, end = parameter(p, *edge), parameter(q, *edge)
        between = [i * UNITS // (k + 1) for i in range(1, k + 1)]
        inner = [t for t in between if min(start, end) < t < max(start, end)]
        dense += [point_on(*edge, t / UNITS) for t in sorted(inner, reverse=start > end)]
    return dense if closed else [*dense, path[-1]]


def parameter(point, a, b):
    """The parameter of a point on its edge ab."""
    if point[0] == point[1]:
        return 0 if point[0] == a else UNITS
    return point[2] if (a, b) == point[:2] else UNITS - point[2]


def edge_of(p, q):
    """The edge that a chord lies on, as a sorted pair, or None."""
    ends = {p[0], p[1]} | {q[0], q[1]}
    return tuple(sorted(ends)) if len(ends) == 2 else None


class Enclosed:
    """How much more a closed contour of a band encloses on its left than the given one does (6.1.2).

    It is the integral of a 1-form on the edges of the band, found by least squares. Its circulation around each
    triangle is the content of the triangle: its part of the area of its polygon times the density. Along the given
    contour it sums to 0.
    """

    def __init__(self, geometry, triangles, edges, density, given):
        self.content = {frozenset(t): (t, content) for t, content in self.contents(geometry, triangles, density)}
        self.number = {edge: i for i, edge in enumerate(dict.fromkeys(tuple(sorted(edge)) for edge in edges))}
        rows, held = [], []
        for triangle, content in self.content.values():
            rows.append(self._row([(vertex(a), vertex(b)) for a, b in edges_of(triangle)]))
            held.append(content)
        rows.append(self._row(list(pairwise([*given, given[0]]))))
        held.append(0.0)
        self.form, *_ = np.linalg.lstsq(np.array(rows), np.array(held), rcond=None)
        assert np.allclose(np.array(rows) @ self.form, held, atol=1e-12), "the band is not an annulus"

    @staticmethod
    def contents(geometry, triangles, density):
        by_corners = {frozenset(t) for t in triangles}
        starts = np.cumsum([0] + [len(face) - 2 for face in geometry.mesh.faces])
        for i, face in enumerate(geometry.mesh.faces):
            x = geometry.x[list(face)]
            polygon = np.linalg.norm(0.5 * np.cross(x, np.roll(x, -1, axis=0)).sum(axis=0))
            own = geometry.triangles[starts[i] : starts[i + 1]]
            sizes = [np.linalg.norm(np.cross(*(geometry.x[[b, c]] - geometry.x[a]))) for a, b, c in own]
            for triangle, size in zip(own, sizes, strict=True):
                if frozenset(triangle) in by_corners:
                    yield triangle, density[i] * polygon * size / sum(sizes)

    def _row(self, chords):
        row = np.zeros(len(self.number))
        for p, q in chords:
            edge = edge_of(p, q)
            row[self.number[edge]] += (parameter(q, *edge) - parameter(p, *edge)) / UNITS
        return row

    def _from(self, corner, other, fraction):
        sign = 1 if corner < other else -1
        return sign * fraction * self.form[self.number[tuple(sorted((corner, other)))]]

    def along(self, p, q):
        """Along an edge the form is constant. A chord across a triangle cuts off a corner: by Stokes' theorem, its
        integral is that along the path around the corner plus the content of the corner."""
        edge = edge_of(p, q)
        if edge is not None:
            return (parameter(q, *edge) - parameter(p, *edge)) / UNITS * self.form[self.number[edge]]
        corner = min(set(p[:2]) & set(q[:2]), default=q[0] if p[2] == 0 else p[0])
        (x, s), (y, t) = self._off(corner, p), self._off(corner, q)
        triangle, content = self.content[frozenset((corner, x, y))]
        sign = 1 if (y, x) in edges_of(triangle) else -1  # the path around the corner runs from p to the corner to q
        return self._from(corner, y, t) - self._from(corner, x, s) - sign * content * s * t

    @staticmethod
    def _off(corner, p):
        """The other end of the edge from a corner through p, and how far along it p lies."""
        if p[0] == p[1]:
            return p[0], 1.0
        other = p[1] if p[0] == corner else p[0]
        return other, parameter(p, corner, other) / UNITS


class PointEnergy:
    """Scales at the given contour, and f and g of any arc."""

    def __init__(self, mesh, given, closed=True, options=None, attractors=()):
        self.options = {**DEFAULTS, **EXTRA, **(options or {})}
        self.geometry = Geometry(mesh)
        self.ridge = self.options["feature"] == "ridge"
        self.given, self.closed = list(given), closed
        self.along_edges = all(edge_of(p, q) is not None for p, q in self.segments(self.given))
        self.known, self.halves, self.enclosed = {}, {}, None
        self._fields(attractors)
        self._scales()

    def _scales(self):
        geometry = self.geometry
        sizes = [(p, q, self.size(p, q)) for p, q in self.segments(self.given)]
        self.L0 = sum(size for _, _, size in sizes)
        local = [size * (self.linear(p, geometry.scale) + self.linear(q, geometry.scale)) / 2 for p, q, size in sizes]
        self.h = sum(local) / self.L0
        near = geometry.near({v for p in self.given for v in p[:2]}, self.from_given, self.h)
        self.curvatures = Curvatures(geometry, self.options)
        area = sum(geometry.counted_area(v) for v in near)
        mean = sum(geometry.counted_area(v) * abs(self._unclamped(v)) for v in near) / area
        self.K = max(mean, 0.01 / self.L0)
        self.kappa_0 = self.options["kappa0_factor"] * self.K
        self.n0 = len(self.segments(with_steiner_points(self.given, self.closed, self.options["refinement"])))
        self.clamp = inf
        values = sorted(-self._unclamped(v) for v in near if self._unclamped(v) < 0)
        if self.options["feature_clamp"] is not None and values:
            self.clamp = values[ceil(self.options["feature_clamp"] * len(values)) - 1]

    def _fields(self, attractors):
        """Distances along real edges, known at vertices and linear inside an edge."""
        starts = {}
        for p in self.given:
            for v in p[:2]:
                offset = np.linalg.norm(self.position(p) - self.geometry.x[v])
                starts[v] = min(starts.get(v, inf), float(offset))
        self.from_given = self._distances(starts)
        self.attractors = []
        for v, radius, strength, *sigma in attractors:
            self.attractors.append((self._distances({v: 0.0}), radius, strength, sigma[0] if sigma else radius / 2))

    def _distances(self, starts):
        best = {}
        for v, ahead in starts.items():
            for w, d in self.geometry.distances([v]).items():
                best[w] = min(best.get(w, inf), ahead + d)
        return best

    def segments(self, points):
        return list(pairwise([*points, points[0]] if self.closed else points))

    def position(self, p):
        t = p[2] / UNITS
        return (1 - t) * self.geometry.x[p[0]] + t * self.geometry.x[p[1]]

    def size(self, p, q):
        return float(np.linalg.norm(self.position(q) - self.position(p)))

    def _unclamped(self, v):
        """kappa_min, or -kappa_max for ridges: negative where there is a feature. Tiny values count as 0."""
        kappa = -self.curvatures[v].kappa_max if self.ridge else self.curvatures[v].kappa_min
        return kappa if abs(kappa) >= NOTHING / self.geometry.scale(v) else 0.0

    def linear(self, p, at_vertex):
        t = p[2] / UNITS
        return at_vertex(p[0]) if t == 0 else (1 - t) * at_vertex(p[0]) + t * at_vertex(p[1])

    def __getitem__(self, p):
        """(normal, feature curvature, direction or None, additional cost per unit of length) at a point."""
        if p not in self.known:
            normal = self.linear(p, lambda v: self.geometry.normal[v])
            normal = normal / np.linalg.norm(normal)
            kappa = self.linear(p, lambda v: max(self._unclamped(v), -self.clamp))
            self.known[p] = normal, kappa, self._direction(p, normal), self._additional_cost(p)
        return self.known[p]

    def _direction(self, p, normal):
        spread = self.linear(p, lambda v: self.curvatures[v].kappa_max - self.curvatures[v].kappa_min)
        if spread < NOTHING / self.h:
            return None
        tangent = np.eye(3) - np.outer(normal, normal)
        _, vectors = np.linalg.eigh(tangent @ self.linear(p, self._projector) @ tangent)
        return vectors[:, 2]

    def _projector(self, v):
        here = self.curvatures[v]
        if here.kappa_max - here.kappa_min < NOTHING / self.geometry.scale(v):
            normal = self.geometry.normal[v]
            return (np.eye(3) - np.outer(normal, normal)) / 2
        direction = here.direction_min if self.ridge else here.direction_max
        return np.outer(direction, direction)

    def _additional_cost(self, p):
        """Anchor minus attractors, per unit of length."""
        away = self.linear(p, self.from_given.__getitem__) / (self.L0 / (2 * pi))
        total = self.options["anchor"] * self.K * away**2
        for distance, radius, strength, sigma in self.attractors:
            d = self.linear(p, lambda v, distance=distance: distance.get(v, inf))
            if d <= radius:
                total -= strength * self.K * exp(-(d**2) / (2 * sigma**2))
        return total

    def weigh_region(self, space, density):
        """Adds the region term for contours of this band."""
        triangles, edges = map(tuple, space["triangles"].tolist()), map(tuple, space["edges"].tolist())
        self.enclosed = Enclosed(self.geometry, triangles, edges, density, self.given)

    def region_factor(self):
        side = 1 if self.options["region_side"] == "left" else -1
        return side * self.options["region_weight"] * self.K / self.L0

    def crease_weight(self, p, q):
        edge = edge_of(p, q)
        if edge is None or edge[1] not in self.geometry.neighbors[edge[0]]:
            return 1.0
        return min(3.0, exp(3 * sin(self.geometry.bend[edge])))

    def projected(self, p, q, normal):
        edge = self.position(q) - self.position(p)
        return edge - (edge @ normal) * normal

    def half(self, q, p, r):
        """For the chord pr at its end q: its projection, the direction of that, its length, its length times the
        cosine, and its crease term."""
        if (q, p, r) not in self.halves:
            normal, _, direction, _ = self[q]
            edge = self.projected(p, r, normal)
            size, projected = self.size(p, r), np.linalg.norm(edge)
            unit = edge / projected if projected > 0 else np.zeros(3)
            along = None if direction is None else size * self.power(unit @ direction)
            self.halves[q, p, r] = edge, unit, size, along, size * self.crease_weight(p, r)
        return self.halves[q, p, r]

    def power(self, cosine):
        return np.sign(cosine) * abs(cosine) ** self.options["direction_exponent"]

    def admissible(self, p, q, r):
        """Rule 2 of section 3.2, in the tangent plane."""
        one, two = self.half(q, p, q)[1], self.half(q, q, r)[1]
        turn = acos(min(max(float(one @ two), -1.0), 1.0)) if one.any() and two.any() else 0.0
        return turn <= self.options["max_turn"] + TURN_TOLERANCE

    def at_point(self, q, chords):
        """(f, g) of the halves of one or two chords that meet at q."""
        _, kappa, direction, besides = self[q]
        halves = [self.half(q, *chord) for chord in chords]
        length = sum(half[2] for half in halves)
        if direction is None:
            total = sum(half[0] for half in halves)
            total = total / max(np.linalg.norm(total), 1e-300)
            along = abs(sum(half[2] * self.power(half[1] @ total) for half in halves))
        else:
            along = abs(sum(half[3] for half in halves))
        if kappa < -NOTHING / self.h:
            f = -0.5 * self.K * (abs(kappa) / self.K) ** self.options["feature_exponent"] * along
        else:
            f = 0.5 * self.kappa_0 * (length - along)
        f += 0.5 * besides * length + 0.5 * self.options["crease"] * self.K * sum(half[4] for half in halves)
        if self.enclosed is not None:
            f += 0.5 * self.region_factor() * sum(self.enclosed.along(*chord) for chord in chords)
        return f, 0.5 * (len(chords) if self.options["denominator"] == "arcs" else length)

    def arc(self, p, q, r):
        return self.at_point(q, [(p, q), (q, r)])

    def sums(self, points):
        points = list(points)
        chords = self.segments(points)
        if self.closed:
            arcs = [self.at_point(one[1], [one, two]) for one, two in zip(chords, chords[1:] + chords[:1], strict=True)]
        else:
            arcs = [self.at_point(one[1], [one, two]) for one, two in pairwise(chords)]
            arcs += [self.at_point(points[0], chords[:1]), self.at_point(points[-1], chords[-1:])]
        return sum(f for f, _ in arcs), sum(g for _, g in arcs)

    def objective(self, f, g):
        """What is minimized; g is the length in the measure of the denominator, which the length bias uses too."""
        if self.options["length_bias"] == 0:
            return f / g
        K, L0 = (self.K * self.L0 / self.n0, self.n0) if self.options["denominator"] == "arcs" else (self.K, self.L0)
        return f / g / K + self.options["length_bias"] * max(g / L0, self.options["length_floor"])
