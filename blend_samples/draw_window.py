# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the manual's pictures of the add-on in a Blender window, with the hand: panel, live contour, curvature.

BLENDER_USER_SCRIPTS=build/release xvfb-run -a -s "-screen 0 1600x1000x24" env LIBGL_ALWAYS_SOFTWARE=1 blender \
    --factory-startup --window-geometry 0 0 1600 1000 --enable-event-simulate --python blend_samples/draw_window.py \
    -- blend_samples/pictures
"""

import os
import sys
import tempfile
import traceback
from pathlib import Path

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tests" / "blender" / "window")]
bpy.ops.preferences.addon_enable(module="minimum_ratio_contours")
bpy.context.preferences.view.show_splash = False

import blender_meshes  # noqa: E402
import images  # noqa: E402
import shapes  # noqa: E402
from driver import PAUSE, Window  # noqa: E402

SMOOTH = 40  # steps until all samples of a picture are drawn
SIZE, SHADES = (440, 380), 32
FINGER = "index"


def hand():
    """Load the sample into this scene."""
    with bpy.data.libraries.load(str(HERE / "hand.blend")) as (_, loaded):
        loaded.objects = ["hand"]
    bpy.context.scene.collection.objects.link(loaded.objects[0])
    bpy.context.view_layer.objects.active = loaded.objects[0]
    return loaded.objects[0]


def select_roughly(obj):
    """Select a wavy loop slightly above a finger's base."""
    centers = np.array([face.center for face in obj.data.polygons])
    base, axis = (np.array(vector) for vector in shapes.finger_axis(FINGER))
    heights = (centers - base) @ axis - 0.45 * np.sin(3 * centers[:, 0] + 5 * centers[:, 1])
    above = (shapes.parts_of_hand(centers) == FINGER) & (heights > 2.1)
    corners = [loop for face in np.flatnonzero(above) for loop in obj.data.polygons[face].loop_indices]
    edges = blender_meshes.read(obj.data.loops, "edge_index", 1, np.int32)[corners]
    blender_meshes.select_edges(obj.data, np.bincount(edges, minlength=len(obj.data.edges)) == 1)


def taken(window, box):
    """Return the pixels within a box of the window."""
    for _ in range(SMOOTH):
        yield
    x, y, width, height = box
    pixels = window.picture("window")[:, :, :3]
    return pixels[y : y + height, x : x + width]


def box_around(window, point, width, height):
    """Return a box in the window around a point in space."""
    x, y = location_3d_to_region_2d(window.region, window.view, point)
    return window.region.x + int(x) - width // 2, window.region.y + int(y) - height // 2, width, height


def save_view(window, place, path):
    """Save the view around a point, with few shades for a small file."""
    pixels = yield from taken(window, box_around(window, place, *SIZE))
    images.save(np.round(pixels * SHADES) / SHADES, path)


def draw(folder, window):
    yield from window.fresh()
    overlay = window.area.spaces.active.overlay
    overlay.show_floor = overlay.show_axis_x = overlay.show_axis_y = overlay.show_cursor = False
    obj = hand()
    select_roughly(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    window.view.view_rotation = Vector((-0.25, 1.0, -0.2)).to_track_quat("-Z", "Y")
    window.view.view_location, window.view.view_distance = (2.5, 0.0, 10.0), 14.0
    yield from window.open_sidebar()
    yield from window.move(20, 20)
    panel = window.region_of("UI")
    top = panel.y + panel.height
    images.save((yield from taken(window, (panel.x, top - 580, panel.width, 580))), folder / "panel.png")
    place = shapes.finger_point(FINGER, 0.1)
    window.operator("adjust_contour")
    yield from save_view(window, place, folder / "adjust.png")
    yield from window.press("ESC")
    bpy.ops.mesh.select_all(action="DESELECT")
    window.operator("show_curvature")
    window.operator("show_curvature_directions")
    yield from save_view(window, place, folder / "curvature.png")


def step():
    """Run one step, and exit explicitly: exceptions in timers leave Blender running."""
    status = 1
    try:
        next(running)
        return PAUSE
    except StopIteration:
        status = 0
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(status)


scratch = tempfile.TemporaryDirectory()
running = draw(Path(sys.argv[-1]).resolve(), Window(Path(scratch.name)))
bpy.app.timers.register(step, first_interval=0.5)
