# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures before and after: the surface grey, the band green, the given loop orange, the contour found blue; where
one is known by construction, the loop that ought to be found black."""

from contextlib import contextmanager
from dataclasses import dataclass

import blender_meshes
import bpy
import captions
import images
import numpy as np
import views

SIZE, GAP = 700, 12  # pixels of one half, and between the halves
GREY, GREEN = (0.85, 0.85, 0.83), (0.42, 0.86, 0.40)
ORANGE, BLUE, BLACK = (1.0, 0.13, 0.0), (0.0, 0.10, 1.0), (0.02, 0.02, 0.02)


@dataclass
class Comparison:
    """What one picture shows: loops as vertices in order, the band as faces, and a line of words for each half."""

    given: list
    found: list
    truth: list | None
    band: np.ndarray
    title: str
    before: str
    after: str


def draw(path, ob, up, comparison):
    """One PNG, from scenes of their own that leave nothing behind."""
    with _scratch():
        before, after = _halves(ob, up, comparison)
        gap = np.ones((SIZE, GAP, 3), np.float32)
        right = SIZE + GAP + 10
        searched = f"{len(comparison.band)} faces searched (green)"
        if comparison.truth is not None:
            searched += ", true loop black"
        words = [(0, 10, comparison.title, BLACK), (0, right, searched, BLACK)]
        words += [(1, 10, comparison.before, ORANGE), (1, right, comparison.after, BLUE)]
        strip = captions.strip(2 * SIZE + GAP, words)
        images.save(np.concatenate([np.concatenate([before, gap, after], axis=1), strip]), path)


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


def _halves(ob, up, comparison):
    scene = bpy.data.scenes.new("picture")
    mesh = _coloured_copy(scene, ob, comparison.band)
    given, found = (_points_and_normals(mesh, loop) for loop in (comparison.given, comparison.found))
    view = views.best_view(mesh, [given, found], _band_points(mesh, comparison.band), up)
    _set_up(scene, view)
    given_tube = _tube(scene, given, ORANGE, 0.0060 * view.width)
    before = images.render(scene)
    given_tube.data.bevel_depth = 0.0035 * view.width
    _tube(scene, found, BLUE, 0.0070 * view.width)
    if comparison.truth is not None:
        _tube(scene, _points_and_normals(mesh, comparison.truth), BLACK, 0.0045 * view.width)
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


def _band_points(mesh, band):
    return np.array([mesh.vertices[v].co for face in band for v in mesh.polygons[face].vertices])


def _set_up(scene, view):
    images.workbench(scene, SIZE, SIZE)
    shading = scene.display.shading
    shading.show_cavity, shading.cavity_type = True, "WORLD"
    shading.show_shadows = False
    camera = images.link(scene, "camera", bpy.data.cameras.new("camera"))
    camera.matrix_world = view.matrix
    camera.data.type, camera.data.ortho_scale = "ORTHO", view.width
    camera.data.clip_start, camera.data.clip_end = 1e-4 * view.width, view.depth
    scene.camera = camera


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
