# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard constraints (4.4): the module deletes chords and arcs, while the independent solver records what a path
visits."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from contour_checks import crossings
from contour_energy import points_of, vertex
from random_cases import Case, annulus, chain, check_optimum, crossing_chain, cylinder, random_energy, seeds, torus

CLOSED = [annulus, cylinder, torus, cylinder]


def draw(rng, seed, ends):
    if ends is None:
        return CLOSED[seed % 4](rng)
    return (crossing_chain if ends == "border" else chain)(rng)


def constrained_case(kind, k, seed, ends=None):
    """Requires random vertices and real edges of the band, on and off the given contour."""
    rng = np.random.default_rng([seed, k, len(kind), len(ends or "")])
    while True:
        mesh, contour = draw(rng, seed, ends)
        flow = ("harmonic", "gates", "harmonic", "arc_length")[seed % 4]
        options = {"refinement": k, "flow": flow, "width": int(rng.integers(1, 4)), **random_energy(rng)}
        case = Case(mesh, contour, options | ({"ends": ends} if ends else {}), closed=ends is None)
        constraints = {}
        if "vert" in kind:
            count = int(rng.integers(1, 3))
            constraints["required_vertices"] = rng.choice(case.space["vertices"], count, replace=False).astype(np.int32)
        if "edge" in kind:
            edges = inner_edges(case)
            constraints["required_edges"] = edges[
                rng.choice(len(edges), 1 if k else int(rng.integers(1, 3)), replace=False)
            ]
        case.constraints = constraints
        if rng.random() < 0.3 or np.isfinite(case.expected()):  # keeps most cases feasible
            return case


def inner_edges(case):
    """Real edges of the band that are not on the mesh border, in random directions."""
    left = case.energy.geometry.left_face
    band = case.space["edges"][~case.space["diagonal"]].tolist()
    return np.array([(a, b) for a, b in band if (a, b) in left and (b, a) in left], dtype=np.int32)


@pytest.mark.parametrize("kind", ["vertices", "edges", "vertices and edges"])
@seeds(40)
def test_closed_regular_optimum_matches_the_independent_solver(kind, seed):
    check_optimum(constrained_case(kind, 0, seed))


@pytest.mark.parametrize("kind", ["vertices", "edges"])
@seeds(30)
def test_closed_refined_optimum_matches_the_independent_solver(kind, seed):
    check_optimum(constrained_case(kind, 1 + seed % 7 // 6, seed))


@pytest.mark.parametrize("ends", ["edges", "vertices", "border"])
@pytest.mark.parametrize("kind", ["vertices", "edges"])
@seeds(10)
def test_open_optimum_matches_the_independent_solver(ends, kind, seed):
    check_optimum(constrained_case(kind, seed % 2, seed, ends))


# ---- barriers, and realistic contours


@pytest.mark.parametrize("k", [0, 1, 2])
@seeds(10, 20)
def test_barriers_are_never_crossed(k, seed):
    """The band, and with it the contour, stays on the given contour's side of a closed loop of barriers."""
    rng = np.random.default_rng(seed)
    mesh = meshes.tube(rng.uniform(0.7, 1.3, 11), 8, step=0.5, split_fraction=0.6, rng=rng, noise=0.05)
    contour = meshes.zigzag_contour(rng, 8, 4, 5)
    fence = 7 * 8 + np.arange(8)
    barriers = np.stack([fence, np.roll(fence, -1)], axis=1).astype(np.int32)
    options = mrc.Options(flow="harmonic", width=5, refinement=k, iterations=3)
    surface = surface_of(mesh)
    free = mrc.optimize(surface, contour, options=options)
    held = mrc.optimize(surface, contour, options=options, barriers=barriers)
    assert free.objective <= free.initial_objective
    assert held.objective <= held.initial_objective
    points = points_of(held)
    assert max(max(p[:2]) // 8 for p in points) <= 7
    assert crossings(mesh, points, closed=True) == []


@pytest.mark.parametrize("k", [0, 1])
def test_required_elements_are_held_on_realistic_contours(realistic, k, rng):
    _, mesh, contour = realistic
    surface, options = surface_of(mesh), mrc.Options(flow="harmonic", width=3, refinement=k, iterations=2)
    space = mrc.search_space(surface, contour, options=options)
    free, held = mrc.optimize(surface, contour, options=options), 0
    for _ in range(4):
        vertices = rng.choice(space["vertices"], int(rng.integers(1, 4)), replace=False).astype(np.int32)
        try:
            result = mrc.optimize(surface, contour, options=options, required_vertices=vertices)
        except mrc.Infeasible:
            continue
        held += 1
        points = points_of(result)
        assert {vertex(v) for v in vertices} <= set(points)
        assert crossings(mesh, points, closed=True) == []
        assert (np.diff(result.history) <= 0).all()
    assert held > 0
    assert free.objective <= free.initial_objective
