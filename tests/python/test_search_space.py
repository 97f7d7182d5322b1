# SPDX-License-Identifier: GPL-3.0-or-later
"""The invariants of bands, flows and graphs (search_space_checks.py) on bands of many shapes."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import realistic_contours, surface_of
from search_space_checks import check_search_space, pairs

FLOWS = ["gates", "arc_length", "harmonic"]


def checked_space(mesh, contour, options, **keywords):
    space = mrc.search_space(surface_of(mesh, **keywords), contour, closed=True, options=mrc.Options(**options))
    check_search_space(mesh, contour, space, options)
    return space


@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("width", [1, 5])
def test_bands_of_realistic_contours(realistic, flow, width):
    _, mesh, contour = realistic
    space = checked_space(mesh, contour, {"width": width, "flow": flow})
    assert len(space["faces"]) > 0


@pytest.mark.parametrize("flow", FLOWS)
def test_bands_of_whole_surfaces(flow):
    """Bands grow until the topology stops them: on closed, noisy and open meshes, and on one with a deep palm."""
    for name, mesh, contour in realistic_contours()[::5]:
        space = checked_space(mesh, contour, {"width": None, "flow": flow})
        assert len(space["faces"]) > 0.4 * len(mesh.faces), name


@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("seed", range(20))
def test_bands_of_mixed_polygons(flow, seed):
    """Random quads and triangles, with zigzag contours and with hidden faces that stop the growth."""
    rng = np.random.default_rng(seed)
    mesh = meshes.tube(rng.uniform(0.8, 1.2, 15), 12, step=0.5, split_fraction=rng.random(), rng=rng, noise=0.05)
    contour = meshes.zigzag_contour(rng, 12, 5, 9, step_chance=0.6)
    beside = {i for i, face in enumerate(mesh.faces) if set(face) & set(contour.tolist())}
    hidden = np.array([i for i in range(len(mesh.faces)) if i not in beside and rng.random() < 0.06], dtype=np.int32)
    space = checked_space(mesh, contour, {"width": None if seed % 4 == 0 else 4, "flow": flow}, hidden_faces=hidden)
    assert not set(space["faces"].tolist()) & set(hidden.tolist())


@pytest.mark.parametrize("width", [1, 2, 3])
def test_bands_on_regular_quads_are_whole_rings(width):
    mesh = meshes.tube(np.ones(11), 8)
    space = checked_space(mesh, 5 * 8 + np.arange(8, dtype=np.int32), {"width": width, "flow": "harmonic"})
    assert sorted(space["faces"].tolist()) == list(range((5 - width) * 8, (5 + width) * 8))
    rows = np.arange(11 * 8) // 8
    for v, side, number in zip(space["vertices"], space["side"], space["round"], strict=True):
        assert side * number == rows[v] - 5


def test_left_side_of_the_band_is_left_of_the_contour():
    """Seen from outside, the left side of a loop that runs to the right is above it."""
    mesh = meshes.tube(np.ones(7), 8)
    space = checked_space(mesh, 3 * 8 + np.arange(8, dtype=np.int32), {"width": 1})
    assert set(space["left"][1].tolist()) == set(range(4 * 8, 5 * 8))
    assert set(space["right"][1].tolist()) == set(range(2 * 8, 3 * 8))


@pytest.mark.parametrize("flow", FLOWS)
def test_band_on_a_torus_remains_an_annulus(flow, rng):
    mesh = meshes.torus(12, 16, rng=rng, noise=0.02, split_fraction=0.5)
    for width in (3, 6, 20, None):
        checked_space(mesh, 4 * 16 + np.arange(16, dtype=np.int32), {"width": width, "flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
def test_rings_of_a_band_shrink_towards_a_tip(flow, rng):
    """Near the tip of a finger, one side has less and less room to grow."""
    mesh, _ = meshes.finger(rng)
    loops = [loop for height in (3.6, 4.2, 4.4, 4.5) for loop in meshes.plane_contours(mesh, [0, 0, 1], height)]
    assert len(loops) >= 3
    for loop in loops:
        checked_space(mesh, loop, {"width": 6, "flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
def test_non_manifold_edges_stop_the_band(flow):
    """A fin on a tube creates edges of three faces; a flipped face has a winding inconsistent with its neighbors."""
    tube = meshes.tube(np.ones(11), 8)
    fin = ((7 * 8, 7 * 8 + 1, 88, 89),)
    positions = np.concatenate([tube.positions, [[1.5, 0.5, 7.0], [1.5, 0.0, 7.0]]])
    faces = list(tube.faces)
    faces[2 * 8 + 3] = faces[2 * 8 + 3][::-1]
    mesh = meshes.polygon_mesh(positions, faces + list(fin))
    space = checked_space(mesh, 5 * 8 + np.arange(8, dtype=np.int32), {"width": 4, "flow": flow})
    banded = set(space["faces"].tolist())
    assert not banded & {len(faces), 2 * 8 + 3}
    inner = [edge for i in banded for edge in pairs(mesh.faces[i])]
    across = {frozenset(edge) for edge in inner if inner.count(edge[::-1])}
    assert frozenset((7 * 8, 7 * 8 + 1)) not in across
