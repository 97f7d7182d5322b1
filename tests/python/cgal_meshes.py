# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of Debian's libcgal-demo as they are, defective ones included, and spoilt further."""

import io
import tempfile
from functools import cache
from pathlib import Path
from unittest import mock

import meshes  # noqa: F401  it makes blend_samples importable
import numpy as np
import real_meshes
import trimesh

MANY = 20_000  # triangles, beyond which a mesh is subdivided in part only


@cache
def contents():
    """The bytes of each mesh file, by name; the package is fetched where the system keeps no documents."""
    folder = Path(tempfile.gettempdir()) / "libcgal-demo"
    with real_meshes.open_archive(folder) as archive:
        files = [file for file in archive.getmembers() if file.isfile() and file.name.startswith("data/meshes/")]
        return {Path(file.name).name: archive.extractfile(file).read() for file in files}


def read(name):
    """Positions and triangles, unmended; faces of more corners are cut by the reader. STL names no vertices: equal ones
    are one, as in every modeler."""
    kind = Path(name).suffix[1:]
    with mock.patch("trimesh.exchange.off.triangulate_quads", triangulate):
        mesh = trimesh.load(io.BytesIO(contents()[name]), file_type=kind, process=False, force="mesh")
    if kind == "stl":
        mesh.merge_vertices()
    return np.array(mesh.vertices, dtype=np.float64).reshape(-1, 3), np.array(mesh.faces, dtype=np.int32).reshape(-1, 3)


def triangulate(faces):
    """The reader's own, which fails for more than four corners while these are still text."""
    return trimesh.geometry.triangulate_quads([np.array(face, dtype=np.int64) for face in faces])


# ---- spoilt: each takes positions, triangles and a generator


def as_it_is(positions, triangles, rng):
    return positions, triangles


def subdivided(positions, triangles, rng):
    """Each triangle in four; of a large mesh some only, which leaves T-junctions."""
    some = None if len(triangles) <= MANY else rng.choice(len(triangles), MANY // 4, replace=False)
    return trimesh.remesh.subdivide(positions, triangles, face_index=some)


def decimated(positions, triangles, rng):
    """Vertices of the same cell of a grid become one: what does not fit together afterwards stays."""
    size = np.ptp(positions, axis=0).max() / rng.uniform(10, 40)
    cells, number = np.unique(np.floor(positions / size), axis=0, return_inverse=True)
    return (cells + rng.uniform(0.3, 0.7, cells.shape)) * size, proper(number.reshape(-1)[triangles])


def with_noise(positions, triangles, rng):
    edges = positions[triangles[:, 0]] - positions[triangles[:, 1]]
    size = rng.choice([0.05, 0.3, 1.0]) * np.median(np.linalg.norm(edges, axis=1))
    return positions + size * rng.standard_normal(positions.shape), triangles


def with_duplicated_faces(positions, triangles, rng):
    return positions, np.concatenate([triangles, some_of(triangles, rng)])


def with_flipped_faces(positions, triangles, rng):
    chosen = rng.random(len(triangles)) < rng.choice([0.002, 0.03])
    return positions, np.where(chosen[:, None], triangles[:, ::-1], triangles)


def with_removed_faces(positions, triangles, rng):
    return positions, triangles[rng.random(len(triangles)) >= rng.choice([0.002, 0.03])]


WAYS = (
    as_it_is,
    subdivided,
    decimated,
    with_noise,
    with_duplicated_faces,
    with_flipped_faces,
    with_removed_faces,
)


def some_of(triangles, rng):
    return triangles[rng.random(len(triangles)) < rng.choice([0.002, 0.03])]


def proper(triangles):
    """Those of three different corners, which alone are faces."""
    a, b, c = triangles.T
    return triangles[(a != b) & (b != c) & (c != a)]
