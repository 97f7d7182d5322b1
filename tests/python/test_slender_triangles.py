# SPDX-License-Identifier: GPL-3.0-or-later
"""Neither curvature nor contour depends on how a straight part is cut up, as in CAD and STL meshes, whose triangles
reach far along it."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

STEPS = (200.0, 20.0, 2.0, 0.5)  # between the rings of the straight parts; the first leaves them whole
PROFILES = {  # radius and height between two shafts
    "fillet": [(5.0, 0.0), (4.6, 0.1), (4.1, 0.4), (3.7, 1.0), (3.5, 2.0)],
    "shoulder": [(5.0, 0.0), (4.5, 0.0), (4.0, 0.0), (3.5, 0.0)],
    "groove": [(5.0, 0.0), (4.4, 0.2), (4.2, 0.7), (4.4, 1.2), (5.0, 1.4)],
}


def turned(profile, step, around, triangles):
    """A part between two shafts 200 long, and the numbers of the vertices of the part, ring by ring."""
    away = np.arange(step, 200.0 + step / 2, step)
    below = [(profile[0][0], profile[0][1] - z) for z in away[::-1]]
    above = [(profile[-1][0], profile[-1][1] + z) for z in away]
    radius, height = np.array([*below, *profile, *above]).T
    angle = 2 * np.pi * np.arange(around) / around
    x, y = (np.outer(radius, f(angle)) for f in (np.cos, np.sin))
    positions = np.stack([x, y, np.repeat(height, around).reshape(x.shape)], axis=-1).reshape(-1, 3)
    faces = meshes.grid_faces(len(radius), around, closed_columns=True)
    if triangles:
        faces = [corner for a, b, c, d in faces for corner in ((a, b, c), (a, c, d))]
    ring = len(below) * around
    return meshes.polygon_mesh(positions, faces), ring + np.arange(len(profile) * around).reshape(-1, around)


@pytest.fixture(scope="module", params=[(64, True), (64, False), (128, True)], ids=["triangles", "quads", "finer"])
def cut_up(request):
    """The parts by name, each cut up in all ways."""
    return {name: [turned(profile, step, *request.param) for step in STEPS] for name, profile in PROFILES.items()}


@pytest.mark.parametrize("name", PROFILES)
def test_curvature_does_not_depend_on_how_far_triangles_reach(cut_up, name):
    found = [mrc.curvature(surface_of(mesh)).kappa_min[part] for mesh, part in cut_up[name]]
    assert found[0].min() < -0.4
    for other in found[1:]:
        assert other == pytest.approx(found[0], rel=0.05, abs=0.01)


@pytest.mark.parametrize("k", [0, 2])
@pytest.mark.parametrize("name", PROFILES)
def test_contour_does_not_depend_on_how_far_triangles_reach(cut_up, name, k):
    options = mrc.Options.recommended(refinement=k)
    found = [mrc.optimize(surface_of(mesh), part[0], options=options) for mesh, part in cut_up[name]]
    for result in found:
        assert result.status == "improved"
        assert np.ptp(result.positions[:, 2]) < 0.15
        assert result.positions[:, 2].mean() == pytest.approx(found[0].positions[:, 2].mean(), abs=0.15)
        assert result.scales.h == pytest.approx(found[0].scales.h, rel=0.1)
        assert result.salience > 1
        assert result.gap < 1e-9
