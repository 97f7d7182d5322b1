# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetries and guarantees of `optimize` that can be tested without a second solver, on realistic contours."""

import itertools
from dataclasses import replace

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from brute_force import same_cycle
from conftest import realistic_contours, surface_of
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

HARMONIC = mrc.Options(width=4, flow="harmonic")


def optimize(mesh, contour, options=HARMONIC, **keywords):
    return mrc.optimize(surface_of(mesh), contour, closed=True, options=options, **keywords)


def same_answer(one, two, vertices=None):
    """Whether two results have the same contour (after renumbering by `vertices`) and the same ratio."""
    expected = one.vertices if vertices is None else vertices[one.vertices]
    return (
        same_cycle(expected, two.vertices)
        and one.status == two.status
        and two.ratio == pytest.approx(one.ratio, rel=1e-8, abs=1e-12 / one.scales.L0)
    )


def test_realistic_contours_are_numerous():
    assert len(realistic_contours()) >= 20
    found = [optimize(mesh, contour).status for _, mesh, contour in realistic_contours()]
    assert found.count("improved") >= 15


@pytest.mark.parametrize("size", [1e-3, 2e4])
def test_scaling_divides_the_ratio(realistic, size):
    _, mesh, contour = realistic
    base, scaled = optimize(mesh, contour), optimize(mesh.moved(mesh.positions * size), contour)
    assert same_cycle(base.vertices, scaled.vertices)
    assert scaled.ratio * size == pytest.approx(base.ratio, rel=1e-8)
    assert scaled.initial_ratio * size == pytest.approx(base.initial_ratio, rel=1e-8)


def test_rigid_motion_changes_nothing(realistic, rng):
    _, mesh, contour = realistic
    assert same_answer(optimize(mesh, contour), optimize(meshes.rigidly_moved(mesh, rng), contour))


def test_rigid_motion_of_a_regular_grid_changes_nothing(rng):
    """With equal edges, many distances are exactly at a limit, such as the 3 sigma of smoothing. Rounding must not
    decide."""
    mesh = meshes.square_prism(6, 15)
    contour = meshes.zigzag_contour(rng, 24, 5, 9)
    options = mrc.Options(width=3, flow="harmonic", feature="ridge")
    base = optimize(mesh, contour, options)
    for _ in range(30):
        moved = optimize(meshes.rigidly_moved(mesh, rng), contour, options)
        scales = moved.scales
        assert scales.h == pytest.approx(base.scales.h, rel=1e-12)
        assert abs(scales.K / base.scales.K - 1) < 1e-10
        assert moved.ratio == pytest.approx(base.ratio, rel=1e-10)


def test_reversal_reverses_the_result(realistic):
    _, mesh, contour = realistic
    base, backwards = optimize(mesh, contour), optimize(mesh, contour[::-1].copy())
    assert same_cycle(base.vertices, backwards.vertices[::-1])
    assert backwards.ratio == pytest.approx(base.ratio, rel=1e-10)


def test_cyclic_shift_changes_nothing(realistic, rng):
    _, mesh, contour = realistic
    assert same_answer(optimize(mesh, contour), optimize(mesh, np.roll(contour, rng.integers(1, len(contour)))))


def test_renumbering_changes_nothing(realistic, rng):
    _, mesh, contour = realistic
    other, number = meshes.renumbered(mesh, rng)
    assert same_answer(optimize(mesh, contour), optimize(other, number[contour]), number)


@pytest.mark.parametrize("flow", ["gates", "arc_length", "harmonic"])
@pytest.mark.parametrize("seed", range(20))
def test_triangulation_of_planar_quads_does_not_matter(flow, seed):
    rng = np.random.default_rng(seed)
    mesh = meshes.trapezoid_tube(rng, 14, 11)
    flipped = meshes.polygon_mesh(mesh.positions, mesh.faces, meshes.random_flips(mesh.faces, rng))
    assert (flipped.triangles != mesh.triangles).any()
    contour = meshes.zigzag_contour(rng, 11, 5, 8)
    options = mrc.Options(width=3, flow=flow)
    assert same_answer(optimize(mesh, contour, options), optimize(flipped, contour, options))


@pytest.mark.parametrize(
    "options",
    [
        {"flow": "gates"},
        {"flow": "harmonic", "width": 2, "iterations": 4},
        {"flow": "arc_length", "width": None, "feature": "ridge", "iterations": 2},
        {"flow": "gates", "width": None},
        {"flow": "harmonic", "feature_exponent": 0.5, "direction_exponent": 2.0},
    ],
)
def test_result_keeps_its_guarantees(realistic, options):
    _, mesh, contour = realistic
    surface, options = surface_of(mesh), mrc.Options(**options)
    result = mrc.optimize(surface, contour, options=options)
    assert result.status in ("improved", "unchanged")
    assert result.objective <= result.initial_objective
    assert (np.diff(result.history) <= 0).all()
    assert result.history[-1] == result.objective
    if result.status == "unchanged":
        assert same_cycle(result.vertices, contour)
        assert result.reason
    else:
        assert result.ratio < result.initial_ratio
        assert result.salience == pytest.approx(-result.ratio / result.scales.K, rel=1e-12)
    rounding = 1e-12 * abs(result.ratio) + 1e-15
    assert 0 <= result.gap <= rounding
    assert result.lower_bound <= result.ratio + rounding

    again = mrc.measure(surface, result.vertices, options=options, scales=result.scales)
    assert again.ratio == pytest.approx(result.ratio, rel=1e-12)
    assert again.numerator / again.length == pytest.approx(again.ratio, rel=1e-12)
    given = mrc.measure(surface, contour, options=options)
    assert given.ratio == pytest.approx(result.initial_ratio, rel=1e-12)
    assert given.length == pytest.approx(result.scales.L0, rel=1e-12)


@pytest.mark.parametrize("flow", ["gates", "arc_length", "harmonic"])
def test_result_winds_once_around_its_band(realistic, flow):
    """The result is simple, follows real edges of the band, and its increments sum to one."""
    _, mesh, contour = realistic
    surface, options = surface_of(mesh), mrc.Options(width=4, flow=flow)
    loop = mrc.optimize(surface, contour, options=options).vertices.tolist()
    space = mrc.search_space(surface, contour, options=options)
    assert len(set(loop)) == len(loop) >= 3
    assert sorted(space["faces"].tolist()) == sorted(mrc.band(surface, contour, options=options).tolist())
    real = [edge for edge, diagonal in zip(space["edges"].tolist(), space["diagonal"], strict=True) if not diagonal]
    assert {tuple(sorted(edge)) for edge in real} <= set(map(tuple, mesh.real_edges().tolist()))
    form = dict(zip(map(tuple, space["edges"].tolist()), space["increments"].tolist(), strict=True))
    form |= {(b, a): -increment for (a, b), increment in form.items()}
    edges = list(zip(loop, loop[1:] + loop[:1], strict=True))
    assert all(tuple(sorted(edge)) in {tuple(sorted(e)) for e in real} for edge in edges)
    assert sum(form[edge] for edge in edges) == pytest.approx(1, abs=1e-9)


def test_result_length_and_positions_match_its_contour(realistic):
    _, mesh, contour = realistic
    surface = surface_of(mesh)
    result = mrc.optimize(surface, contour, options=HARMONIC)
    points = mesh.positions[result.vertices]
    assert np.array_equal(result.positions, points)
    length = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum()
    assert mrc.measure(surface, result.vertices, options=HARMONIC).length == pytest.approx(length, rel=1e-12)


def test_wider_bands_contain_narrower_ones(realistic):
    """The scales and the ratio of the given contour do not depend on the width. (The best ratio may become better or
    worse: a wider band has a different flow, in which different contours are monotone.)"""
    _, mesh, contour = realistic
    surface = surface_of(mesh)
    faces, results = [], []
    for width in (1, 2, 4, 7, None):
        options = mrc.Options(width=width, flow="harmonic")
        faces.append(set(mrc.band(surface, contour, options=options).tolist()))
        results.append(mrc.optimize(surface, contour, options=options))
    assert all(narrow <= wide for narrow, wide in itertools.pairwise(faces))
    assert len({result.initial_ratio for result in results}) == 1
    assert len({(r.scales.h, r.scales.K, r.scales.L0, r.scales.kappa_0) for r in results}) == 1


def test_hiding_faces_outside_the_band_changes_nothing(realistic, rng):
    _, mesh, contour = realistic
    base = optimize(mesh, contour)
    outside = np.setdiff1d(np.arange(len(mesh.faces)), mrc.band(surface_of(mesh), contour, options=HARMONIC))
    for hidden in (outside, outside[rng.random(len(outside)) < 0.5]):
        surface = surface_of(mesh, hidden_faces=hidden.astype(np.int32))
        result = mrc.optimize(surface, contour, options=HARMONIC)
        assert np.array_equal(result.vertices, base.vertices)
        assert (result.ratio, result.initial_ratio) == (base.ratio, base.initial_ratio)


def test_results_are_reproducible_bit_for_bit(realistic):
    _, mesh, contour = realistic
    surface = surface_of(mesh)
    results = [mrc.optimize(surface, contour, options=HARMONIC) for _ in range(2)] + [optimize(mesh, contour)]
    assert len({(r.vertices.tobytes(), r.positions.tobytes(), r.ratio, tuple(r.history)) for r in results}) == 1


def test_iterations_equal_single_runs_with_the_first_scales(realistic):
    _, mesh, contour = realistic
    surface = surface_of(mesh)
    once, twice = mrc.Options(width=2, flow="harmonic"), mrc.Options(width=2, flow="harmonic", iterations=2)
    first = mrc.optimize(surface, contour, options=once)
    second = mrc.optimize(surface, first.vertices, options=once, scales=first.scales)
    both = mrc.optimize(surface, contour, options=twice)
    assert same_cycle(second.vertices, both.vertices)
    assert both.ratio == pytest.approx(second.ratio, rel=1e-12)


def test_salience_belongs_to_the_best_contour_found():
    """Later iterations that find only worse contours change neither the result nor its salience."""
    options, settled = {"flow": "gates", "width": 8, "length_bias": 2.0, "anchor": 1.0}, 0
    for _, mesh, contour in realistic_contours():
        surface = surface_of(mesh)
        once, more = (mrc.optimize(surface, contour, options=mrc.Options(**options, iterations=i)) for i in (1, 3))
        if once.status == "improved" and more.objective == once.objective:
            settled += 1
            assert more.salience == once.salience
    assert settled >= 20


@pytest.mark.parametrize("flow", ["gates", "arc_length", "harmonic"])
def test_result_along_hidden_faces_can_be_given_again(flow):
    """The best ring runs along hidden faces, so its band can grow only on one side; still it can be given again."""
    mesh = meshes.tube([1.3, 1.0, 0.7, 1.0, 1.3], 8)
    surface = surface_of(mesh, hidden_faces=np.arange(16, dtype=np.int32))
    options = mrc.Options(width=2, flow=flow)
    result = mrc.optimize(surface, 24 + np.arange(8), options=options)
    assert same_cycle(result.vertices, 16 + np.arange(8))
    assert mrc.measure(surface, result.vertices, options=options, scales=result.scales).ratio == result.ratio
    twice = mrc.optimize(surface, 24 + np.arange(8), options=mrc.Options(width=2, flow=flow, iterations=2))
    assert same_cycle(twice.vertices, result.vertices)


@pytest.mark.parametrize("flow", ["gates", "arc_length", "harmonic"])
def test_no_result_runs_along_the_mesh_border(flow):
    """The ring at the border has the least ratio, but is no boundary between parts, and nothing could be cut off
    there."""
    mesh = meshes.tube([0.7, 0.7, 1.0, 1.1], 8)
    given = 16 + np.arange(8)
    result = mrc.optimize(surface_of(mesh), given, options=mrc.Options(width=3, flow=flow, iterations=3))
    assert result.vertices.min() >= 8
    with pytest.raises(ValueError, match="border"):
        mrc.measure(surface_of(mesh), np.arange(8))


def test_progress_is_called_and_can_cancel(realistic):
    _, mesh, contour = realistic
    heard = []
    optimize(mesh, contour, progress=lambda fraction: heard.append(fraction) or True)
    assert heard
    assert all(0 <= fraction <= 1 for fraction in heard)
    assert heard == sorted(heard)
    assert optimize(mesh, contour, progress=lambda fraction: False).status == "cancelled"
    with pytest.raises(ZeroDivisionError):
        optimize(mesh, contour, progress=lambda fraction: 1 // 0)


def test_progress_has_three_phases_per_iteration(realistic):
    """The phases are patches, bands and searches. After a phase that ends early, progress continues at the next
    phase."""
    _, mesh, contour = realistic
    surface, heard = surface_of(mesh), []
    for options in ({"iterations": 1}, {"iterations": 2, "regular_iterations": 2, "refinement": 1}):
        total = 3 * (options["iterations"] + options.get("regular_iterations", 0))
        heard.clear()
        mrc.optimize(surface, contour, options=mrc.Options(**options), progress=heard.append)
        assert heard == sorted(heard)
        phases = [round(total * fraction, 9) for fraction in dict.fromkeys(heard)]
        assert phases[:3] == [0, 1, 2]
        assert phases[-1] == total
        assert set(phases) <= set(range(total + 1))


def test_cancelling_in_any_phase_changes_nothing(realistic):
    _, mesh, contour = realistic
    surface, options = surface_of(mesh), mrc.Options(iterations=2)
    fractions = []
    mrc.optimize(surface, contour, options=options, progress=fractions.append)
    for fraction in dict.fromkeys(fractions):
        result = mrc.optimize(
            surface, contour, options=options, progress=lambda done, fraction=fraction: done < fraction
        )
        assert result.status == "cancelled"
        assert result.vertices.tolist() == contour.tolist()
        assert result.objective == result.initial_objective


def test_triangle_arrays_need_no_offsets(realistic):
    _, mesh, contour = realistic
    triangles = replace(mesh, faces=tuple(map(tuple, mesh.triangles.tolist())))
    one = mrc.optimize(mrc.Surface(mesh.positions, None, mesh.triangles), contour, options=HARMONIC)
    assert same_answer(optimize(triangles, contour), one)


def test_iterations_go_on_where_the_first_band_has_nothing_concave():
    """The second reaches the groove, of which the first sees nothing."""
    rows, around = 121, 64
    height = np.linspace(-2, 2, rows)
    mesh = meshes.tube(1 - 0.3 * np.exp(-60 * (height - 0.2) ** 2), around, step=4 / (rows - 1))
    groove = int(np.argmin(abs(height - 0.2)))
    given = (groove - 6) * around + np.arange(around)
    once, twice = (
        mrc.optimize(surface_of(mesh), given, options=mrc.Options.recommended(iterations=count)) for count in (1, 2)
    )
    assert (once.status, once.reason_code) == ("unchanged", "not_salient")
    assert twice.status == "improved"
    assert set(twice.vertices // around) == {groove}


# ---- onto a tip


def cut_off(mesh, loop):
    """The number of triangles on the smaller side of a loop along edges."""
    owners = {}
    for number, triangle in enumerate(mesh.triangles.tolist()):
        for pair in zip(triangle, np.roll(triangle, -1).tolist(), strict=True):
            owners.setdefault(frozenset(pair), []).append(number)
    walls = {frozenset(pair) for pair in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True)}
    pairs = np.array([pair for edge, pair in owners.items() if len(pair) == 2 and edge not in walls])
    count = len(mesh.triangles)
    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(count, count))
    return np.bincount(connected_components(graph, directed=False)[1]).min()


# Options.recommended, without what says that nothing is concave
RECOMMENDED = {"iterations": 2, "length_bias": 2.0, "length_floor": 0.5, "anchor": 0.5, "feature_clamp": 0.9}


def egg_loops():
    """Loops around both ends of a smooth egg, where nothing is concave."""
    rng = np.random.default_rng(3)
    egg = meshes.icosphere(4)
    egg = egg.moved(egg.positions * [0.6, 0.7, 1.5] + 0.002 * rng.standard_normal(egg.positions.shape))
    for end in (-1.0, 1.0):
        for height in (0.3, 0.9, 1.2, 1.4, 1.47):
            yield egg, meshes.plane_contours(egg, np.array([0.1, 0.0, end]), height)[0]


@pytest.mark.parametrize("refinement", [0, 1])
@pytest.mark.parametrize("width", [None, 8])
def test_a_loop_that_slips_onto_a_tip_is_no_improvement(width, refinement):
    options = mrc.Options(**RECOMMENDED | {"width": width, "refinement": refinement})
    reasons = []
    for egg, loop in egg_loops():
        result = optimize(egg, loop, options)
        reasons.append(result.reason_code)
        if result.status == "improved":
            if refinement == 0:
                left = cut_off(egg, result.vertices)
                assert left >= min(0.004 * len(egg.triangles), cut_off(egg, np.array(loop))) or result.salience >= 0.25
        elif result.reason_code == "slipped_off":
            assert result.vertices.tolist() == list(loop)
            assert (result.objective, result.ratio) == (result.initial_objective, result.initial_ratio)
            assert "tip" in result.reason
    assert "slipped_off" in reasons
