# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures before and after: the surface is gray, faces searched are green, given contours orange, contours found blue,
correct contours known by construction black, and required vertices purple."""

from contextlib import contextmanager
from dataclasses import dataclass, field
from textwrap import wrap

import blender_meshes
import bmesh
import bpy
import captions
import images
import numpy as np
import stamps
import views
from mathutils import Matrix

SIZE, GAP = 700, 12  # pixels of one half, and between the halves
OVERVIEW_SIZE = 344
SHEET_COLUMNS = 3
MARGIN, OVERVIEW_MARGIN = 2.0, 1.3  # width of the picture, divided by that of the contours
SMOOTH_ANGLE = 0.8  # radians: edges sharper than this are drawn sharp
SHADES = 44  # of each color in the overview, for a small file
GREY, GREEN = (0.85, 0.85, 0.83), (0.55, 0.86, 0.52)
ORANGE, BLUE, BLACK, DARK_GREEN = (1.0, 0.13, 0.0), (0.0, 0.10, 1.0), (0.02, 0.02, 0.02), (0.10, 0.32, 0.09)
PURPLE = (0.36, 0.0, 0.5)


@dataclass
class Comparison:
    """The content of one picture: curves, the faces searched, and a line of text for each half."""

    title: str
    before: str
    after: str
    given: list
    found: list
    searched: np.ndarray
    truths: list = field(default_factory=list)
    legend: str = "faces searched (green)"
    heading: str = ""  # above both halves
    held: tuple = ()  # required vertices
    in_view: list = field(default_factory=list)  # curves that the view must contain, if not only those drawn

    def stamp(self, mesh):
        """Return a hash of everything in the picture, except normals, which Blender sums up in a varying order."""
        points = [curve.points for curve in (*self.given, *self.found, *self.truths, *self.in_view)]
        arrays = [mesh.positions, mesh.vertices, *points, self.searched, np.asarray(self.held)]
        return stamps.stamp(arrays, [self.title, self.before, self.after, self.legend, self.heading])


def draw_if_changed(path, ob, up, comparison):
    """Draw a comparison as a PNG, unless it is up to date."""
    made_of = comparison.stamp(blender_meshes.polygons(ob.data))
    stamps.draw_if_changed(path, made_of, lambda: draw(path, ob, up, comparison))


def draw(path, ob, up, comparison):
    """Draw a comparison as a PNG."""
    with scratch():
        halves = joined(_halves(ob, up, comparison, SIZE, MARGIN), axis=1)
        heading = [(comparison.heading, BLACK)] if comparison.heading else []
        left = [*heading, (comparison.title, BLACK), (comparison.before, ORANGE)]
        right = [(_legend(comparison), BLACK), (comparison.after, BLUE)]
        words = [(line, 10, *word) for line, word in enumerate(left)]
        words += [(line, SIZE + GAP + 10, *word) for line, word in enumerate(right, len(heading))]
        images.save(np.concatenate([halves, captions.strip(halves.shape[1], words)]), path)


def _legend(comparison):
    """Return the meaning of the colors that are not those of the text."""
    parts = [f"{len(comparison.searched)} {comparison.legend}"]
    if comparison.truths:
        parts.append("true contour black" if len(comparison.truths) == 1 else "true contours black")
    if len(comparison.held):
        parts.append(f"{len(comparison.held)} held vertices purple")
    return ", ".join(parts)


def overview_pair(ob, up, comparison, size=OVERVIEW_SIZE):
    """Draw a comparison as a small picture; `draw_overview` combines several."""
    with scratch():
        halves = joined(_halves(ob, up, comparison, size, OVERVIEW_MARGIN), axis=1)
        words, spacing = _small_title(comparison, size + GAP), captions.LINE
        if comparison.heading:
            words, spacing = _two_lines(comparison.heading), captions.SMALL_LINE
        below = 1 + max(line for line, *_ in words)
        words += [(below, 4, comparison.before, ORANGE), (below, size + GAP, comparison.after, BLUE)]
        return np.concatenate([halves, captions.strip(halves.shape[1], words, spacing)])


def _small_title(comparison, right):
    return [(0, 4, comparison.title, BLACK), (0, right, "green: faces searched", DARK_GREEN)]


def _two_lines(heading):
    """Break a heading into two lines of similar length, so that all headings can have letters of the same size."""
    least = next(width for width in range(len(heading) // 2, len(heading)) if len(wrap(heading, width)) == 2)
    return [(line, 4, words, BLACK) for line, words in enumerate(wrap(heading, least))]


def draw_sheet(path, drawn):
    """Combine existing pictures into one PNG, at half their size."""
    with scratch():
        halved = [_halved(images.load(picture)[:, :, :3]) for picture in drawn]
    draw_overview(path, halved, SHEET_COLUMNS)


def _halved(pixels):
    height, width = (2 * (side // 2) for side in pixels.shape[:2])
    return pixels[:height, :width].reshape(height // 2, 2, width // 2, 2, 3).mean(axis=(1, 3))


def draw_overview(path, pairs, columns=2, shades=SHADES):
    """Combine several pairs into one PNG, in rows, the first at the top left."""
    blank = np.broadcast_to(np.float32(images.PAPER), pairs[0].shape)
    filled = pairs + [blank] * (-len(pairs) % columns)
    rows = [joined(filled[i : i + columns], axis=1) for i in range(0, len(filled), columns)]
    margin = np.broadcast_to(np.float32(images.PAPER), (GAP, *rows[0].shape[1:]))  # keeps text away from the row above
    whole = np.concatenate([piece for row in reversed(rows) for piece in (row, margin)])
    with scratch():
        images.save(np.round(whole * shades) / shades, path)


def joined(parts, axis):
    """Join pictures side by side, with a gap between them."""
    gap = np.ones((len(parts[0]), GAP, 3), np.float32)
    spaced = [piece for part in parts for piece in (gap, part)][1:]
    return np.concatenate(spaced, axis=axis)


@contextmanager
def scratch():
    """Remove everything that was created inside it when it ends."""
    data = bpy.data
    kinds = (data.scenes, data.objects, data.meshes, data.curves, data.materials, data.cameras, data.images)
    existing = [set(kind) for kind in kinds]
    try:
        yield
    finally:
        for kind, before in zip(kinds, existing):
            bpy.data.batch_remove(set(kind) - before)


def _halves(ob, up, comparison, size, margin):
    scene = bpy.data.scenes.new("picture")
    mesh = _colored_copy(scene, ob, comparison.searched)
    given, found = comparison.given, comparison.found
    view = views.best_view(mesh, comparison.in_view or given + found, up, margin)
    set_up(scene, view, (size, size))
    thickness = view.width * (SIZE / size) ** 0.5  # lines of small pictures are slightly thicker
    given_tubes = _tubes(scene, given, ORANGE, 0.0060 * thickness)
    _balls(scene, mesh, comparison.held, 0.0160 * thickness)
    before = images.render(scene)
    for drawn in given_tubes:
        drawn.data.bevel_depth = 0.0035 * thickness
    _tubes(scene, found, BLUE, 0.0070 * thickness)
    for truth in comparison.truths:  # on top, where it coincides with the contour found
        tube(scene, truth, BLACK, 0.0022 * thickness, lift=0.0130 * thickness)
    return before, images.render(scene)


def _colored_copy(scene, ob, band):
    mesh = ob.data.copy()
    mesh.materials.clear()
    mesh.materials.append(images.material("surface", GREY))
    mesh.materials.append(images.material("band", GREEN))
    index = np.zeros(len(mesh.polygons), np.int32)
    index[band] = 1
    mesh.polygons.foreach_set("material_index", index)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    if hasattr(mesh, "use_auto_smooth"):  # up to Blender 4.0
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, SMOOTH_ANGLE
    else:
        mesh.set_sharp_from_angle(angle=SMOOTH_ANGLE)
    images.link(scene, "surface", mesh)
    return mesh


def set_up(scene, view, size):
    images.workbench(scene, *size)
    shading = scene.display.shading
    shading.show_cavity, shading.cavity_type = True, "WORLD"
    shading.show_shadows = False
    camera = images.link(scene, "camera", bpy.data.cameras.new("camera"))
    camera.matrix_world = view.matrix
    camera.data.type, camera.data.ortho_scale = "ORTHO", view.width
    camera.data.clip_start, camera.data.clip_end = 1e-4 * view.width, view.depth
    scene.camera = camera


def _tubes(scene, curves, color, radius):
    return [tube(scene, curve, color, radius, lift=radius) for curve in curves]


def tube(scene, curve, color, radius, lift):
    """Add a tube along a curve, lifted off the surface."""
    data = bpy.data.curves.new("contour", "CURVE")
    data.dimensions, data.bevel_depth, data.bevel_resolution = "3D", radius, 2
    spline = data.splines.new("POLY")
    spline.points.add(len(curve.points) - 1)
    lifted = np.concatenate([curve.points + lift * curve.normals, np.ones((len(curve.points), 1))], axis=1)
    spline.points.foreach_set("co", lifted.ravel())
    spline.use_cyclic_u = curve.closed
    data.materials.append(images.material("contour", color))
    return images.link(scene, "contour", data)


def _balls(scene, mesh, vertices, radius):
    """Add a ball at each of the vertices."""
    bm = bmesh.new()
    for vertex in vertices:
        place = Matrix.Translation(mesh.vertices[vertex].co)
        bmesh.ops.create_icosphere(bm, subdivisions=3, radius=radius, matrix=place)
    balls = bpy.data.meshes.new("held")
    bm.to_mesh(balls)
    bm.free()
    balls.materials.append(images.material("held", PURPLE))
    images.link(scene, "held", balls)
