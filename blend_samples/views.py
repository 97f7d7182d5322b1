# SPDX-License-Identifier: GPL-3.0-or-later
"""Chooses the camera of a picture, so that it sees as much of the contours as possible."""

from dataclasses import dataclass

import blender_meshes
import numpy as np
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

DIRECTIONS = 96
SAMPLES = 60  # points of each contour that are tried for visibility


@dataclass
class View:
    """An orthographic camera: its matrix, the width of its frame, and the distance of its far clip plane."""

    matrix: Matrix
    width: float
    depth: float


def best_view(mesh, curves, up, margin):
    """Return the view along the best direction, with a frame `margin` times as wide as the curves."""
    mesh.calc_loop_triangles()
    positions = blender_meshes.read(mesh.vertices, "co", 3, np.float64)
    direction = _best_direction(mesh, positions, curves, np.asarray(up, float))
    right, top = frame(direction, up)
    flat = np.stack([right, top], axis=1)
    shown = np.concatenate([curve.points for curve in curves]) @ flat
    low, high = shown.min(axis=0), shown.max(axis=0)
    whole = np.ptp(positions @ flat, axis=0).max()
    width = min(max(margin * (high - low).max(), 0.2 * whole), 1.1 * whole)
    near, far = (positions @ direction).max(), (positions @ direction).min()
    matrix = Matrix(np.stack([right, top, direction], axis=1).tolist()).to_4x4()
    matrix.translation = Vector((low + high) / 2 @ flat.T + (near + width) * direction)
    return View(matrix, width, near - far + 2 * width)


def frame(view, up):
    right = np.cross(up, view)
    right /= np.linalg.norm(right)
    return right, np.cross(view, right)


def _best_direction(mesh, positions, curves, up):
    triangles = blender_meshes.read(mesh.loop_triangles, "vertices", 3, np.int32)
    tree = BVHTree.FromPolygons(positions.tolist(), triangles.tolist())
    size = np.ptp(positions, axis=0).max()
    pieces = [_pieces(curve) for curve in curves]
    axes = [_axis(curve) for curve in curves if _goes_round_a_limb(curve)]
    views = _directions(up, axes)
    return max(views, key=lambda view: sum(_seen(tree, view, size, *piece) for piece in pieces))


def _pieces(curve):
    """Return midpoints, sides and outward normals of a curve, and whether it lies on one face of a body."""
    sides = curve.sides()
    keep = np.linspace(0, len(sides), min(SAMPLES, len(sides)), endpoint=False).astype(int)
    middles = (curve.starts() + sides / 2)[keep]
    weights = sides[keep] / np.linalg.norm(sides, axis=1).sum()
    return middles, weights, curve.normals[keep], not _goes_round_a_limb(curve)


def _axis(curve):
    """Return the unit normal of a closed curve, the direction of its area vector."""
    points = curve.points - curve.points.mean(axis=0)
    area = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)
    return area / max(np.linalg.norm(area), 1e-30)


def _goes_round_a_limb(curve):
    """Whether the surface faces away from a closed curve's axis; along the axis one would only see the limb's end."""
    return curve.closed and np.abs(curve.normals @ _axis(curve)).mean() < 0.7


def _directions(up, axes):
    """Return evenly spread directions, except from far above or below and along the axis of a limb."""
    k = np.arange(DIRECTIONS) + 0.5
    height, turn = 1 - 2 * k / DIRECTIONS, np.pi * (1 + 5**0.5) * k
    flat = np.sqrt(1 - height**2)
    views = np.stack([flat * np.cos(turn), flat * np.sin(turn), height], axis=1)
    level = views[(views @ up > -0.3) & (views @ up < 0.5)]
    sideways = [view for view in level if all(abs(view @ axis) < 0.75 for axis in axes)]
    return sideways or list(level)


def _seen(tree, view, size, middles, sides, normals, on_a_face):
    """Return the visible projected length; on one face of a body, weighted by how directly it faces the camera."""
    length = np.linalg.norm(np.cross(sides, view), axis=1)
    if on_a_face:
        length *= np.clip(normals @ view, 0.0, None)
    starts = middles + 2e-3 * size * normals
    free = [tree.ray_cast(Vector(start), Vector(view))[0] is None for start in starts]
    return length[free].sum()
