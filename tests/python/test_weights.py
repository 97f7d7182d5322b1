# SPDX-License-Identifier: GPL-3.0-or-later
"""The weights of the energy (attractors, anchor, crease, feature clamp, ridges) against the independent solver."""

from dataclasses import replace

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import realistic_contours, surface_of
from contour_energy import points_of
from random_cases import Case, annulus, chain, check_optimum, check_same_graph, cylinder, random_energy, seeds, torus

FAMILIES = [annulus, cylinder, torus, chain]


def attractors(rng, mesh):
    result = []
    for _ in range(int(rng.choice([1, 2, 30]))):
        strength = float(rng.choice([-2.0, 0.5, 3.0]))
        attractor = (int(rng.integers(len(mesh.positions))), float(rng.uniform(0.3, 4.0)), strength)
        result.append(attractor if rng.random() < 0.5 else (*attractor, float(rng.uniform(0.2, 3.0))))
    return result


def weight(rng, kind):
    return {
        "anchor": {"anchor": rng.uniform(0.1, 5.0)},
        "crease": {"crease": rng.uniform(0.1, 2.0)},
        "clamp": {"feature_clamp": rng.uniform(0.05, 0.9)},
        "ridge": {"feature": "ridge"},
        "attractors": {},
        "arcs": {"denominator": "arcs"},
    }[kind]


def weighted_case(kinds, k, seed):
    rng = np.random.default_rng([seed, k, *(ord(kind[0]) for kind in kinds)])
    family = FAMILIES[seed % 4]
    mesh, contour = family(rng)
    options = {"refinement": k, "width": int(rng.integers(1, 4)), "ends": "vertices", **random_energy(rng)}
    for kind in kinds:
        options |= weight(rng, kind)
    constraints = {"attractors": attractors(rng, mesh)} if "attractors" in kinds else {}
    return Case(mesh, contour, options, closed=family is not chain, dense="arcs" in kinds, **constraints)


def check(case):
    if not case.constraints:
        check_same_graph(case)
    check_optimum(case)


@pytest.mark.parametrize("kind", ["anchor", "crease", "clamp", "ridge", "attractors", "arcs"])
@seeds(60)
def test_one_weight_matches_the_independent_solver(kind, seed):
    check(weighted_case([kind], (0, 0, 1)[seed % 3], seed))


@seeds(20)
def test_several_weights_match_the_independent_solver(seed):
    rng = np.random.default_rng(seed)
    kinds = ["anchor", "crease", "clamp", "ridge", "attractors", "arcs"]
    check(weighted_case(list(rng.permutation(kinds)[: rng.integers(2, 6)]), (0, 1, 0, 2)[seed % 4], seed))


# ---- symmetries and guarantees

ALL = {
    "anchor": 0.5,
    "crease": 0.4,
    "feature_clamp": 0.3,
    "length_bias": 0.3,
    "length_floor": 0.7,
    "band_distance": 0.6,
}


def optimize(mesh, contour, pulls, scale=1.0, **options):
    options = mrc.Options(**{"flow": "harmonic", "width": 5, **ALL, **options})
    pulls = [(v, radius * scale, strength, *(s * scale for s in sigma)) for v, radius, strength, *sigma in pulls]
    return mrc.optimize(surface_of(mesh), contour, options=options, attractors=pulls)


@pytest.mark.parametrize("k", [0, 1])
@pytest.mark.parametrize("denominator", ["length", "arcs"])
def test_invariant_under_scaling_rigid_motion_and_reversal(realistic, k, denominator, rng):
    """The radius and sigma of attractors scale with the mesh; band_distance is relative and stays the same."""
    _, mesh, contour = realistic
    size, far = 41.0, float(np.ptp(mesh.positions)) / 3
    pulls = [(int(contour[0]), far, 1.5), (int(contour[len(contour) // 2]), far, -1.0, far / 3)]
    options = {"refinement": k, "denominator": denominator}
    options["length_measure"] = "edges" if denominator == "arcs" else "arc"
    base = optimize(mesh, contour, pulls, **options)
    big = optimize(mesh.moved(mesh.positions * size), contour, pulls, size, **options)
    assert set(points_of(big)) == set(points_of(base))
    assert big.ratio * (size if denominator == "length" else 1.0) == pytest.approx(base.ratio, rel=1e-8)
    assert big.objective == pytest.approx(base.objective, rel=1e-8)
    moved = optimize(meshes.rigidly_moved(mesh, rng), contour, pulls, **options)
    backwards = optimize(mesh, contour[::-1].copy(), pulls, **options)
    for other in (moved, backwards):
        assert set(points_of(other)) == set(points_of(base))
        assert other.objective == pytest.approx(base.objective, rel=1e-8)


def test_band_distance_is_in_average_radii():
    """It removes the same faces at every scale of the mesh, and at least some."""
    cut = 0
    for _, mesh, contour in realistic_contours():
        bands = []
        for size, distance in ((1.0, None), (1.0, 0.4), (41.0, 0.4), (1e-3, 0.4)):
            surface = surface_of(mesh.moved(mesh.positions * size))
            options = mrc.Options(width=6, band_distance=distance)
            bands.append(set(mrc.band(surface, contour, options=options).tolist()))
        assert bands[1] == bands[2] == bands[3]
        assert bands[1] <= bands[0]
        cut += bands[1] < bands[0]
    assert cut >= 20


def test_measure_matches_the_result_after_iterations(realistic):
    _, mesh, contour = realistic
    pulls = [(int(contour[0]), 1.0, 1.5)]
    for more in ({}, {"refinement": 2}, {"refinement": 1, "regular_iterations": 2}):
        result = optimize(mesh, contour, pulls, iterations=2, width=2, **more)
        options = mrc.Options(flow="harmonic", width=2, **ALL, refinement=more.get("refinement", 0))
        again = mrc.measure(surface_of(mesh), result, options=options, scales=result.scales, attractors=pulls)
        assert again.ratio == pytest.approx(result.ratio, rel=1e-12)
        assert again.objective == pytest.approx(result.objective, rel=1e-12)


def test_stronger_attractors_never_attract_less(realistic):
    """A stronger attractor never moves the contour to where it attracts less."""
    _, mesh, contour = realistic
    surface, options = surface_of(mesh), mrc.Options(flow="harmonic", width=3)
    space = mrc.search_space(surface, contour, options=options)
    center, radius = int(space["left"][-1][0]), float(np.ptp(mesh.positions)) / 4

    def felt(strength):
        """How much the result is attracted: minus the part of its numerator from an attractor of strength 1."""
        result = mrc.optimize(surface, contour, options=options, attractors=[(center, radius, strength)])
        plain, pulled = (
            mrc.measure(surface, result, options=options, scales=result.scales, attractors=pulls)
            for pulls in ((), [(center, radius, 1.0)])
        )
        return (plain.numerator - pulled.numerator) / plain.length

    amounts = [felt(strength) for strength in (-5.0, 0.0, 5.0, 50.0)]
    assert (np.diff(amounts) >= -1e-12 * max(map(abs, amounts))).all()


def test_attractors_out_of_reach_change_nothing(realistic):
    """Attractors that do not reach the band change nothing to the last bit, wherever they stand in the list."""
    _, mesh, contour = realistic
    radius = float(np.ptp(mesh.positions)) / 30
    band = band_vertices(mesh, contour, width=2)
    near = np.linalg.norm(mesh.positions[:, None] - mesh.positions[band], axis=2).min(axis=1) <= 1.001 * radius
    options = {"width": 2, "iterations": 1, "refinement": 1}
    everywhere, felt = (
        optimize(mesh, contour, [(v, radius, 0.2) for v in np.flatnonzero(kept)], **options)
        for kept in (np.ones(len(near), dtype=bool), near)
    )
    assert not near.all()
    assert points_of(everywhere) == points_of(felt)
    assert (everywhere.ratio, everywhere.objective) == (felt.ratio, felt.objective)


def band_vertices(mesh, contour, width):
    """The vertices of the band of a contour."""
    options = mrc.Options(**(ALL | {"width": width}))
    faces = mrc.band(surface_of(mesh), contour, options=options)
    return np.unique(np.concatenate([mesh.faces[face] for face in faces]))


def inside_out(mesh):
    """The same surface seen from the other side: convex becomes concave."""
    return replace(mesh, faces=tuple(face[::-1] for face in mesh.faces), triangles=mesh.triangles[:, ::-1].copy())


@pytest.mark.parametrize("k", [0, 1])
@pytest.mark.parametrize("features", [("ridge", "valley"), ("valley", "ridge")])
def test_ridge_is_a_valley_seen_from_the_other_side(realistic, features, k):
    _, mesh, contour = realistic
    one, two = (
        mrc.optimize(surface_of(m), contour, options=mrc.Options(flow="harmonic", feature=feature, refinement=k))
        for m, feature in zip((mesh, inside_out(mesh)), features, strict=True)
    )
    assert points_of(one) == points_of(two)
    assert two.ratio == pytest.approx(one.ratio, rel=1e-9, abs=1e-12 / one.scales.L0)
    assert two.scales.kappa_0 == pytest.approx(one.scales.kappa_0, rel=1e-9)
