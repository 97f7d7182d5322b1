# SPDX-License-Identifier: GPL-3.0-or-later
"""The region term (6.1.2): line integrals equal sums over the faces between two contours, by a discrete Stokes'
theorem."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from contour_energy import points_of, vertex

ROWS, COLUMNS = 9, 7


def random_tube(seed):
    rng = np.random.default_rng(seed)
    mesh = meshes.tube(
        rng.uniform(0.7, 1.3, ROWS),
        COLUMNS,
        step=0.6,
        split_fraction=float(rng.choice([0.0, 0.5, 1.0])),
        rng=rng,
        noise=0.05,
    )
    return rng, mesh


def areas(mesh):
    """The size of the vector area of each polygon."""
    result = []
    for face in mesh.faces:
        points = mesh.positions[np.asarray(face)]
        result.append(
            np.linalg.norm(np.cross(points - points[0], np.roll(points, -1, axis=0) - points[0]).sum(axis=0)) / 2
        )
    return np.array(result)


def enclosed_change(surface, density, given, contour, options, **to):
    """The change of the integral on the left, according to `mrcontour.measure`."""
    scales = mrc.optimize(surface, given, options=mrc.Options(iterations=0)).scales
    with_term = mrc.measure(surface, contour, options=options, scales=scales, region_density=density, **to)
    without = mrc.measure(surface, contour, options=options, scales=scales, **to)
    return (with_term.numerator - without.numerator) * scales.L0 / (scales.K * options.region_weight)


def faces_between(mesh, low, high):
    """The faces reachable from above the lower contour without crossing either contour."""
    fence = {frozenset(edge) for c in (low, high) for edge in zip(c, np.roll(c, -1))}
    beside = {}
    for f, face in enumerate(mesh.faces):
        for a, b in zip(face, np.roll(face, -1)):
            beside.setdefault(frozenset((int(a), int(b))), []).append(f)
    neighbors = [[] for _ in mesh.faces]
    for edge, faces in beside.items():
        if len(faces) == 2 and edge not in fence:
            neighbors[faces[0]].append(faces[1])
            neighbors[faces[1]].append(faces[0])
    below = {f for f, face in enumerate(mesh.faces) if min(face) < COLUMNS}  # at the lower border
    above = {f for f, face in enumerate(mesh.faces) if max(face) >= COLUMNS * (ROWS - 1)}
    outside, stack = below | above, [*(below | above)]
    while stack:
        for other in neighbors[stack.pop()]:
            if other not in outside:
                outside.add(other)
                stack.append(other)
    return [f for f in range(len(mesh.faces)) if f not in outside]


@pytest.mark.parametrize("seed", range(20))
def test_line_integral_equals_the_enclosed_sum(seed):
    rng, mesh = random_tube(seed)
    surface = surface_of(mesh)
    density = rng.uniform(-1.0, 2.0, len(mesh.faces))
    low = meshes.zigzag_contour(rng, COLUMNS, 1, 3)
    high = meshes.zigzag_contour(rng, COLUMNS, 5, 7)
    expected = (density * areas(mesh))[faces_between(mesh, low, high)].sum()
    options = mrc.Options(region_weight=2.5)
    change = enclosed_change(surface, density, low, high, options)
    assert abs(abs(change) - abs(expected)) <= 1e-10 * (1 + abs(expected))
    # In the other direction the same faces are lost; seen from the right, the sign changes.
    assert change + enclosed_change(surface, density, high, low, options) == pytest.approx(0.0, abs=1e-10)
    right = mrc.Options(region_weight=2.5, region_side="right")
    assert change + enclosed_change(surface, density, low, high, right) == pytest.approx(0.0, abs=1e-10)


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("k", [0, 1, 2])
def test_result_matches_measure(seed, k):
    """The term in the band of the last iteration is the change since the first given contour, whatever the band."""
    rng, mesh = random_tube(100 + seed)
    surface = surface_of(mesh)
    density = rng.uniform(0.0, 2.0, len(mesh.faces))
    options = mrc.Options(refinement=k, iterations=3, width=2, region_weight=float(rng.uniform(-4, 4)))
    given = meshes.zigzag_contour(rng, COLUMNS, 3, 5)
    result = mrc.optimize(surface, given, options=options, region_density=density)
    measured = mrc.measure(surface, result, options=options, scales=result.scales, region_density=density)
    assert measured.ratio == pytest.approx(result.ratio, rel=1e-10)
    assert np.all(np.diff(result.history) <= 1e-12 * np.abs(result.history[:-1]))


@pytest.mark.parametrize("k", [0, 1])
@pytest.mark.parametrize("seed", range(20))
def test_reversing_the_contour_and_the_side_together_changes_nothing(seed, k):
    rng, mesh = random_tube(200 + seed)
    surface = surface_of(mesh)
    density = rng.uniform(0.0, 2.0, len(mesh.faces))
    given = meshes.zigzag_contour(rng, COLUMNS, 3, 5)
    left, right = (mrc.Options(refinement=k, region_weight=3.0, region_side=side) for side in ("left", "right"))
    one = mrc.optimize(surface, given, options=left, region_density=density)
    two = mrc.optimize(surface, given[::-1], options=right, region_density=density)
    assert set(points_of(one)) == set(points_of(two))
    assert one.ratio == pytest.approx(two.ratio, rel=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("k", [0, 1])
@pytest.mark.parametrize("denominator", ["length", "arcs"])
def test_invariant_under_scaling_rigid_motion_and_reversal(realistic, k, denominator, rng):
    """The density is per area and weighted in units of the scales, so the result does not depend on the size of the
    mesh. Reversal takes the side along; changing only the side changes the sign."""
    _, mesh, contour = realistic
    density = np.array([np.sin(5 * mesh.positions[face[0]]).sum() for face in mesh.faces])
    size = 23.0 if denominator == "length" else 1.0

    def optimize(mesh, contour, side="left", weight=8.0):
        options = mrc.Options(
            flow="harmonic", refinement=k, denominator=denominator, region_weight=weight, region_side=side
        )
        return mrc.optimize(surface_of(mesh), contour, options=options, region_density=density)

    base = optimize(mesh, contour)
    for other, factor in (
        (optimize(mesh.moved(mesh.positions * 23.0), contour), size),
        (optimize(meshes.rigidly_moved(mesh, rng), contour), 1.0),
        (optimize(mesh, contour[::-1].copy(), side="right"), 1.0),
        (optimize(mesh, contour, side="right", weight=-8.0), 1.0),
    ):
        assert set(points_of(other)) == set(points_of(base))
        assert other.ratio * factor == pytest.approx(base.ratio, rel=1e-8)


def test_density_attracts_and_repels():
    """On a plain cylinder only the region term moves a ring: towards the gain, as far as the band reaches."""
    mesh = meshes.tube([1.0] * ROWS, 8)
    surface = surface_of(mesh)
    given = 4 * 8 + np.arange(8)
    density = np.ones(len(mesh.faces))
    rows = {}
    for weight in (-5.0, 0.0, 5.0):
        options = mrc.Options(region_weight=weight, width=2)
        result = mrc.optimize(surface, given, options=options, region_density=density)
        rows[weight] = set((result.vertices // 8).tolist())
    assert rows[0.0] == {4}
    assert sorted([rows[-5.0], rows[5.0]], key=min) == [{2}, {6}]


@pytest.mark.parametrize("height", [-0.6, 0.0, 0.5, 0.8])
def test_everything_between_two_contours_of_a_closed_body_counts(height):
    """However far they are from both contours: each contour divides a ball into two parts."""
    mesh = meshes.icosphere(3)
    surface, low = surface_of(mesh), -0.8
    contours = [max(meshes.plane_contours(mesh, [0.0, 0.0, 1.0], z), key=len) for z in (low, height)]
    density = 1 + mesh.positions[[face[0] for face in mesh.faces], 0]
    centers = np.array([mesh.positions[list(face)].mean(axis=0)[2] for face in mesh.faces])
    between = (density * areas(mesh))[(centers > low) & (centers <= height)].sum()
    change = enclosed_change(surface, density, *contours, mrc.Options(region_weight=1.0))
    assert change == pytest.approx(-between, rel=1e-10)


@pytest.mark.parametrize("weight", [-0.05, -1.0])
def test_measure_agrees_on_a_contour_across_a_closed_body(weight):
    mesh = meshes.icosphere(3)
    groove = np.exp(-(((mesh.positions[:, [2]] - 0.8) / 0.12) ** 2))
    mesh = mesh.moved(mesh.positions * (1 - 0.25 * groove))
    surface, density = surface_of(mesh), np.ones(len(mesh.faces))
    given = max(meshes.plane_contours(mesh, [0.0, 0.0, 1.0], -0.8), key=len)
    options = mrc.Options(flow="harmonic", width=None, region_weight=weight)
    result = mrc.optimize(surface, given, options=options, region_density=density)
    assert result.positions[:, 2].mean() > 0.5
    measured = mrc.measure(surface, result, options=options, scales=result.scales, region_density=density)
    assert measured.ratio == pytest.approx(result.ratio, rel=1e-10)
    again = mrc.optimize(surface, result, options=options, scales=result.scales, region_density=density)
    assert again.initial_ratio == pytest.approx(result.ratio, rel=1e-10)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("k", [0, 1])
def test_numbering_does_not_matter(seed, k):
    rng, mesh = random_tube(seed)
    given, density = meshes.zigzag_contour(rng, COLUMNS, 3, 5), rng.uniform(-1, 1, len(mesh.faces))
    other, number = meshes.renumbered(mesh, rng)
    place = {frozenset(face): i for i, face in enumerate(other.faces)}
    moved = np.empty_like(density)
    for face, value in zip(mesh.faces, density, strict=True):
        moved[place[frozenset(number[list(face)].tolist())]] = value
    options = mrc.Options(region_weight=3.0, refinement=k, width=2, iterations=2)
    one = mrc.optimize(surface_of(mesh), given, options=options, region_density=density)
    two = mrc.optimize(surface_of(other), number[given].astype(np.int32), options=options, region_density=moved)
    assert two.objective == pytest.approx(one.objective, rel=1e-9)
    assert {vertex(number[p[0]]) if p[2] == 0 else None for p in points_of(one)} == {
        p if p[2] == 0 else None for p in points_of(two)
    }


def test_bad_densities_are_refused():
    mesh = meshes.tube([1.0, 0.8, 1.0], 6)
    surface, ring = surface_of(mesh), 6 + np.arange(6)
    for density in (np.ones(3), np.full(len(mesh.faces), np.nan), np.ones((len(mesh.faces), 2))):
        with pytest.raises(ValueError, match="densit"):
            mrc.optimize(surface, ring, region_density=density)
    with pytest.raises(ValueError, match="closed"):
        mrc.optimize(surface, ring[:4], closed=False, region_density=np.ones(len(mesh.faces)))
