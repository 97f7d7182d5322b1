# SPDX-License-Identifier: GPL-3.0-or-later
"""Defects that were found and fixed, each with its smallest case."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from random_cases import torus


def tube(rows=6, columns=8, **more):
    return meshes.tube([1.0, 0.9, 0.7, 0.9, 1.0, 1.1][:rows], columns, **more)


def ring(row, columns=8):
    return columns * row + np.arange(columns)


def test_scales_of_another_surface_are_refused():
    large = meshes.tube([1.0] * 60, 40)
    scales = mrc.optimize(surface_of(large), ring(50, 40)).scales
    for call in (mrc.optimize, mrc.measure):
        with pytest.raises(ValueError, match="another surface"):
            call(surface_of(tube()), ring(2), scales=scales)


def test_iterations_continue_after_the_first_feasible_contour():
    """The required vertex is far from the loop: one iteration with a narrow band is not enough."""
    mesh = meshes.tube([1.0, 1.0, 1.0, 0.9, 0.8, 0.6, 0.8, 1.0], 8, rng=np.random.default_rng(2), noise=0.03)
    surface, wanted = surface_of(mesh), [8 * 2]
    results = [
        mrc.optimize(
            surface, ring(1), options=mrc.Options(width=1, iterations=n, max_turn=2.5), required_vertices=wanted
        )
        for n in (1, 8)
    ]
    assert [r.status for r in results] == ["constrained"] * 2
    assert results[1].statistics["iterations"] > 1
    assert results[1].objective <= results[0].objective


def test_attractors_may_be_an_array_and_errors_name_bad_ones():
    surface = surface_of(tube())
    rows = np.array([[3.0, 0.5, 1.0]])
    one, two = (
        mrc.optimize(surface, ring(2), attractors=rows),
        mrc.optimize(surface, ring(2), attractors=[(3, 0.5, 1.0)]),
    )
    assert one.ratio == two.ratio
    for bad in ([("a", 1, 1)], [(1.5, 1, 1)], [(1, 1)], [3]):
        with pytest.raises((TypeError, ValueError), match="attractor"):
            mrc.optimize(surface, ring(2), attractors=bad)


def test_contour_through_its_own_edge_is_not_simple():
    mesh = tube(split_fraction=1.0)
    surface, a, b = surface_of(mesh), 17, 18
    points = [(a, a), (b, b), (b + 8, b + 8), (a, b), (a - 8, b - 8)]
    with pytest.raises(ValueError, match="twice|crosses|touch"):
        mrc.measure(surface, edge_vertices=points, edge_parameters=[0, 0, 0, 0.5, 0], closed=False)


def test_point_given_from_either_end_of_its_edge_is_the_same():
    surface = surface_of(tube())
    points, parameters = [(16, 16), (16, 17), (17, 16), (17, 17)], [0, 0.1, 0.9, 0]
    with pytest.raises(ValueError, match="twice"):
        mrc.measure(surface, edge_vertices=points, edge_parameters=parameters, closed=False)


@pytest.mark.parametrize("size", [1e200, 1e51, 1e-200, 1e-310])
def test_overflowing_numbers_are_refused(size):
    mesh = tube()
    with pytest.raises(ValueError, match="scale the mesh|length 0"):
        mrc.optimize(mrc.Surface(np.asarray(mesh.positions) * size, *face_arrays(mesh)), ring(2))


def face_arrays(mesh):
    offsets = np.concatenate([[0], np.cumsum([len(face) for face in mesh.faces])])
    return offsets, np.concatenate([np.asarray(face) for face in mesh.faces])


@pytest.mark.parametrize("k", [0, 1])
def test_segment_along_an_edge_belongs_to_the_left_face(k):
    mesh = tube()
    result = mrc.optimize(surface_of(mesh), ring(2), options=mrc.Options(refinement=k, iterations=0 if k == 0 else 1))
    ends, count = result.edge_vertices, len(result.edge_vertices)
    rings = {a // 8 for a, _ in ends.tolist()} | {b // 8 for _, b in ends.tolist()}
    assert len(rings) == 1, "the best contour of this tube keeps to a ring"
    row = rings.pop()
    step = (ends[1, 1] - ends[0, 0]) % 8  # walking with the columns, the face above is on the left
    above = {f for f, face in enumerate(mesh.faces) if {v // 8 for v in face} == {row, row + 1}}
    below = {f for f, face in enumerate(mesh.faces) if {v // 8 for v in face} == {row - 1, row}}
    left = above if step in (1, 2) else below
    assert len(result.segment_faces) == count
    assert set(result.segment_faces.tolist()) <= left


def test_mask_of_hidden_faces_has_one_entry_per_face():
    mesh = tube()
    for mask in (np.zeros(3, bool), np.zeros((3, 2), bool)):
        with pytest.raises(ValueError, match="mask"):
            mrc.Surface(mesh.positions, *face_arrays(mesh), hidden_faces=mask)


def test_refined_result_along_hidden_faces_can_be_given_again():
    mesh = meshes.tube([1.3, 1.0, 0.7, 1.0, 1.3], 8)
    surface = surface_of(mesh, hidden_faces=np.arange(16, dtype=np.int32))
    options = mrc.Options(width=2, refinement=1)
    first = mrc.optimize(surface, ring(3), options=options)
    again = mrc.optimize(surface, first, options=options, scales=first.scales)
    assert again.objective <= first.objective + 1e-12


def test_open_refined_contour_may_begin_inside_an_edge():
    surface = surface_of(tube(split_fraction=1.0))
    points = [(16, 17), (17, 17), (18, 18), (19, 19)]
    for k in (0, 1, 2):
        result = mrc.optimize(
            surface,
            edge_vertices=points,
            edge_parameters=[0.5, 0, 0, 0],
            closed=False,
            options=mrc.Options(refinement=k, ends="vertices"),
        )
        assert result.status in ("improved", "unchanged")


def test_unmet_requirements_without_iterations_are_an_error():
    with pytest.raises(mrc.Infeasible, match="no iteration"):
        mrc.optimize(surface_of(tube()), ring(2), options=mrc.Options(iterations=0), required_vertices=[0])


def test_refined_phase_never_ends_above_the_given_contour():
    for seed in range(40):
        rng = np.random.default_rng(seed)
        mesh = meshes.tube(rng.uniform(0.7, 1.3, 6), 7, step=0.5, rng=rng, noise=0.1, split_fraction=0.5)
        given = meshes.zigzag_contour(rng, 7, 2, 4)
        options = mrc.Options(refinement=1, regular_iterations=2, width=2, max_turn=float(rng.uniform(0.8, 2.0)))
        result = mrc.optimize(surface_of(mesh), given, options=options)
        assert result.objective <= result.initial_objective + 1e-12 * result.scales.K


@pytest.mark.parametrize("answer", [False, np.bool_(False), 0])
def test_any_falsy_progress_result_cancels(answer):
    assert mrc.optimize(surface_of(tube()), ring(3), progress=lambda share: answer).status == "cancelled"
    assert mrc.optimize(surface_of(tube()), ring(3), progress=lambda share: None).status != "cancelled"


def test_refined_contour_across_barriers_at_a_vertex_is_refused():
    mesh, here = tube(), ring(2)
    after = np.roll(here, -1)
    # Every vertex, each followed by the midpoint of the next edge.
    ends = np.stack([here, here, here, after], axis=1).reshape(-1, 2)
    points = {"edge_vertices": ends, "edge_parameters": [0.0, 0.5] * 8}
    surface, options = surface_of(mesh), mrc.Options(refinement=1)
    for barriers in ([(19, 11)], [(19, 27)], [(19, 11), (20, 28)], [(19, 18), (19, 27)]):
        assert mrc.optimize(surface, **points, options=options, barriers=barriers).gap >= 0
    with pytest.raises(ValueError, match="barrier at vertex 19"):
        mrc.optimize(surface, **points, options=options, barriers=[(19, 11), (19, 27)])


@pytest.mark.parametrize("k", [1, 2])
def test_refined_whole_surface_search_follows_the_regular_result(k):
    """The whole refined graph would be too large: first the whole surface is searched along edges, then a refined
    band."""
    rows = np.arange(30)
    mesh = meshes.tube(1 - 0.3 * np.exp(-((rows - 22.3) ** 2)), 16, step=0.3)
    options = {"width": None, "refinement": k}
    result = mrc.optimize(surface_of(mesh), ring(4, 16), options=mrc.Options(**options))
    assert result.status == "improved"
    assert abs(result.positions[:, 2] / 0.3 - 22.3).max() < 1
    assert result.statistics["iterations"] == 2
    assert result.statistics["faces"] == 2 * 4 * 16


def test_contour_that_changes_sides_along_a_barrier_is_refused():
    mesh = meshes.tube([1.0] * 9, 12, step=0.5)
    grid = np.arange(9 * 12).reshape(9, 12)
    barrier = [(int(grid[4, c]), int(grid[4, c + 1])) for c in range(2, 7)]
    below, above = grid[3], grid[5]
    back = np.r_[grid[4, 4:6], below[5:]]
    across = np.r_[grid[4, 4:6], above[5:], grid[4, 11], below[11]]
    surface = surface_of(mesh)
    assert mrc.optimize(surface, np.r_[below[:5], back], barriers=barrier).gap >= 0
    for contour in (np.r_[below[:5], across], np.r_[below[:5], across][::-1].copy()):
        with pytest.raises(ValueError, match="crosses a barrier"):
            mrc.optimize(surface, contour, barriers=barrier)


@pytest.mark.parametrize("flow", ["harmonic", "gates", "arc_length"])
@pytest.mark.parametrize("k", [0, 1])
def test_random_barriers_are_never_crossed(flow, k):
    """With barriers on the contour and around it, a result that crossed one could not be given again."""
    searched = 0
    for seed in range(30):
        rng = np.random.default_rng([seed, k])
        mesh = meshes.tube(
            rng.uniform(0.7, 1.3, 13), 14, step=0.4, rng=rng, split_fraction=rng.choice([0.0, 1.0]), noise=0.05
        )
        contour = meshes.zigzag_contour(rng, 14, 5, 7)
        edges = mesh.real_edges()
        on = np.isin(edges, contour).any(axis=1)
        barriers = edges[on & (rng.random(len(edges)) < rng.choice([0.05, 0.2]))]
        open_contour = contour[:9].copy()
        for given, closed in ((contour, True), (open_contour, False)):
            options = mrc.Options(flow=flow, refinement=k, width=4, iterations=2, ends="vertices")
            try:
                result = mrc.optimize(surface_of(mesh), given, closed=closed, options=options, barriers=barriers)
            except ValueError:
                with pytest.raises(ValueError, match="barrier"):
                    mrc.optimize(surface_of(mesh), given, closed=closed, barriers=barriers)
                continue
            searched += 1
            assert result.objective <= result.initial_objective
            mrc.optimize(surface_of(mesh), result, options=options, barriers=barriers)
    assert searched >= 20


def test_curvature_with_vertices_exactly_on_the_disk_boundary():
    """A disk that touches only the corner of a triangle contains nothing of that triangle, rather than a full
    circle."""
    sphere = meshes.icosphere(2)
    lengths = np.linalg.norm(np.diff(sphere.positions[sphere.real_edges()], axis=1)[:, 0], axis=1)
    surface, h = surface_of(sphere), lengths.mean()
    for length in np.unique(lengths):
        for radius in (length / h * (1 - 1e-9), length / h, length / h * (1 + 1e-9)):
            curvature = mrc.curvature(surface, mrc.Options(curvature_radius=radius, curvature_smoothing=0.0))
            assert np.abs(curvature.kappa_max - 1).max() < 0.3


def test_lower_bound_is_not_above_a_returned_given_contour():
    """What is gained along mesh edges may be lost when it is measured with Steiner points."""
    mesh, contour = torus(np.random.default_rng(25))
    options = mrc.Options(width=3, refinement=2, regular_iterations=1, iterations=0)
    result = mrc.optimize(surface_of(mesh), contour, options=options)
    assert result.reason_code == "none_refined"
    assert result.lower_bound <= result.objective == result.initial_objective


def test_progress_result_without_truth_value_is_an_error():
    """An array with several elements is neither true nor false."""
    with pytest.raises(ValueError, match="truth"):
        mrc.optimize(surface_of(tube()), ring(3), progress=lambda share: np.zeros(2))
    with pytest.raises(ValueError, match="truth"):
        mrc.optimize_all(surface_of(tube()), [ring(3)], closed=[np.zeros(2)])


@pytest.mark.parametrize("name", ["anchor", "crease", "region_weight", "min_salience", "kappa0_factor", "length_bias"])
def test_weights_with_overflowing_products_are_refused(name):
    with pytest.raises(ValueError, match=f"{name}.*1e\\+50"):
        mrc.Options(**{name: 1e300})


@pytest.mark.parametrize("name", ["feature_exponent", "direction_exponent"])
def test_exponents_with_overflowing_powers_are_refused(name):
    mrc.Options(**{name: 16})
    with pytest.raises(ValueError, match=f"{name}.*16"):
        mrc.Options(**{name: 17})


def test_progress_never_decreases_for_any_number_of_iterations():
    shares = []
    options = mrc.Options(iterations=2**31 - 1, regular_iterations=2**31 - 1)
    mrc.optimize(surface_of(tube()), ring(3), options=options, progress=shares.append)
    assert shares == sorted(shares)
    assert shares[0] >= 0


@pytest.mark.parametrize("length", [2.52801656e-157, 10**-161.69115191986646])
def test_lengths_whose_squares_underflow_are_none(length):
    positions = np.zeros((8, 3))
    positions[0, 0] = length
    curvature = mrc.curvature(mrc.Surface(positions, [0, 4], [0, 1, 2, 3]), mrc.Options())
    for values in (curvature.kappa_min, curvature.kappa_max, curvature.direction_min, curvature.direction_max):
        assert np.isfinite(values).all()
