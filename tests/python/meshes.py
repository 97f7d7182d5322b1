# SPDX-License-Identifier: GPL-3.0-or-later
"""Test meshes, and rough contours on them."""

import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "blend_samples"))

import figure_meshes  # noqa: E402
from figure_meshes import grid_faces, split_quads  # noqa: E402


@dataclass(frozen=True)
class Mesh:
    """Polygons with a prescribed triangulation (n - 2 triangles for each polygon, in face order)."""

    positions: np.ndarray
    faces: tuple
    triangles: np.ndarray

    @property
    def face_offsets(self):
        return np.cumsum([0] + [len(face) for face in self.faces]).astype(np.int32)

    @property
    def face_vertices(self):
        return np.concatenate([np.asarray(face, dtype=np.int32) for face in self.faces])

    def arguments(self):
        """The arguments of `mrcontour.Surface`, in order."""
        return self.positions, self.face_offsets, self.face_vertices, self.triangles

    def real_edges(self):
        """The polygons' edges, as sorted vertex pairs."""
        pairs = {tuple(sorted(pair)) for face in self.faces for pair in zip(face, np.roll(face, -1), strict=True)}
        return np.array(sorted(pairs), dtype=np.int32)

    def moved(self, positions):
        return replace(self, positions=np.ascontiguousarray(positions, dtype=np.float64))


def polygon_mesh(positions, faces, flips=None):
    """Triangulates each polygon as a fan from its first corner, or from its second where `flips` is set."""
    faces = tuple(tuple(int(v) for v in face) for face in faces)
    flips = np.zeros(len(faces), dtype=bool) if flips is None else flips
    triangles = []
    for face, flip in zip(faces, flips, strict=True):
        ring = face[1:] + face[:1] if flip else face
        triangles += [(ring[0], ring[i], ring[i + 1]) for i in range(1, len(ring) - 1)]
    positions = np.ascontiguousarray(positions, dtype=np.float64)
    return Mesh(positions, faces, np.array(triangles, dtype=np.int32))


def random_flips(faces, rng):
    return rng.random(len(faces)) < 0.5


def jittered_annulus(rng, rings, columns, split_fraction=1.0, height=0.4):
    """A flat ring of cells with jittered radii, angles and heights, open at both borders."""
    radius = 2.0 + np.arange(rings)[:, None] + rng.uniform(-0.25, 0.25, (rings, columns))
    angle = -2 * np.pi * (np.arange(columns)[None, :] + rng.uniform(-0.25, 0.25, (rings, columns))) / columns
    z = rng.uniform(-height, height, (rings, columns))
    positions = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1).reshape(-1, 3)
    faces = split_quads(grid_faces(rings, columns), rng, split_fraction)
    return polygon_mesh(positions, faces, random_flips(faces, rng))


def tube(radius, columns, step=1.0, split_fraction=0.0, rng=None, noise=0.0):
    """A tube of quads around the z axis with one radius for each ring, open at both ends."""
    rows = len(radius)
    rng = rng or np.random.default_rng(0)
    angle = 2 * np.pi * np.arange(columns) / columns
    circle = np.stack([np.cos(angle), np.sin(angle), np.zeros(columns)], axis=-1)
    positions = np.asarray(radius)[:, None, None] * circle + np.arange(rows)[:, None, None] * [0.0, 0.0, step]
    positions = positions.reshape(-1, 3) + noise * rng.standard_normal((rows * columns, 3))
    faces = split_quads(grid_faces(rows, columns), rng, split_fraction)
    return polygon_mesh(positions, faces, random_flips(faces, rng))


def trapezoid_tube(rng, rows, columns):
    """A random tube of irregular but planar trapezoids: one cross-section, scaled and shifted for each ring."""
    angle = 2 * np.pi * (np.arange(columns) + rng.uniform(-0.3, 0.3, columns)) / columns
    section = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * rng.uniform(0.85, 1.15, (columns, 1))
    scale = 2.0 + 0.5 * np.sin(np.arange(rows) * 0.9) + rng.uniform(-0.2, 0.2, rows)
    shift = rng.uniform(-0.2, 0.2, (rows, 2))
    flat = scale[:, None, None] * section + shift[:, None, :]
    z = np.cumsum(rng.uniform(0.3, 0.6, rows))
    positions = np.concatenate([flat, np.broadcast_to(z[:, None, None], (rows, columns, 1))], axis=-1)
    return polygon_mesh(positions.reshape(-1, 3), grid_faces(rows, columns))


def square_prism(side, rows):
    """A tube with a square section, made of equal squares with edges of 1/3."""
    step = np.arange(side) / 3
    path = [(x, 0) for x in step] + [(side / 3, y) for y in step]
    path += [(side / 3 - x, side / 3 - y) for x, y in path]
    layers = [np.column_stack([path, np.full(4 * side, row / 3)]) for row in range(rows)]
    return polygon_mesh(np.concatenate(layers), grid_faces(rows, 4 * side))


def torus(rows, columns, major=3.0, minor=1.0, rng=None, split_fraction=0.0, noise=0.0, grooves=0.0):
    """A torus with `columns` along its length and `rows` around its section; grooves narrow it at three places."""
    rng = rng or np.random.default_rng(0)
    long, short = np.meshgrid(2 * np.pi * np.arange(columns) / columns, 2 * np.pi * np.arange(rows) / rows)
    thickness = minor * (1 - grooves * np.cos(1.5 * long) ** 8)
    ring = major + thickness * np.cos(short)
    positions = np.stack([ring * np.cos(long), ring * np.sin(long), thickness * np.sin(short)], axis=-1).reshape(-1, 3)
    positions = positions + noise * rng.standard_normal(positions.shape)
    faces = split_quads(grid_faces(rows, columns, closed_rows=True), rng, split_fraction)
    return polygon_mesh(positions, faces, random_flips(faces, rng))


def bent_tube(rng, rows=60, columns=24):
    """A tube bent by a right angle, triangulated at random, with a waist in the middle."""
    along = np.linspace(0, np.pi / 2, rows)
    radius = 1.0 - 0.35 * np.exp(-(((along - np.pi / 4) / 0.12) ** 2))
    angle = 2 * np.pi * np.arange(columns) / columns
    ring = 4.0 - radius[:, None] * np.cos(angle)
    positions = np.stack(
        [ring * np.cos(along)[:, None], ring * np.sin(along)[:, None], radius[:, None] * np.sin(angle)], axis=-1
    ).reshape(-1, 3)
    positions += 0.01 * rng.standard_normal(positions.shape)
    faces = split_quads(grid_faces(rows, columns), rng)
    return polygon_mesh(positions, faces)


def subdivided(positions, faces):
    """Splits each triangle into four; the new points, on the unit sphere, are appended to the positions."""
    middles, result = {}, []
    for a, b, c in faces:
        for p, q in ((a, b), (b, c), (c, a)):
            if (q, p) not in middles:
                point = positions[p] + positions[q]
                middles[p, q] = middles[q, p] = len(positions)
                positions.append(point / np.linalg.norm(point))
        ab, bc, ca = middles[a, b], middles[b, c], middles[c, a]
        result += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return result


def icosphere(subdivisions):
    """A unit sphere made of triangles."""
    golden = (1 + np.sqrt(5)) / 2
    positions = [
        (-1, golden, 0),
        (1, golden, 0),
        (-1, -golden, 0),
        (1, -golden, 0),
        (0, -1, golden),
        (0, 1, golden),
        (0, -1, -golden),
        (0, 1, -golden),
        (golden, 0, -1),
        (golden, 0, 1),
        (-golden, 0, -1),
        (-golden, 0, 1),
    ]
    positions = [np.array(p) / np.linalg.norm(p) for p in positions]
    faces = [
        (0, 11, 5),
        (0, 5, 1),
        (0, 1, 7),
        (0, 7, 10),
        (0, 10, 11),
        (1, 5, 9),
        (5, 11, 4),
        (11, 10, 2),
        (10, 7, 6),
        (7, 1, 8),
        (3, 9, 4),
        (3, 4, 2),
        (3, 2, 6),
        (3, 6, 8),
        (3, 8, 9),
        (4, 9, 5),
        (2, 4, 11),
        (6, 2, 10),
        (8, 6, 7),
        (9, 8, 1),
    ]
    for _ in range(subdivisions):
        faces = subdivided(positions, faces)
    return polygon_mesh(np.array(positions), faces)


def peanut(rng, subdivisions=4):
    """A closed body with a waist and bumps: a sphere displaced along its normals."""
    sphere = icosphere(subdivisions)
    unit = sphere.positions
    centers = rng.standard_normal((6, 3))
    centers /= np.linalg.norm(centers, axis=1, keepdims=True)
    bumps = 0.15 * np.exp(8 * (unit @ centers.T - 1)).sum(axis=1)
    radius = 0.6 + 0.9 * unit[:, 2] ** 2 + bumps
    return sphere.moved(radius[:, None] * unit + 0.003 * rng.standard_normal(unit.shape))


def finger(rng):
    """The finger of the thesis figures, and its base ring."""
    positions, faces, base_ring = figure_meshes.finger(rng)
    return polygon_mesh(positions, faces), base_ring


def zigzag_contour(rng, columns, lowest, highest, step_chance=0.5):
    """A random closed contour around the columns of a grid, along its edges, between two rows. It never turns back."""
    rows = [int(rng.integers(lowest, highest + 1))]
    for _ in range(columns - 1):
        step = int(rng.choice([-1, 1])) if rng.random() < step_chance else 0
        rows.append(int(np.clip(rows[-1] + step, lowest, highest)))
    return figure_meshes.grid_path(np.array(rows), columns)


def plane_contours(mesh, normal, offset):
    """The jagged loops where a plane cuts the mesh (`figure_meshes.plane_loops`)."""
    return figure_meshes.plane_loops(mesh.positions, mesh.faces, normal, offset)


def renumbered(mesh, rng):
    """Shuffles the vertices, the faces, and the first corner of each face. Returns the mesh and the new vertex
    numbers."""
    number = rng.permutation(len(mesh.positions))
    positions = np.empty_like(mesh.positions)
    positions[number] = mesh.positions
    starts = np.cumsum([0] + [len(face) - 2 for face in mesh.faces])
    faces, triangles = [], []
    for i in rng.permutation(len(mesh.faces)):
        faces.append(tuple(number[np.roll(mesh.faces[i], rng.integers(len(mesh.faces[i])))].tolist()))
        own = mesh.triangles[starts[i] : starts[i + 1]]
        triangles += [np.roll(number[t], rng.integers(3)) for t in own[rng.permutation(len(own))]]
    return Mesh(positions, tuple(faces), np.array(triangles, dtype=np.int32)), number


def rigidly_moved(mesh, rng):
    rotation, _ = np.linalg.qr(rng.standard_normal((3, 3)))
    rotation *= np.linalg.det(rotation)  # not a mirror image
    return mesh.moved(mesh.positions @ rotation.T + rng.uniform(-5, 5, 3))
