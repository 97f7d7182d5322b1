# SPDX-License-Identifier: GPL-3.0-or-later
"""Small random searches, and the comparison of their results with the optimum of the independent solver."""

from functools import cached_property
from itertools import pairwise
from math import inf, isfinite, pi

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from contour_energy import EXTRA, Enclosed, PointEnergy, edge_of, point_on, points_of, vertex, with_steiner_points
from contour_graph import ContourGraph

UNDER_SANITIZERS = 6  # cases of each kind, which take five times as long there


def seeds(count, in_full=200):
    """Parametrizes by seed: `count` cases always, the others only in a full run."""
    few = [*range(min(count, UNDER_SANITIZERS))]
    more = [pytest.param(seed, marks=pytest.mark.slow) for seed in range(UNDER_SANITIZERS, count)]
    rest = [pytest.param(seed, marks=pytest.mark.long) for seed in range(count, in_full)]
    return pytest.mark.parametrize("seed", [*few, *more, *rest])


def annulus(rng):
    """An annulus of triangles, quads or both."""
    rings, columns = int(rng.integers(3, 5)), int(rng.integers(4, 7))
    mesh = meshes.jittered_annulus(rng, rings, columns, split_fraction=rng.choice([0.0, 0.5, 1.0]))
    return mesh, meshes.zigzag_contour(rng, columns, 1, rings - 2)


def cylinder(rng):
    """A cylinder of regular quads, which give level edges in the harmonic flow; sometimes with noise in the
    positions."""
    rings, columns = int(rng.integers(3, 6)), int(rng.integers(4, 7))
    noise = rng.choice([0.0, 0.1])
    mesh = meshes.tube(rng.uniform(0.8, 1.4, rings), columns, step=rng.uniform(0.4, 1.0), rng=rng, noise=noise)
    return mesh, meshes.zigzag_contour(rng, columns, 1, rings - 2, step_chance=0.4)


def torus(rng):
    rows, columns = int(rng.integers(4, 7)), int(rng.integers(4, 6))
    mesh = meshes.torus(rows, columns, rng=rng, split_fraction=rng.choice([0.0, 0.5, 1.0]), noise=0.1)
    return mesh, meshes.zigzag_contour(rng, columns, 1, 2)


def chain(rng):
    """An open chain inside an annulus, cylinder or torus."""
    mesh, contour = (annulus, cylinder, torus)[int(rng.integers(3))](rng)
    length = int(rng.integers(3, len(contour)))
    return mesh, np.roll(contour, rng.integers(len(contour)))[:length].copy()


def crossing_chain(rng):
    """A chain from border to border, or from a border to an inner vertex."""
    rows, columns = int(rng.integers(4, 6)), int(rng.integers(4, 7))
    mesh = meshes.jittered_annulus(rng, rows, columns, split_fraction=rng.choice([0.0, 0.5, 1.0]))
    column, path = int(rng.integers(columns)), []
    for row in range(rows):
        path.append(row * columns + column)
        if 0 < row < rows - 1 and rng.random() < 0.4:
            column = (column + int(rng.choice([-1, 1]))) % columns
            path.append(row * columns + column)
    if rng.random() < 0.3:
        path = path[:-1]
    return mesh, np.array(path[:: int(rng.choice([-1, 1]))], dtype=np.int32)


def random_energy(rng):
    """Options of eq. 3.2 and of the curvature; half of the time the defaults."""
    options = {"feature": ("valley", "ridge")[int(rng.integers(2))]}
    if rng.random() < 0.5:
        options |= {
            "feature_exponent": rng.uniform(0.4, 2.0),
            "direction_exponent": rng.uniform(0.5, 3.0),
            "kappa0_factor": rng.uniform(0.5, 6.0),
            "curvature_radius": rng.uniform(0.7, 2.2),
            "curvature_smoothing": float(rng.choice([0.0, 0.4, 1.3])),
            "max_turn": rng.uniform(0.4 * pi, 0.8 * pi),
        }
    return options


class Case:
    """A search, both by the module and by enumeration or the independent solver."""

    def __init__(self, mesh, contour, options=None, closed=True, dense=False, **constraints):
        self.mesh, self.contour, self.closed, self.constraints = mesh, contour, closed, constraints
        self.options = {**EXTRA, "flow": "harmonic", "width": 2, **(options or {})}
        self.surface = surface_of(mesh)
        points = [vertex(v) for v in contour]
        self.given = self.dense(points)
        self.passed = self.given if dense else points

    def dense(self, points):
        """The contour with the Steiner points of the search, with which everything is measured."""
        return with_steiner_points(points, self.closed, self.options["refinement"])

    @property
    def module_options(self):
        return mrc.Options(**self.options)

    def contour_arguments(self, points=None):
        points = self.passed if points is None else points
        return {
            "edge_vertices": np.array([p[:2] for p in points], dtype=np.int32),
            "edge_parameters": np.array([p[2] / 5040 for p in points]),
            "closed": self.closed,
            "options": self.module_options,
        }

    def optimize(self):
        return mrc.optimize(self.surface, **self.contour_arguments(), **self.constraints)

    @cached_property
    def space(self):
        return mrc.search_space(self.surface, **self.contour_arguments())

    @cached_property
    def energy(self):
        energy = PointEnergy(self.mesh, self.given, self.closed, self.options, self.constraints.get("attractors", ()))
        if "region_density" in self.constraints:
            energy.weigh_region(self.space, self.constraints["region_density"])
        return energy

    @cached_property
    def graph(self):
        return ContourGraph(self.energy, self.space, None if self.closed else self.ends())

    def ends(self):
        """The chords that may begin, and those that may end, a path."""
        first, last = self.given[0], self.given[-1]
        at_first, at_last = self.sliding_piece(first, last) or {first}, self.sliding_piece(last, first) or {last}
        return (lambda p, q: p in at_first), (lambda p, q: q in at_last)

    def sliding_piece(self, end, other):
        """The piece of mesh border along which an end may slide; None where it may not."""
        pieces = self.border_pieces() if self.options["ends"] in ("border", "edges_or_border") else []
        return next((piece for piece in pieces if end in piece and other not in piece), None)

    def border_pieces(self):
        """The pieces of the mesh border in the band, as sets of points."""
        edges = [edge for i in self.space["faces"].tolist() for edge in self.energy.geometry.face_edges[i]]
        open_edges = [edge for edge in edges if edge[::-1] not in self.energy.geometry.left_face]
        pieces = []
        for a, b in open_edges:
            k = self.options["refinement"]
            fresh = {vertex(a), vertex(b), *(point_on(a, b, i / (k + 1)) for i in range(1, k + 1))}
            touched = [piece for piece in pieces if piece & fresh]
            pieces = [piece for piece in pieces if not piece & fresh] + [fresh.union(*touched)]
        return pieces

    def required(self):
        """The required vertices and edges; with ends="edges" these include the first and last edge of an open contour,
        with "edges_or_border" only where the end does not slide along the border."""
        edges = [tuple(map(int, edge)) for edge in self.constraints.get("required_edges", ())]
        if not self.closed and self.options["ends"] in ("edges", "edges_or_border"):
            first, last = self.given[0], self.given[-1]
            held = [not self.sliding_piece(first, last), not self.sliding_piece(last, first)]
            at_ends = [tuple(map(int, self.contour[:2])), tuple(map(int, self.contour[-2:]))]
            edges += [edge for edge, stays in zip(at_ends, held) if stays]
        return [int(v) for v in self.constraints.get("required_vertices", ())], list(dict.fromkeys(edges))

    def holds(self, points):
        vertices, edges = self.required()
        ring = with_steiner_points(points, self.closed, 0)
        chords = list(pairwise([*ring, ring[0]] if self.closed else ring))
        on_edge = {}
        for p, q in chords:
            on_edge[edge_of(p, q)] = on_edge.get(edge_of(p, q), 0.0) + self.energy.size(p, q)
        whole = all(
            abs(on_edge.get(tuple(sorted(edge)), 0.0) - self.energy.geometry.neighbors[edge[0]][edge[1]]) < 1e-9
            for edge in edges
        )
        return whole and all(vertex(v) in ring for v in vertices)

    def given_objective(self):
        return self.energy.objective(*self.energy.sums(self.given))

    def expected(self):
        """The least objective of the graph and, if it is feasible, of the given contour."""
        least = self.graph.best(*self.required())
        if isfinite(least):
            least = self.energy.objective(least, 1.0) if self.options["length_bias"] == 0 else least
        return min(least, self.given_objective() if self.holds(self.given) else inf)

    def whole_content(self):
        """The total content of a surface without a border; otherwise 0."""
        geometry = self.energy.geometry
        if any((b, a) not in geometry.left_face for a, b in geometry.left_face):
            return 0.0
        triangles, density = geometry.triangles, self.constraints["region_density"]
        return sum(content for _, content in Enclosed.contents(geometry, triangles, density))

    @property
    def rounding(self):
        """The rounding error of f, in units of K. Where chords are perpendicular to the direction, the rounding error
        of a cosine is raised to the direction exponent."""
        return max(1e-10, 1e-15 ** self.energy.options["direction_exponent"])

    def close(self, one, two):
        return abs(one - two) <= 1e-9 * max(abs(one), abs(two)) + self.rounding * self.unit()

    def unit(self):
        return 1.0 if self.options["length_bias"] else self.energy.K


def check_scales(case, scales):
    energy = case.energy
    for name in ("h", "K", "kappa_0", "L0", "n0", "clamp"):
        one, two = getattr(scales, name), getattr(energy, name)
        assert one == two or abs(one - two) <= 1e-10 * two, name


def check_same_graph(case):
    """Compares both graphs node by node and arc by arc, including f and g."""
    space, graph = case.space, case.graph
    points = [point_on(a, b, t) for (a, b), t in zip(space["points"].tolist(), space["parameters"], strict=True)]
    place = points.__getitem__ if any(p[2] for p in points) else vertex
    names = [(place(a), place(b)) for a, b in space["nodes"].tolist()]
    assert set(names) == {node[:2] for node in graph.nodes}
    expected = {
        (graph.nodes[i][:2], graph.nodes[j][:2]): (f, g) for i, arcs in enumerate(graph.arcs) for j, f, g in arcs
    }
    found = {
        (names[i], names[j]): fg
        for (i, j), *fg in zip(space["arcs"].tolist(), space["f"].tolist(), space["g"].tolist(), strict=True)
    }
    assert set(found) == set(expected)
    for arc, (f, g) in found.items():
        assert abs(f - expected[arc][0]) <= max(1e-9, case.rounding) * case.energy.K * (g + abs(f)), arc
        assert abs(g - expected[arc][1]) <= 1e-10 * g, arc


def check_optimum(case, expected=None):
    """The objective of the module is the optimum, and both the independent measure and its own confirm it for the
    result. Returns the result, or None if no contour is feasible and the module says so."""
    expected = case.expected() if expected is None else expected
    if expected == inf:
        with pytest.raises(mrc.Infeasible, match=r"\d"):
            case.optimize()
        return None
    result = case.optimize()
    check_scales(case, result.scales)
    points, energy = points_of(result), case.energy
    F, G = energy.sums(case.dense(points))
    assert case.close(F / G, result.ratio)
    assert case.close(energy.objective(F, G), result.objective)
    assert case.holds(points)
    assert case.close(result.objective, expected), f"{result.objective} instead of {expected}: {points}"
    if case.holds(case.given):
        assert result.status in ("improved", "unchanged")
        assert case.close(result.initial_objective, case.given_objective())
    else:
        assert result.status == "constrained"
    assert 0 <= result.gap <= 1e-9 * (abs(result.objective) + case.unit())
    check_measure(case, result, G)
    return result


def check_measure(case, result, length):
    """The module's own measure agrees with its result."""
    again = mrc.measure(
        case.surface,
        **case.contour_arguments(points_of(result)),
        scales=result.scales,
        attractors=case.constraints.get("attractors", ()),
        region_density=case.constraints.get("region_density"),
    )
    off = abs(again.ratio - result.ratio)
    shift = 0.0
    if "region_density" in case.constraints and off > case.rounding * case.energy.K:
        # Two loops around a torus bound two parts of it, and only the band of the search tells which is meant.
        shift = abs(case.energy.region_factor() * case.whole_content() / length)
    assert abs(off - shift) <= 1e-12 * (abs(result.ratio) + shift) + 1e-15 * case.energy.K
    if shift == 0.0:
        off = abs(again.objective - result.objective)
        assert off <= 1e-12 * abs(result.objective) + 1e-15 * case.unit()
