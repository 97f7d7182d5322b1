# SPDX-License-Identifier: GPL-3.0-or-later
"""Refined contours (3.2, 4.3): the graph and the optimum, against an independent construction and solver."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from contour_checks import crossings, on_surface
from contour_energy import UNITS, points_of, with_steiner_points
from random_cases import Case, annulus, check_optimum, check_same_graph, cylinder, random_energy, seeds, torus

FAMILIES = [annulus, cylinder, torus]


def refined_case(k, seed, **more):
    rng = np.random.default_rng([k, seed])
    mesh, contour = FAMILIES[seed % 3](rng)
    flow = ("harmonic", "gates", "harmonic", "arc_length")[seed % 4]
    options = {"refinement": k, "flow": flow, "width": int(rng.integers(1, 3)), **random_energy(rng), **more}
    return Case(mesh, contour, options, dense=bool(seed % 5 == 4))


@seeds(60)
def test_optimum_with_one_steiner_point_matches_the_independent_solver(seed):
    case = refined_case(1, seed)
    check_same_graph(case)
    check_optimum(case)


@seeds(60)
def test_optimum_with_two_steiner_points_matches_the_independent_solver(seed):
    case = refined_case(2, seed)
    check_same_graph(case)
    check_optimum(case)


# ---- symmetries and guarantees


def optimize(mesh, contour, **options):
    return mrc.optimize(surface_of(mesh), contour, options=mrc.Options(flow="harmonic", **{"width": 3, **options}))


def as_arguments(points):
    return {
        "edge_vertices": np.array([p[:2] for p in points], dtype=np.int32),
        "edge_parameters": np.array([p[2] / UNITS for p in points]),
    }


def same_curve(one, two, reverse=False):
    """Whether two closed results have the same points in the same cyclic order."""
    one, two = points_of(one), points_of(two)
    two = two[::-1] if reverse else two
    if set(one) != set(two) or len(one) != len(two):
        return False
    start = two.index(one[0])
    return one == two[start:] + two[:start]


def test_more_steiner_points_are_never_worse(realistic):
    """The optimum for k = 3 is at most that for k = 1, expressed with the points of k = 3."""
    _, mesh, contour = realistic
    coarse, fine = optimize(mesh, contour, refinement=1), optimize(mesh, contour, refinement=3)
    dense = with_steiner_points(points_of(coarse), True, 3)
    options = mrc.Options(flow="harmonic", width=3, refinement=3)
    measured = mrc.measure(surface_of(mesh), **as_arguments(dense), options=options, scales=fine.scales)
    assert fine.ratio <= measured.ratio + 1e-12 / fine.scales.h


@pytest.mark.parametrize("k", [1, 2, 4])
def test_results_are_simple(realistic, k):
    _, mesh, contour = realistic
    points = points_of(optimize(mesh, contour, refinement=k))
    assert on_surface(mesh, points, closed=True)
    assert crossings(mesh, points, closed=True) == []


@seeds(20, 60)
def test_results_on_level_grids_are_simple(seed):
    rng = np.random.default_rng(seed)
    mesh = meshes.tube(rng.uniform(0.6, 1.4, 9), 8, step=0.5, rng=rng, noise=(0.0, 0.1)[seed % 2])
    contour = meshes.zigzag_contour(rng, 8, 3, 5)
    points = points_of(optimize(mesh, contour, refinement=1 + seed % 3, max_turn=np.pi))
    assert on_surface(mesh, points, closed=True)
    assert crossings(mesh, points, closed=True) == []


def test_reversal_reverses_the_result(realistic):
    _, mesh, contour = realistic
    base, backwards = (optimize(mesh, c, refinement=1) for c in (contour, contour[::-1].copy()))
    assert same_curve(base, backwards, reverse=True)
    assert backwards.ratio == pytest.approx(base.ratio, rel=1e-10)


def test_rigid_motion_changes_nothing(realistic, rng):
    _, mesh, contour = realistic
    base, moved = (optimize(m, contour, refinement=1) for m in (mesh, meshes.rigidly_moved(mesh, rng)))
    assert same_curve(base, moved)
    assert moved.ratio == pytest.approx(base.ratio, rel=1e-8, abs=1e-12 / base.scales.L0)


@pytest.mark.parametrize("denominator", ["length", "arcs"])
def test_scaling_divides_the_ratio(realistic, denominator):
    _, mesh, contour = realistic
    size = 37.0
    big = mesh.moved(mesh.positions * size)
    base, scaled = (optimize(m, contour, refinement=1, denominator=denominator) for m in (mesh, big))
    assert same_curve(base, scaled)
    assert scaled.ratio * (size if denominator == "length" else 1.0) == pytest.approx(base.ratio, rel=1e-8)


def test_iterations_never_raise_the_objective(realistic):
    _, mesh, contour = realistic
    result = optimize(mesh, contour, width=1, refinement=1, iterations=3)
    assert result.history[0] == result.initial_objective
    assert (np.diff(result.history) <= 0).all()
    assert result.history[-1] == result.objective


def test_change_of_k_starts_a_new_segment_of_the_history(realistic):
    _, mesh, contour = realistic
    result = optimize(mesh, contour, width=1, regular_iterations=2, refinement=1, iterations=2)
    regular = optimize(mesh, contour, width=1, iterations=2)
    count = len(regular.history)
    assert result.history[:count] == pytest.approx(regular.history, rel=1e-12)
    assert (np.diff(result.history[:count]) <= 0).all()
    assert (np.diff(result.history[count:]) <= 0).all()
    assert result.history[-1] == result.objective


def test_result_given_again_is_never_worse(realistic):
    _, mesh, contour = realistic
    first = optimize(mesh, contour, width=2, refinement=1)
    surface, options = surface_of(mesh), mrc.Options(flow="harmonic", width=2, refinement=1)
    for again in (
        mrc.optimize(surface, first, options=options, scales=first.scales),
        mrc.optimize(surface, **as_arguments(points_of(first)), options=options, scales=first.scales),
    ):
        assert again.initial_ratio == pytest.approx(first.ratio, rel=1e-12)
        assert again.ratio <= first.ratio + 1e-12 * abs(first.ratio)
        assert crossings(mesh, points_of(again), closed=True) == []
    finer = mrc.optimize(
        surface, first, options=mrc.Options(flow="harmonic", width=2, refinement=2), scales=first.scales
    )
    assert finer.objective <= finer.initial_objective


def test_positions_and_faces_match_the_segments(realistic):
    _, mesh, contour = realistic
    result = optimize(mesh, contour, refinement=2)
    t = result.edge_parameters[:, None]
    ends = mesh.positions[result.edge_vertices]
    assert np.allclose(result.positions, (1 - t) * ends[:, 0] + t * ends[:, 1], atol=1e-14, rtol=0)
    points = points_of(result)
    for (p, q), face in zip(zip(points, points[1:] + points[:1], strict=True), result.segment_faces, strict=True):
        assert {v for point in (p, q) for v in point[:2]} <= set(mesh.faces[face])
