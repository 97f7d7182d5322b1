# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures before and after: the surface grey, the faces searched green, given loops orange, contours found blue; where
one is known by construction, the loop that ought to be found black."""

from contextlib import contextmanager
from dataclasses import dataclass, field

import blender_meshes
import bpy
import captions
import images
import numpy as np
import views

SIZE, GAP = 700, 12  # pixels of one half, and between the halves
OVERVIEW_SIZE, PAIRS_A_ROW = 344, 2
MARGIN, OVERVIEW_MARGIN = 2.0, 1.3  # width of what is shown, over that of the contours
SHADES = 44  # of each colour in the overview, for a small file
GREY, GREEN = (0.85, 0.85, 0.83), (0.55, 0.86, 0.52)
ORANGE, BLUE, BLACK, DARK_GREEN = (1.0, 0.13, 0.0), (0.0, 0.10, 1.0), (0.02, 0.02, 0.02), (0.10, 0.32, 0.09)


@dataclass
class Comparison:
    """What one picture shows: loops as vertices in order, the faces searched, and a line of words for each half."""

    title: str
    before: str
    after: str
    given: list
    found: list
    searched: np.ndarray
    truths: list = field(default_factory=list)


def draw(path, ob, up, comparison):
    """One PNG of a comparison."""
    searched = f"{len(comparison.searched)} faces searched (green)" + (", true loop black" if comparison.truths else "")
    right = SIZE + GAP + 10
    with _scratch():
        halves = _joined(_halves(ob, up, comparison, SIZE, MARGIN), axis=1)
        words = [(0, 10, comparison.title, BLACK), (0, right, searched, BLACK)]
        words += [(1, 10, comparison.before, ORANGE), (1, right, comparison.after, BLUE)]
        images.save(np.concatenate([halves, captions.strip(halves.shape[1], words)]), path)


def overview_pair(ob, up, comparison):
    """A comparison as a small picture; several are put together by `draw_overview`."""
    right = OVERVIEW_SIZE + GAP
    with _scratch():
        halves = _joined(_halves(ob, up, comparison, OVERVIEW_SIZE, OVERVIEW_MARGIN), axis=1)
        words = [(0, 4, comparison.title, BLACK), (0, right, "green: faces searched", DARK_GREEN)]
        words += [(1, 4, comparison.before, ORANGE), (1, right, comparison.after, BLUE)]
        return np.concatenate([halves, captions.strip(halves.shape[1], words)])


def draw_overview(path, pairs):
    """One PNG of several pairs, in rows, the first at the top left."""
    rows = [_joined(pairs[i : i + PAIRS_A_ROW], axis=1) for i in range(0, len(pairs), PAIRS_A_ROW)]
    with _scratch():
        images.save(np.round(np.concatenate(rows[::-1]) * SHADES) / SHADES, path)


def _joined(parts, axis):
    """Pictures side by side with a gap between them."""
    gap = np.ones((len(parts[0]), GAP, 3), np.float32)
    spaced = [piece for part in parts for piece in (gap, part)][1:]
    return np.concatenate(spaced, axis=axis)


@contextmanager
def _scratch():
    """Removes at its end all that was made in it."""
    data = bpy.data
    kinds = (data.scenes, data.objects, data.meshes, data.curves, data.materials, data.cameras, data.images)
    kept = [set(kind) for kind in kinds]
    try:
        yield
    finally:
        for kind, before in zip(kinds, kept):
            bpy.data.batch_remove(set(kind) - before)


def _halves(ob, up, comparison, size, margin):
    scene = bpy.data.scenes.new("picture")
    mesh = _coloured_copy(scene, ob, comparison.searched)
    given, found, truths = (
        [_points_and_normals(mesh, loop) for loop in loops]
        for loops in (comparison.given, comparison.found, comparison.truths)
    )
    view = views.best_view(mesh, given + found, up, margin)
    _set_up(scene, view, size)
    thickness = view.width * (SIZE / size) ** 0.5  # lines of small pictures are a little thicker
    given_tubes = _tubes(scene, given, ORANGE, 0.0060 * thickness)
    before = images.render(scene)
    for tube in given_tubes:
        tube.data.bevel_depth = 0.0035 * thickness
    _tubes(scene, found, BLUE, 0.0070 * thickness)
    _tubes(scene, truths, BLACK, 0.0045 * thickness)
    return before, images.render(scene)


def _coloured_copy(scene, ob, band):
    mesh = ob.data.copy()
    mesh.materials.clear()
    mesh.materials.append(images.material("surface", GREY))
    mesh.materials.append(images.material("band", GREEN))
    index = np.zeros(len(mesh.polygons), np.int32)
    index[band] = 1
    mesh.polygons.foreach_set("material_index", index)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    mesh.use_auto_smooth, mesh.auto_smooth_angle = True, 0.8
    images.link(scene, "surface", mesh)
    return mesh


def _points_and_normals(mesh, loop):
    positions = blender_meshes.read(mesh.vertices, "co", 3, np.float64)
    normals = blender_meshes.read(mesh.vertices, "normal", 3, np.float64)
    return positions[loop], normals[loop]


def _set_up(scene, view, size):
    images.workbench(scene, size, size)
    shading = scene.display.shading
    shading.show_cavity, shading.cavity_type = True, "WORLD"
    shading.show_shadows = False
    camera = images.link(scene, "camera", bpy.data.cameras.new("camera"))
    camera.matrix_world = view.matrix
    camera.data.type, camera.data.ortho_scale = "ORTHO", view.width
    camera.data.clip_start, camera.data.clip_end = 1e-4 * view.width, view.depth
    scene.camera = camera


def _tubes(scene, curves, colour, radius):
    return [_tube(scene, curve, colour, radius) for curve in curves]


def _tube(scene, curve, colour, radius):
    """A closed tube along a loop, lifted off the surface."""
    points, normals = curve
    data = bpy.data.curves.new("contour", "CURVE")
    data.dimensions, data.bevel_depth, data.bevel_resolution = "3D", radius, 2
    spline = data.splines.new("POLY")
    spline.points.add(len(points) - 1)
    lifted = np.concatenate([points + radius * normals, np.ones((len(points), 1))], axis=1)
    spline.points.foreach_set("co", lifted.ravel())
    spline.use_cyclic_u = True
    data.materials.append(images.material("contour", colour))
    return images.link(scene, "contour", data)
