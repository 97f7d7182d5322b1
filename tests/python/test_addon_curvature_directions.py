# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines along the valleys, without Blender."""

import importlib
import sys
from dataclasses import dataclass
from pathlib import Path

import mrcontour as mrc
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
directions = importlib.import_module("addon.core.curvature_directions")

AROUND, ROWS, GROOVE, STEP = 32, 21, 10, 0.2


@dataclass
class Arrays:
    """Arrays like those of a mesh in Blender."""

    positions: np.ndarray
    face_offsets: np.ndarray
    face_vertices: np.ndarray
    hidden_faces: np.ndarray


def tube(depth, scale=1.0, hidden=()):
    """Make quads around the z axis with a groove around row GROOVE; face r * AROUND + c is above the same vertex."""
    rows = np.arange(ROWS)
    radii = 1 - depth * np.exp(-((rows - GROOVE) ** 2) / 2)
    angles = 2 * np.pi * np.arange(AROUND) / AROUND
    points = np.stack(
        [np.outer(radii, np.cos(angles)), np.outer(radii, np.sin(angles)), np.outer(STEP * rows, np.ones(AROUND))], -1
    )
    low = np.arange((ROWS - 1) * AROUND).reshape(-1, AROUND)
    beside = np.roll(low, -1, axis=1)
    quads = np.stack([low, beside, beside + AROUND, low + AROUND], axis=-1).reshape(-1, 4)
    offsets = np.arange(0, quads.size + 1, 4)
    return Arrays(scale * points.reshape(-1, 3), offsets, quads.ravel(), np.array(hidden, dtype=int))


def lines(arrays, share=1.0):
    """Return the lines, (n, 2, 3), with the full color at this fraction of the deepest concavity."""
    curvature = mrc.curvature(mrc.Surface(arrays.positions, arrays.face_offsets, arrays.face_vertices))
    full = share * -np.min(curvature.kappa_min)
    return directions.segments(arrays, curvature, full).reshape(-1, 2, 3)


def test_lines_run_along_the_groove_at_its_vertices():
    arrays = tube(0.3)
    found = lines(arrays)
    middles, along = found.mean(axis=1), found[:, 1] - found[:, 0]
    groove = arrays.positions[GROOVE * AROUND : (GROOVE + 1) * AROUND]
    distances = np.linalg.norm(groove[:, None] - middles, axis=2).min(axis=1)
    assert distances.max() < 1e-6
    assert np.abs(middles[:, 2] - STEP * GROOVE).max() < 2.5 * STEP
    lengths = np.linalg.norm(along, axis=1)
    assert (np.abs(along[:, 2]) < 0.1 * lengths).all()


def test_lines_of_neighbors_do_not_touch():
    arrays = tube(0.3)
    found = lines(arrays)
    middles = found.mean(axis=1)
    apart = np.linalg.norm(middles[:, None] - middles, axis=2)
    apart[np.diag_indices(len(apart))] = np.inf
    lengths = np.linalg.norm(found[:, 1] - found[:, 0], axis=1)
    assert (lengths < apart.min(axis=1)).all()
    assert (lengths > 0.3 * apart.min(axis=1)).all()


def test_lines_grow_with_the_mesh():
    np.testing.assert_allclose(lines(tube(0.3, scale=100.0)), 100 * lines(tube(0.3)), rtol=1e-4, atol=1e-3)


@pytest.mark.parametrize("depth", [0.0, -0.3])
def test_a_mesh_without_concavity_has_no_lines(depth):
    arrays = tube(depth)
    curvature = mrc.curvature(mrc.Surface(arrays.positions, arrays.face_offsets, arrays.face_vertices))
    found = directions.segments(arrays, curvature, np.abs(curvature.kappa_max).max()).reshape(-1, 2, 3)
    on_ridge = np.abs(found.mean(axis=1)[:, 2] - STEP * GROOVE) < 1.1 * STEP
    assert not on_ridge.any()
    assert depth or not len(found)


def test_rounding_errors_on_a_plane_are_not_valleys(rng):
    grid = np.stack(np.meshgrid(np.arange(6.0), np.arange(6.0), [0.0]), axis=-1).reshape(-1, 3)
    grid[:, 2] += 1e-6 * rng.normal(size=len(grid))
    low = np.arange(30)[np.arange(30) % 6 < 5]
    quads = np.stack([low, low + 1, low + 7, low + 6], axis=-1)
    arrays = Arrays(grid, np.arange(0, quads.size + 1, 4), quads.ravel(), np.empty(0, dtype=int))
    assert len(lines(arrays)) == 0


def test_hidden_vertices_have_no_lines():
    hidden = [face for row in range(ROWS - 1) for face in range(row * AROUND, row * AROUND + AROUND // 2)]
    plain, half = lines(tube(0.3)), lines(tube(0.3, hidden=hidden))
    assert 0 < len(half) < len(plain)
    assert (half.mean(axis=1)[:, 1] < 1e-6).all()  # the hidden columns are those of positive y


def test_edge_lengths_are_means_around_vertices_and_0_for_loose_ones():
    positions = np.array([(0, 0, 0), (3, 0, 0), (3, 4, 0), (9, 9, 9)], dtype=float)
    arrays = Arrays(positions, np.array([0, 3]), np.array([0, 1, 2]), np.empty(0, dtype=int))
    np.testing.assert_allclose(directions.edge_lengths(arrays), [4.0, 3.5, 4.5, 0.0])
