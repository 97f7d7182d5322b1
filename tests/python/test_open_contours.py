# SPDX-License-Identifier: GPL-3.0-or-later
"""Open curves (4.6) with fixed end edges, fixed end vertices and ends on the border, against an independent solver."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from contour_checks import crossings, on_surface
from contour_energy import points_of, vertex, with_steiner_points
from random_cases import Case, chain, check_optimum, check_same_graph, crossing_chain, random_energy, seeds

FLOWS = ["harmonic", "gates", "arc_length"]


def open_case(ends, seed, k=0, **more):
    rng = np.random.default_rng([seed, len(ends), k])
    mesh, contour = (crossing_chain if ends == "border" or "_or_" in ends and seed % 2 else chain)(rng)
    options = {"refinement": k, "flow": FLOWS[seed // 2 % 3], "width": int(rng.integers(1, 4)), "ends": ends}
    return Case(mesh, contour, {**options, **random_energy(rng), **more}, closed=False)


@pytest.mark.parametrize("ends", ["edges", "vertices", "border", "edges_or_border"])
@seeds(60)
def test_regular_optimum_matches_the_independent_solver(ends, seed):
    case = open_case(ends, seed)
    if ends == "vertices":
        check_same_graph(case)
    check_optimum(case)


@pytest.mark.parametrize("ends", ["edges", "vertices", "border", "edges_or_border"])
@seeds(24)
def test_refined_optimum_matches_the_independent_solver(ends, seed):
    case = open_case(ends, seed, k=1 + seed % 2)
    if ends == "vertices":
        check_same_graph(case)
    check_optimum(case)


# ---- symmetries and guarantees


def realistic_chain(realistic):
    """Half of a realistic contour."""
    _, mesh, contour = realistic
    return mesh, contour[: len(contour) // 2]


def optimize(mesh, chain, **options):
    options = mrc.Options(**{"flow": "harmonic", "width": 3, "ends": "vertices", **options})
    return mrc.optimize(surface_of(mesh), chain, closed=False, options=options)


@pytest.mark.parametrize("ends", ["edges", "vertices", "border", "edges_or_border"])
@pytest.mark.parametrize("k", [0, 2])
def test_ends_are_kept_and_the_result_is_simple(realistic, ends, k):
    mesh, chain = realistic_chain(realistic)
    result = optimize(mesh, chain, ends=ends, refinement=k, iterations=2)
    points = points_of(result)
    assert not result.closed
    assert (points[0], points[-1]) == (vertex(chain[0]), vertex(chain[-1]))
    if ends in ("edges", "edges_or_border"):
        assert points[: k + 2] == with_steiner_points([vertex(v) for v in chain[:2]], False, k)
        assert points[-k - 2 :] == with_steiner_points([vertex(v) for v in chain[-2:]], False, k)
    assert on_surface(mesh, points, closed=False)
    assert crossings(mesh, points, closed=False) == []
    assert result.objective <= result.initial_objective
    assert (np.diff(result.history) <= 0).all()


@pytest.mark.parametrize("k", [0, 1])
def test_end_on_the_border_slides_along_it(k):
    """On a sheet with a groove, a straight line beside the groove slides into it. Its ends stay on their borders."""
    rows, columns = 9, 15
    x, y = np.meshgrid(np.arange(columns) * 1.0, np.arange(rows) * 1.0)
    z = -1.5 * np.exp(-((x - 9.0) ** 2) / 2)
    mesh = meshes.polygon_mesh(
        np.stack([x, y, z], axis=-1).reshape(-1, 3), meshes.grid_faces(rows, columns, closed_columns=False)
    )
    chain = np.arange(rows, dtype=np.int32) * columns + 7
    slid = optimize(mesh, chain, ends="border", width=4, refinement=k)
    held = optimize(mesh, chain, ends="vertices", width=4, refinement=k)
    assert slid.ratio < held.ratio
    assert slid.positions[:, 0] == pytest.approx(9.0, abs=1e-9)
    assert (slid.positions[0, 1], slid.positions[-1, 1]) == (0.0, rows - 1.0)
    assert (points_of(held)[0], points_of(held)[-1]) == (vertex(chain[0]), vertex(chain[-1]))


@pytest.mark.parametrize("k", [0, 1])
def test_an_end_on_the_border_slides_while_the_edge_at_the_other_is_held(k):
    """A line on the sheet begins on its border and ends amid it."""
    rows, columns = 12, 15
    x, y = np.meshgrid(np.arange(columns) * 1.0, np.arange(rows) * 1.0)
    z = -1.5 * np.exp(-((x - 9.0) ** 2) / 2)
    mesh = meshes.polygon_mesh(
        np.stack([x, y, z], axis=-1).reshape(-1, 3), meshes.grid_faces(rows, columns, closed_columns=False)
    )
    chain = np.arange(8, dtype=np.int32) * columns + 7
    for vertices in (chain, chain[::-1].copy()):
        slid = optimize(mesh, vertices, ends="edges_or_border", width=4, refinement=k)
        points = points_of(slid) if vertices[0] == chain[0] else points_of(slid)[::-1]
        assert points[0] == vertex(9)
        assert points[-k - 2 :] == with_steiner_points([vertex(v) for v in chain[-2:]], False, k)
    held = optimize(mesh, chain, ends="edges", width=4, refinement=k)
    assert slid.ratio < held.ratio


@pytest.mark.parametrize("k", [0, 1])
def test_reversal_and_rigid_motion_change_nothing(realistic, k, rng):
    mesh, chain = realistic_chain(realistic)
    base = optimize(mesh, chain, refinement=k)
    backwards = optimize(mesh, chain[::-1].copy(), refinement=k)
    moved = optimize(meshes.rigidly_moved(mesh, rng), chain, refinement=k)
    assert points_of(base) == points_of(backwards)[::-1] == points_of(moved)
    assert backwards.ratio == pytest.approx(base.ratio, rel=1e-10)
    assert moved.ratio == pytest.approx(base.ratio, rel=1e-8, abs=1e-12 / base.scales.L0)


def test_result_can_be_given_again(realistic):
    mesh, chain = realistic_chain(realistic)
    first = optimize(mesh, chain, refinement=1)
    options = mrc.Options(flow="harmonic", width=3, refinement=1, ends="vertices")
    again = mrc.optimize(surface_of(mesh), first, closed=False, options=options, scales=first.scales)
    assert again.initial_ratio == pytest.approx(first.ratio, rel=1e-12)
    assert again.ratio <= first.ratio + 1e-12 * abs(first.ratio)
