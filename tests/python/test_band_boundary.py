# SPDX-License-Identifier: GPL-3.0-or-later
"""The optimum may lie on the boundary of the band: the innermost and outermost contours are searched, too."""

import meshes
import numpy as np
import pytest
from contour_energy import points_of, vertex
from random_cases import Case, check_optimum

FLOWS = ["gates", "arc_length", "harmonic"]


def funnel(rng, rows, corner):
    """Quads and triangles around a cone that opens more widely from one ring on, its only concave place. The rings
    above are wider, those below narrower."""
    columns = int(rng.integers(9, 13))
    slopes = np.where(np.arange(rows) < corner, rng.uniform(0.02, 0.15), rng.uniform(0.9, 1.5))
    step = 2 * np.pi / columns * rng.uniform(0.7, 1.0)
    radius = 1.0 + step * np.concatenate([[0.0], np.cumsum(slopes[:-1])])
    mesh = meshes.tube(radius / radius[corner], columns, step / radius[corner], rng.choice([0.0, 0.5, 1.0]), rng)
    x, y, z = mesh.positions.T
    lean = rng.uniform(0.0, 0.2)
    return mesh.moved(np.stack([x, y, z + lean * x], axis=-1)), columns


@pytest.mark.slow
@pytest.mark.parametrize("k", [0, 1, 2])
@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("seed", range(3))
def test_finds_an_optimum_on_the_band_boundary(seed, flow, side, k):
    """The concave ring is the widest of the band (with the given contour below it) or the narrowest."""
    width = 1 + seed % 3
    given, rows = width + 3, 2 * width + 7
    corner = given + side * width
    mesh, columns = funnel(np.random.default_rng([20 + seed, side + 1]), rows, corner)
    ring = given * columns + np.arange(columns)
    case = Case(mesh, ring, {"width": width, "flow": flow, "refinement": k})
    border = case.space["left" if side > 0 else "right"][width]
    assert set((border // columns).tolist()) == {corner}
    result = check_optimum(case) if k < 2 else case.optimize()
    assert result.ratio < 0
    expected = case.dense([vertex(corner * columns + c) for c in range(columns)])
    assert set(points_of(result)) == set(expected)
