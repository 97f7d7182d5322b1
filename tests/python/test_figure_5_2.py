# SPDX-License-Identifier: GPL-3.0-or-later
"""Escaping local minima (thesis 5.2): the feature is far from the given contour, and nothing on the way leads to it."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

FLOWS = ["gates", "arc_length", "harmonic"]


def mean_edge(mesh):
    edges = mesh.real_edges()
    return np.linalg.norm(mesh.positions[edges[:, 0]] - mesh.positions[edges[:, 1]], axis=1).mean()


@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("seed", range(3))
def test_a_loop_half_way_up_a_finger_goes_to_its_base(flow, seed):
    """The finger's diameter only shrinks towards the tip, so a snake would slip off over it. The base ring is the
    profile's only concave corner, marked when the mesh is made."""
    rng = np.random.default_rng(seed)
    mesh, base_ring = meshes.finger(rng)
    loops = meshes.plane_contours(mesh, [*rng.uniform(-0.15, 0.15, 2), 1.0], 1.9)
    contour = max(loops, key=len)
    result = mrc.optimize(surface_of(mesh), contour, options=mrc.Options(width=13, flow=flow))

    def distance(loop):
        apart = mesh.positions[loop][:, None] - mesh.positions[base_ring][None]
        return np.linalg.norm(apart, axis=2).min(axis=1).mean() / mean_edge(mesh)

    assert distance(contour) > 6
    assert result.status == "improved"
    assert distance(result.vertices) <= 2


@pytest.mark.parametrize("flow", FLOWS)
def test_a_slanted_groove_on_regular_quads_is_found(flow):
    """In the harmonic flow all edges across are level: without level edges no contour could leave its ring. The quads
    are sheared where the groove crosses them, so that the stairs along it turn by a little more than a right angle."""
    rows, columns, slope = 61, 64, 0.5
    mesh = meshes.tube(np.ones(rows), columns, step=2 * np.pi / columns)
    x, y, z = mesh.positions.T
    off = z - z.mean() - slope * x
    depth = 1 - 0.12 * np.exp(-((off / 0.25) ** 2))
    mesh = mesh.moved(np.stack([x * depth, y * depth, z], axis=-1))
    contour = (rows // 2) * columns + np.arange(columns, dtype=np.int32)
    result = mrc.optimize(surface_of(mesh), contour, options=mrc.Options(width=8, flow=flow, max_turn=np.radians(100)))
    edge = mean_edge(mesh)
    assert np.abs(off[contour]).mean() > 3 * edge
    assert result.status == "improved"
    assert np.abs(off[result.vertices]).mean() < 0.5 * edge
