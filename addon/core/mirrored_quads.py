# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts quads into triangles so that those on both sides of the mirror plane x = 0 are mirror images."""

import numpy as np

_STRAIGHT = 1e-6  # a corner's area over the squared size of the quad: smaller ones count as straight
_GRAIN = 1e-4  # of the mean size of the quads: coordinates that differ by less are the same
_CUTS = np.array([[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]])


def mirrored(positions, face_offsets, face_vertices, triangles):
    """Return triangles in which convex quads are cut at the corner nearest to the plane x = 0.

    Of corners equally near it is the one of lowest y, then z, which mirror images have in common; Blender cuts at the
    first corner, which they have not. The arguments are those of mrcontour.Surface.
    """
    sizes = np.diff(face_offsets)
    quads = np.flatnonzero(sizes == 4)
    corners = face_vertices[face_offsets[quads, None] + np.arange(4)]
    convex = _convex(positions[corners])
    quads, corners = quads[convex], corners[convex]
    found = triangles.copy()
    if len(quads):
        first = np.cumsum(sizes - 2)[quads] - 2
        cut = _CUTS[_nearest_corners(positions[corners]) % 2]
        found[first[:, None] + np.arange(2)] = np.take_along_axis(corners, cut.reshape(-1, 6), axis=1).reshape(-1, 2, 3)
    return found


def _convex(points):
    """Return which quads have a triangle of positive area at each corner, seen along their normals."""
    ahead, behind = np.roll(points, -1, axis=1) - points, np.roll(points, 1, axis=1) - points
    normals = np.cross(points[:, 2] - points[:, 0], points[:, 3] - points[:, 1])
    areas = (np.cross(ahead, behind) * normals[:, None]).sum(axis=2)
    return (areas > _STRAIGHT * (normals**2).sum(axis=1, keepdims=True)).all(axis=1)


def _nearest_corners(points):
    """Return which corner of each quad comes first by |x|, y and z, in steps that rounding hardly ever divides."""
    size = np.linalg.norm(points[:, 2] - points[:, 0], axis=1).mean()
    keys = np.concatenate([abs(points[..., :1]), points[..., 1:]], axis=2)
    x, y, z = np.moveaxis(np.floor(keys / (_GRAIN * size or 1.0) + 0.37), 2, 0)
    return np.lexsort((z, y, x), axis=1)[:, 0]
