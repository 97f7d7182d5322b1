# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's cutting of quads into mirror images, without Blender."""

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
mirrored_quads = importlib.import_module("addon.core.mirrored_quads")


def symmetric_mesh(rng, noise=0.0):
    """Squares on both sides of x = 0 and a triangle on each, and which vertex is the image of which. The corners of
    each face start anywhere."""
    columns, rows = 4, 5
    x, y = np.meshgrid(np.arange(1, columns + 1), np.arange(rows), indexing="ij")
    z = 0.3 * np.sin(x + 2 * y)
    half = np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(float)
    half[:, :2] += rng.uniform(-0.2, 0.2, half[:, :2].shape)
    number = np.arange(len(half)).reshape(columns, rows)
    quads = [
        (number[i, j], number[i + 1, j], number[i + 1, j + 1], number[i, j + 1])
        for i in range(columns - 1)
        for j in range(rows - 1)
    ]
    faces = [*quads[:5], quads[5][:3], *quads[6:]]
    images = [tuple(v + len(half) for v in face[::-1]) for face in faces]
    positions = np.concatenate([half, half * [-1, 1, 1]])
    positions += noise * rng.standard_normal(positions.shape)
    return positions, [tuple(np.roll(face, rng.integers(4))) for face in faces + images], len(half)


def arrays_of(faces):
    sizes = [len(face) for face in faces]
    offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32)
    fans = [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]
    return offsets, np.concatenate(faces).astype(np.int32), np.array(fans, dtype=np.int32)


def undirected(triangles):
    return {frozenset(map(int, triangle)) for triangle in triangles}


@pytest.mark.parametrize("seed", range(20))
def test_both_sides_are_mirror_images(seed):
    rng = np.random.default_rng(seed)
    positions, faces, count = symmetric_mesh(rng, noise=1e-7)
    triangles = mirrored_quads.mirrored(positions, *arrays_of(faces))
    images = {frozenset((v + count) % (2 * count) for v in triangle) for triangle in undirected(triangles)}
    assert images == undirected(triangles)


def test_the_triangles_are_those_of_their_faces_in_their_direction(rng):
    positions, faces, _ = symmetric_mesh(rng)
    offsets, corners, fans = arrays_of(faces)
    triangles = mirrored_quads.mirrored(positions, offsets, corners, fans)
    assert triangles.dtype == np.int32
    directed = {edge for t in triangles.tolist() for edge in zip(t, t[1:] + t[:1], strict=True)}
    at = 0
    for face in faces:
        own = triangles[at : at + len(face) - 2]
        at += len(face) - 2
        assert set(own.ravel().tolist()) == set(map(int, face))
        assert {(int(a), int(b)) for a, b in zip(face, face[1:] + face[:1], strict=True)} <= directed
    assert at == len(triangles)


def test_concave_quads_and_other_faces_keep_their_triangles():
    positions = np.array([[1, 0, 0], [3, 0, 0], [1.6, 0.6, 0], [1, 2, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]], dtype=float)
    faces = [(1, 2, 3, 0), (4, 5, 6)]
    offsets, corners, _ = arrays_of(faces)
    own = np.array([[1, 2, 0], [2, 3, 0], [4, 5, 6]], dtype=np.int32)
    assert np.array_equal(mirrored_quads.mirrored(positions, offsets, corners, own), own)
    none = np.empty((0, 3), dtype=np.int32)
    assert len(mirrored_quads.mirrored(positions, np.zeros(1, np.int32), none.ravel(), none)) == 0
