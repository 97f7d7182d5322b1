# SPDX-License-Identifier: GPL-3.0-or-later
"""Converting layers to the constraints of native calls, without Blender."""

import importlib
import sys
from pathlib import Path

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
arrays = importlib.import_module("addon.core.native_constraints")
parameters = importlib.import_module("addon.core.parameters")

ROWS, COLUMNS = 13, 12


def tube():
    return meshes.tube(np.ones(ROWS), COLUMNS, step=0.5)


def ring(row):
    return row * COLUMNS + np.arange(COLUMNS)


def constraints(mesh, **fields):
    _, offsets, vertices, *_ = mesh.arguments()
    return arrays.Constraints(mesh.positions, np.asarray(offsets), np.asarray(vertices), **fields)


def felt(rows, place, points):
    """Return the sum of the attractors at a point (4.5), with straight distances."""
    squares = ((points[rows[:, 0].astype(int)] - place) ** 2).sum(axis=1)
    return (rows[:, 2] * np.exp(-squares / (2 * (rows[:, 1] / 2) ** 2)))[squares <= rows[:, 1] ** 2].sum()


@pytest.mark.parametrize("dense", [0.02, 0.1, 0.24])
@pytest.mark.parametrize("plane", [False, True])
def test_the_pull_of_a_painted_place_is_its_weight_however_dense_the_mesh(dense, plane):
    """This holds inside an evenly painted line or patch; at corners fewer attractors contribute."""
    steps = np.arange(-2.0, 2.0 + dense, dense)
    points = np.array([(x, y, 0.0) for x in steps for y in (steps if plane and dense > 0.05 else [0.0])])
    rows = arrays.attractors(points, np.arange(len(points)), np.full(len(points), 0.6), 1.0, 5.0)
    for place in points[np.abs(points).max(axis=1) < 0.5]:
        assert felt(rows, place, points) == pytest.approx(3.0, rel=0.2)


def test_the_pull_is_proportional_to_strength_and_weight(rng):
    points, weights = rng.uniform(0, 3, (40, 3)), rng.uniform(0.1, 1.0, 40)
    one = arrays.attractors(points, np.arange(40), weights, 0.8, 1.0)
    two = arrays.attractors(points, np.arange(40), weights / 2, 0.8, -3.0)
    assert np.array_equal(one[:, :2], two[:, :2])
    np.testing.assert_allclose(two[:, 2], -1.5 * one[:, 2])


def test_attractors_keep_a_distance_and_every_painted_vertex_is_near_one(rng):
    points, weights = rng.uniform(0, 2, (300, 3)), rng.uniform(0.1, 1.0, 300)
    rows = arrays.attractors(points, np.arange(300), weights, 0.8, 1.0)
    kept = rows[:, 0].astype(int)
    apart = np.linalg.norm(points[kept][:, None] - points[kept][None], axis=2)
    assert apart[~np.eye(len(kept), dtype=bool)].min() > 0.4
    distances = np.linalg.norm(points[:, None] - points[kept][None], axis=2)
    assert distances.min(axis=1).max() <= 0.4
    for vertex in np.setdiff1d(np.arange(300), kept):  # one of at least as much weight stands for it
        assert weights[kept][distances[vertex] <= 0.4].max() >= weights[vertex]


def test_without_paint_nearby_there_is_no_attractor():
    none = np.empty(0, dtype=int)
    assert arrays.attractors(np.zeros((3, 3)), none, np.empty(0), 1.0, 1.0).shape == (0, 3)


def test_required_vertices_go_to_the_nearest_contour_whose_band_contains_them():
    points = np.array([(x, 0.0, 0.0) for x in range(10)])
    contours = [mrc.Contour([0, 1], closed=False), mrc.Contour([6, 7], closed=False)]
    bands = [np.arange(0, 6), np.arange(4, 10)]
    first, second = arrays.assign(np.array([2, 4, 5, 9]), points, contours, bands)
    assert (first.tolist(), second.tolist()) == ([2], [4, 5, 9])
    first, second = arrays.assign(np.array([3]), points, contours, bands)
    assert (first.tolist(), second.tolist()) == ([3], [])
    with pytest.raises(arrays.OutsideBand, match="2 required vertices lie outside") as caught:
        arrays.assign(np.array([4, 8, 9]), points, contours, [bands[0], bands[0]])
    assert caught.value.vertices == [8, 9]
    with pytest.raises(arrays.OutsideBand, match="1 required vertex lies outside"):
        arrays.assign(np.array([9]), points, contours, [bands[0], bands[0]])


@pytest.mark.parametrize("width", [1, 3])
def test_vertices_outside_the_band_are_those_that_the_native_module_refuses(width):
    """The message comes before the search, and says of all vertices what the module says of the first."""
    mesh = tube()
    surface, contour = surface_of(mesh), mrc.Contour(ring(6))
    options = parameters.native_options(width=width, reach=0.0)
    for row in range(1, ROWS - 1):
        asked = constraints(mesh, required=ring(row)[3:4])
        try:
            asked.keywords(mrc, surface, [contour], options)
            outside = False
        except arrays.OutsideBand:
            outside = True
        (found,) = mrc.optimize_all(
            surface, [contour], options=mrc.Options(**options), required_vertices=[asked.required], errors="return"
        )
        refused = getattr(found, "code", "") == "outside_band"
        assert not refused or found.elements == (("vertex", asked.required[0]),)
        assert outside == refused == (abs(row - 6) > width)


@pytest.mark.parametrize("iterations", [1, 3])
def test_attractors_reach_as_far_as_the_iterations(iterations):
    mesh = tube()
    asked = constraints(mesh, pulls=np.ones(len(mesh.positions)), strength=2.0, radius=0.1)
    options = parameters.native_options(width=1, reach=0.0, iterations=iterations)
    rows = asked.keywords(mrc, surface_of(mesh), [mrc.Contour(ring(6))], options)["attractors"]
    reached = np.concatenate([ring(row) for row in range(6 - iterations, 7 + iterations)])
    assert sorted(rows[:, 0].astype(int)) == reached.tolist()


def test_marks_along_the_given_contour_are_ignored():
    mesh = tube()
    along, others = np.stack([ring(6), np.roll(ring(6), -1)], axis=1), np.stack([ring(8), np.roll(ring(8), -1)], axis=1)
    marks = np.concatenate([along[:, ::-1], others])
    asked = constraints(mesh, barriers=marks, attracting=marks, strength=1.0, radius=0.1)
    options = parameters.native_options(reach=0.0)
    found = asked.keywords(mrc, surface_of(mesh), [mrc.Contour(ring(6))], options)
    assert np.array_equal(found["barriers"], others)
    assert sorted(found["attractors"][:, 0].astype(int)) == ring(8).tolist()
    alone = constraints(mesh, attracting=along, strength=1.0).keywords(
        mrc, surface_of(mesh), [mrc.Contour(ring(6))], options
    )
    assert "attractors" not in alone
    assert alone["options"].min_salience == options["min_salience"]


def test_the_painted_side_is_found_in_either_direction():
    mesh = tube()
    density = np.array([float(min(face) >= 7 * COLUMNS) for face in mesh.faces])
    asked = constraints(mesh, density=density)
    surface, loop = surface_of(mesh), ring(6)
    loop, back = mrc.Contour(loop), mrc.Contour(loop[::-1])
    sides = [asked.paints_the_right(mrc, surface, contour) for contour in (loop, back)]
    assert sorted(sides) == [False, True]
    opposite = constraints(mesh, density=1 - density)
    assert [
        opposite.paints_the_right(mrc, surface, loop),
        opposite.paints_the_right(mrc, surface, back),
    ] == [not side for side in sides]


def test_a_contour_in_error_changes_no_constraint_of_the_others():
    mesh = tube()
    surface, sound, bad = surface_of(mesh), mrc.Contour(ring(6)), mrc.Contour([*ring(9), ring(10)[11]])
    asked = constraints(mesh, required=ring(7)[3:4], pulls=np.ones(len(mesh.positions)), strength=2.0)
    options = parameters.native_options(width=2, reach=0.0)
    both, alone = (asked.keywords(mrc, surface, contours, options) for contours in ([sound, bad], [sound]))
    assert [list(vertices) for vertices in both["required_vertices"]] == [[ring(7)[3]], []]
    assert np.array_equal(both["attractors"], alone["attractors"])
    assert len(constraints(mesh, pulls=asked.pulls).keywords(mrc, surface, [bad], options)["attractors"]) == 0


def test_required_vertices_go_to_contours_across_faces_too():
    mesh = tube()
    surface = surface_of(mesh)
    corners = [set(triangle) for triangle in np.asarray(mesh.arguments()[3]).tolist()]
    edges = []  # between two rings, and the diagonals of the faces there
    for a, b, c, d in zip(ring(8), np.roll(ring(8), -1), np.roll(ring(9), -1), ring(9)):
        edges += [(a, d), (a, c) if {a, b, c} in corners else (b, d)]
    middle = mrc.Contour(edge_vertices=np.array(edges), edge_parameters=np.full(len(edges), 0.5))
    asked = constraints(mesh, required=ring(8)[3:4], pulls=np.ones(len(mesh.positions)), strength=2.0)
    options = parameters.native_options(width=3, reach=0.0, refinement=1)
    found = asked.keywords(mrc, surface, [mrc.Contour(ring(5)), middle], options)
    assert [list(vertices) for vertices in found["required_vertices"]] == [[], [ring(8)[3]]]


def test_means_over_faces_of_any_size():
    values = np.array([1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 8.0])
    assert arrays.face_means(np.array([0, 3, 7]), values).tolist() == [2.0, 5.0]
    assert arrays.face_means(np.array([0]), np.empty(0)).tolist() == []


def test_every_preset_is_a_set_of_native_options_that_differs_from_the_others():
    found = [parameters.preset_values(name) for name in parameters.PRESETS]
    for values in found:
        mrc.Options(**parameters.native_options(**values))
    assert all(a != b for i, a in enumerate(found) for b in found[:i])


def test_settings_and_constraints_are_split():
    assert not parameters.SETTINGS.keys() & parameters.CONSTRAINTS.keys()
    assert parameters.split({"width": 3, "required_group": "Pins", "widht": 2}) == (
        {"width": 3, "widht": 2},
        {"required_group": "Pins"},
    )
