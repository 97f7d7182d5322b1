# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of colored parts: several panels side by side, all with the same view."""

from dataclasses import dataclass, field

import blender_meshes
import bpy
import captions
import images
import numpy as np
import pictures
import stamps
import views
from mathutils import Matrix, Vector

HEIGHT = 470  # pixels of a panel
MARGIN = 1.04
INK = (0.05, 0.05, 0.06)


@dataclass
class Piece:
    """A mesh with a color for each face, drawn at an offset."""

    mesh: bpy.types.Mesh
    colors: np.ndarray  # the index of each face's color in the picture's palette
    offset: tuple = (0.0, 0.0, 0.0)

    def positions(self):
        return blender_meshes.read(self.mesh.vertices, "co", 3, np.float64) + self.offset


@dataclass
class Panel:
    words: list  # lines of text, each with its color
    pieces: list
    curves: list = field(default_factory=list)  # drawn in black


def draw_if_changed(path, palette, panels, toward, up=(0, 0, 1)):
    """Draw a PNG, unless it is up to date. `toward` is the direction from the mesh to the camera."""
    pieces = [piece for panel in panels for piece in panel.pieces]
    curves = [curve.points for panel in panels for curve in panel.curves]
    arrays = [blender_meshes.polygons(piece.mesh).vertices for piece in pieces] + curves
    arrays += [array for piece in pieces for array in (piece.positions(), piece.colors)]
    made_of = stamps.stamp([*arrays, np.array(palette), np.array(toward)], [panel.words for panel in panels])
    stamps.draw_if_changed(path, made_of, lambda: draw(path, palette, panels, toward, up))


def draw(path, palette, panels, toward, up):
    with pictures.scratch():
        view, aspect = _common_view(panels, np.asarray(toward, float), up)
        size = (round(HEIGHT * aspect), HEIGHT)
        materials = [images.material("part", color) for color in palette]
        drawn = pictures.joined([_render(panel, view, size, materials) for panel in panels], axis=1)
        left = [i * (size[0] + pictures.GAP) + 8 for i in range(len(panels))]
        words = [(line, x, *word) for x, panel in zip(left, panels) for line, word in enumerate(panel.words)]
        whole = np.concatenate([drawn, captions.strip(drawn.shape[1], words)])
        images.save(np.round(whole * pictures.SHADES) / pictures.SHADES, path)


def _common_view(panels, toward, up):
    """Return a camera that sees the pieces of all panels, and the aspect ratio of its frame."""
    toward = toward / np.linalg.norm(toward)
    right, top = views.frame(toward, up)
    positions = np.concatenate([piece.positions() for panel in panels for piece in panel.pieces])
    low, high = (bound(positions @ np.stack([right, top, toward], axis=1), axis=0) for bound in (np.min, np.max))
    width, height, depth = MARGIN * (high - low)
    middle = (low + high) / 2
    matrix = Matrix(np.stack([right, top, toward], axis=1).tolist()).to_4x4()
    matrix.translation = Vector(middle[0] * right + middle[1] * top + (high[2] + depth) * toward)
    return views.View(matrix, max(width, height), 3 * depth), width / height


def _render(panel, view, size, materials):
    scene = bpy.data.scenes.new("panel")
    pictures.set_up(scene, view, size)
    for piece in panel.pieces:
        mesh = piece.mesh.copy()
        mesh.materials.clear()
        for material in materials:
            mesh.materials.append(material)
        mesh.polygons.foreach_set("material_index", piece.colors.astype(np.int32))
        images.link(scene, "piece", mesh).location = piece.offset
    for curve in panel.curves:
        pictures.tube(scene, curve, INK, 0.003 * view.width, lift=0.001 * view.width)
    return images.render(scene)
