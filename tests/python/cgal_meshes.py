# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of Debian's libcgal-demo, unchanged (some are defective) and damaged further."""

import io
import tempfile
from functools import cache
from pathlib import Path
from unittest import mock

import meshes  # noqa: F401  makes blend_samples importable
import numpy as np
import real_meshes
import trimesh

MANY = 20_000  # triangles; a larger mesh is subdivided only in part


@cache
def contents():
    """The bytes of each mesh file, by name. The package is downloaded if the system installs no documents."""
    folder = Path(tempfile.gettempdir()) / "libcgal-demo"
    with real_meshes.open_archive(folder) as archive:
        files = [file for file in archive.getmembers() if file.isfile() and file.name.startswith("data/meshes/")]
        return {Path(file.name).name: archive.extractfile(file).read() for file in files}


def read(name):
    """Positions and triangles, not repaired. The reader triangulates larger faces. STL has no shared vertices: equal
    ones are merged, as every modeling program does."""
    kind = Path(name).suffix[1:]
    with mock.patch("trimesh.exchange.off.triangulate_quads", triangulate):
        mesh = trimesh.load(io.BytesIO(contents()[name]), file_type=kind, process=False, force="mesh")
    if kind == "stl":
        mesh.merge_vertices()
    return np.array(mesh.vertices, dtype=np.float64).reshape(-1, 3), np.array(mesh.faces, dtype=np.int32).reshape(-1, 3)


def triangulate(faces):
    """The reader's own triangulation, which without the conversion fails on text with more than four corners."""
    return trimesh.geometry.triangulate_quads([np.array(face, dtype=np.int64) for face in faces])


# ---- damage: each function takes positions, triangles and a random generator


def unchanged(positions, triangles, rng):
    return positions, triangles


def subdivided(positions, triangles, rng):
    """Splits each triangle into four; in a large mesh only some, which leaves T-junctions."""
    some = None if len(triangles) <= MANY else rng.choice(len(triangles), MANY // 4, replace=False)
    return trimesh.remesh.subdivide(positions, triangles, face_index=some)


def decimated(positions, triangles, rng):
    """Merges the vertices in each cell of a grid, and keeps the defects that result."""
    size = np.ptp(positions, axis=0).max() / rng.uniform(10, 40)
    cells, number = np.unique(np.floor(positions / size), axis=0, return_inverse=True)
    return (cells + rng.uniform(0.3, 0.7, cells.shape)) * size, drop_degenerate(number.reshape(-1)[triangles])


def with_noise(positions, triangles, rng):
    edges = positions[triangles[:, 0]] - positions[triangles[:, 1]]
    size = rng.choice([0.05, 0.3, 1.0]) * np.median(np.linalg.norm(edges, axis=1))
    return positions + size * rng.standard_normal(positions.shape), triangles


def with_duplicated_faces(positions, triangles, rng):
    return positions, np.concatenate([triangles, random_part(triangles, rng)])


def with_flipped_faces(positions, triangles, rng):
    chosen = rng.random(len(triangles)) < rng.choice([0.002, 0.03])
    return positions, np.where(chosen[:, None], triangles[:, ::-1], triangles)


def with_removed_faces(positions, triangles, rng):
    return positions, triangles[rng.random(len(triangles)) >= rng.choice([0.002, 0.03])]


VARIANTS = (
    unchanged,
    subdivided,
    decimated,
    with_noise,
    with_duplicated_faces,
    with_flipped_faces,
    with_removed_faces,
)


def random_part(triangles, rng):
    return triangles[rng.random(len(triangles)) < rng.choice([0.002, 0.03])]


def drop_degenerate(triangles):
    """The triangles with three different corners; only these are faces."""
    a, b, c = triangles.T
    return triangles[(a != b) & (b != c) & (c != a)]
