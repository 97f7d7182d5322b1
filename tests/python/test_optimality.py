# SPDX-License-Identifier: GPL-3.0-or-later
"""The result has the least ratio of all admissible contours of the band: compared with enumeration."""

from itertools import pairwise
from math import pi

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from brute_force import BruteForce
from conftest import surface_of
from search_space_checks import check_search_space

AFFORDABLE = 20000  # the maximum number of contours to enumerate in one band


def triangle_annulus(rng):
    rings, columns = int(rng.integers(3, 6)), int(rng.integers(5, 9))
    mesh = meshes.jittered_annulus(rng, rings, columns)
    return mesh, meshes.zigzag_contour(rng, columns, 1, rings - 2)


def mixed_annulus(rng):
    rings, columns = int(rng.integers(3, 6)), int(rng.integers(5, 9))
    mesh = meshes.jittered_annulus(rng, rings, columns, split_fraction=rng.uniform(0.2, 0.8))
    return mesh, meshes.zigzag_contour(rng, columns, 1, rings - 2)


def level_cylinder(rng):
    """Regular quads, sometimes with noise in the positions: in the harmonic flow every edge across the band is
    level."""
    rings, columns = int(rng.integers(3, 7)), int(rng.integers(5, 8))
    noise = rng.choice([0.0, 0.1])
    mesh = meshes.tube(rng.uniform(0.8, 1.4, rings), columns, step=rng.uniform(0.4, 1.0), rng=rng, noise=noise)
    return mesh, meshes.zigzag_contour(rng, columns, 1, rings - 2, step_chance=0.3)


def closed_torus(rng):
    """The band meets itself on the other side of the torus."""
    rows, columns = int(rng.integers(5, 8)), int(rng.integers(5, 8))
    mesh = meshes.torus(rows, columns, rng=rng, split_fraction=rng.choice([0.0, 0.5, 1.0]), noise=0.1)
    return mesh, meshes.zigzag_contour(rng, columns, 1, 3)


def long_tube(rng):
    """The mesh continues beyond the band, farther than anything that affects its scales and curvatures."""
    rows, columns = int(rng.integers(13, 17)), int(rng.integers(5, 8))
    mesh = meshes.tube(rng.uniform(0.8, 1.3, rows), columns, step=0.7, split_fraction=0.6, rng=rng, noise=0.08)
    return mesh, meshes.zigzag_contour(rng, columns, rows // 2 - 1, rows // 2 + 1)


def dead_end_arm(rng):
    """A ring of quads with a long ladder on its outer border: far out on it, every edge is level in the harmonic
    flow."""
    columns, length = 6, 20
    ring = meshes.tube(rng.uniform(0.9, 1.3, 3), columns, rng=rng, noise=0.05)
    foot = ring.positions[[12, 13]]
    steps = np.arange(1, length + 1)[:, None, None] * [0.0, 0.0, 0.5]
    arm = (foot + steps + 0.05 * rng.standard_normal((length, 2, 3))).reshape(-1, 3)
    numbers = np.concatenate([[12, 13], 18 + np.arange(2 * length)]).reshape(-1, 2)
    ladder = [(a, b, d, c) for (a, b), (c, d) in pairwise(numbers.tolist())]
    mesh = meshes.polygon_mesh(np.concatenate([ring.positions, arm]), list(ring.faces) + ladder)
    return mesh, columns + np.arange(columns, dtype=np.int32)


FAMILIES = {
    triangle_annulus: 60,
    mixed_annulus: 45,
    level_cylinder: 45,
    closed_torus: 30,
    long_tube: 30,
    dead_end_arm: 12,
}
CASES = [
    pytest.param(family, seed, id=f"{family.__name__}-{seed}", marks=[pytest.mark.slow] if seed >= 6 else [])
    for family, count in FAMILIES.items()
    for seed in range(count)
]


def random_options(rng, family, seed):
    widths = [None] if family is dead_end_arm else [1, 2, 3] if family is long_tube else [1, 2, 3, None]
    plain = rng.random() < 0.4
    options = {
        "width": widths[int(rng.integers(len(widths)))],
        "flow": ("gates", "arc_length", "harmonic")[seed % 3],
        "feature": ("valley", "ridge")[int(rng.integers(2))],
        "iterations": 1,
    }
    if not plain:
        options |= {
            "feature_exponent": rng.uniform(0.4, 2.0),
            "direction_exponent": rng.uniform(0.5, 3.0),
            "kappa0_factor": rng.uniform(0.5, 6.0),
            "curvature_radius": rng.uniform(0.7, 2.2),
            "curvature_smoothing": float(rng.choice([0.0, 0.4, 1.3])),
            "max_turn": rng.uniform(0.35 * pi, 0.8 * pi),
        }
    return options


def affordable_case(family, seed):
    """Draws random cases until the enumeration is affordable."""
    rng = np.random.default_rng([seed, sum(map(ord, family.__name__))])
    while True:
        mesh, contour = family(rng)
        options = random_options(rng, family, seed)
        surface = surface_of(mesh)
        space = mrc.search_space(surface, contour, closed=True, options=mrc.Options(**options))
        brute = BruteForce(mesh, contour, options, space)
        if brute.count() <= AFFORDABLE:
            return mesh, contour, options, surface, space, brute


def close(one, two, scale=0.0):
    return abs(one - two) <= 1e-10 * max(abs(one), abs(two), scale)


@pytest.mark.parametrize(("family", "seed"), CASES)
def test_optimum_matches_enumeration(family, seed):
    mesh, contour, options, surface, space, brute = affordable_case(family, seed)
    check_search_space(mesh, contour, space, options)
    check_scales(brute, mrc.optimize(surface, contour, options=mrc.Options(**options)).scales)
    check_same_graph(brute, space)

    result = mrc.optimize(surface, contour, closed=True, options=mrc.Options(**options))
    ratio, vertices, status = brute.best()
    tiny = 1e-4 * brute.energy.scale  # straight contours: their f is only a rounding error
    assert close(result.initial_ratio, brute.energy.ratio(contour), tiny)
    assert close(result.ratio, ratio, tiny), f"enumeration found {vertices}"
    assert close(brute.energy.ratio(result.vertices), ratio, tiny)
    if not close(ratio, result.initial_ratio, tiny):
        assert result.status == status


def check_scales(brute, scales):
    assert close(scales.h, brute.energy.h)
    assert close(scales.K, brute.energy.scale)
    assert close(scales.kappa_0, brute.energy.kappa_0)
    assert close(scales.L0, brute.energy.length)


def check_same_graph(brute, space):
    """Compares both graphs node by node and arc by arc, including f and g."""
    nodes = {(a, b) for a, b, _ in brute.nodes}
    names = [tuple(node) for node in space["nodes"].tolist()]
    assert set(names) == nodes
    expected = {(brute.nodes[i][:2], brute.nodes[j][:2]): (f, g) for i, arcs in brute.arcs.items() for j, f, g in arcs}
    found = {
        (names[i], names[j]): fg
        for (i, j), *fg in zip(space["arcs"].tolist(), space["f"].tolist(), space["g"].tolist(), strict=True)
    }
    assert set(found) == set(expected)
    for arc, (f, g) in found.items():
        assert close(f, expected[arc][0], brute.energy.scale * g), arc
        assert close(g, expected[arc][1])
