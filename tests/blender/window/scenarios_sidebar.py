# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user does in the sidebar and the redo panel, by clicks."""

import bmesh
import bpy
import numpy as np
from made_meshes import GROOVE, edge_set, mark_edges, marked_edges, mesh_state, pairs, ring
from minimum_ratio_contours.core import parameters
from minimum_ratio_contours.ui import panels
from prepared import LOOP, cylinder, now

BUTTON = "mesh.optimize_contour()"
ROW = 24  # pixels from one row of settings to the next, at the default resolution
PRESETS = 66  # pixels from the right end of the sidebar to the icon of the presets


def remembered():
    return bpy.context.window_manager.operator_properties_last(panels.OPERATOR)


def test_the_button_optimizes_and_the_panel_shows_the_result(window):
    cylinder()
    yield from window.open_sidebar()
    window.picture("sidebar-before")
    yield from window.push("UI", BUTTON)
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))
    yield from window.move(20, 20)
    window.picture("sidebar-after")
    assert "1 contour improved" in bpy.context.window_manager.minimum_ratio_contours.message


def test_the_output_is_chosen_by_clicks(window):
    cylinder()
    yield from window.open_sidebar()
    height = yield from window.find("UI", "mesh.adjust_contour()")
    yield from window.move_over(window.mouse[0], height - 1.3 * ROW)
    yield from window.press("LEFTMOUSE")
    yield from window.rest()
    window.picture("sidebar-output")
    yield from window.press("DOWN_ARROW", times=2)
    yield from window.press("RET")
    assert remembered().output == "SEAM"
    yield from window.push("UI", BUTTON)
    assert marked_edges(now(), "seam") == edge_set(ring(GROOVE))
    yield from window.press("Z", ctrl=True)
    assert not marked_edges(now(), "seam")


def test_a_setting_is_typed_in(window):
    cylinder()
    remembered().width = 37
    yield from window.open_sidebar()
    yield from window.find("UI", "37")
    yield from window.press("RET")
    yield from window.press("A", ctrl=True)
    yield from window.type("1")
    yield from window.press("RET")
    assert remembered().width == 1
    yield from window.push("UI", BUTTON)
    assert marked_edges(now(), "select") != edge_set(ring(GROOVE))  # the groove is four rings away


def test_a_preset_is_chosen_by_clicks(window):
    cylinder()
    yield from window.open_sidebar()
    region = window.region_of("UI")
    yield from window.move_over(region.x + region.width - PRESETS, region.y + region.height - ROW // 2)
    yield from window.press("LEFTMOUSE")
    yield from window.rest()
    window.picture("sidebar-presets")
    x, y = window.mouse
    for below in range(0, 12 * ROW, ROW // 2):
        yield from window.move_over(x, y - below)
        if "preset='FAR'" in (yield from window.copied()):
            break
    yield from window.press("LEFTMOUSE")
    yield from window.press("ESC")
    assert remembered().width == parameters.PRESETS["FAR"][2]["width"]


def test_all_panels_unfold(window):
    obj = cylinder()
    before = mesh_state(obj)
    yield from window.open_sidebar()
    region = window.region_of("UI")
    yield from window.move_over(region.x + 60, region.y + region.height - ROW // 2)
    yield from window.press("A")  # folds the panel under the mouse, and unfolds it
    window.picture("sidebar-folded")
    yield from window.press("A")
    assert mesh_state(obj) == before


def test_all_seams_are_optimized_with_the_settings_of_the_panel(window):
    obj = cylinder()
    mark_edges(obj, pairs(LOOP), "seam")
    remembered().width = 1
    yield from window.open_sidebar()
    yield from window.push("UI", "mesh.optimize_seams(")
    narrow = marked_edges(now(), "seam")
    remembered().width = 8
    yield from window.push("UI", "mesh.optimize_seams(")
    assert narrow != edge_set(ring(GROOVE))
    assert marked_edges(now(), "seam") == edge_set(ring(GROOVE))


def test_a_change_in_the_redo_panel_runs_again(window):
    cylinder()
    yield from window.open_sidebar()
    remembered().width, remembered().iterations, remembered().reach, remembered().min_salience = 37, 1, 0.0, 0.0
    yield from window.push("UI", BUTTON)
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))
    region = window.region_of("HUD")
    yield from window.move_over(region.x + region.width // 2, region.y + region.height - ROW // 2)
    yield from window.press("LEFTMOUSE")
    yield from window.rest()
    window.picture("redo")
    yield from window.find("HUD", "37")
    yield from window.press("RET")
    yield from window.press("A", ctrl=True)
    yield from window.type("2")
    yield from window.press("RET")
    yield from window.rest()
    window.picture("redo-again")
    assert bpy.context.window_manager.operators[-1].width == 2
    assert marked_edges(now(), "select") not in (edge_set(ring(GROOVE)), edge_set(LOOP))


def fine_cylinder():
    """Make the cylinder with 16 faces for each of the usual ones, and the same loop selected."""
    obj = cylinder()
    mark_edges(obj, pairs(LOOP), "seam")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=3)
    bm = bmesh.from_edit_mesh(obj.data)
    bpy.ops.mesh.select_all(action="DESELECT")
    for edge in bm.edges:
        edge.select_set(edge.seam)
    bm.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)
    return obj


def test_a_long_search_shows_its_progress_and_escape_cancels_it(window):
    obj = fine_cylinder()
    before = mesh_state(obj)
    yield from window.wait()
    untouched = window.upper(window.picture("search-before"))
    settings = {"refinement": 8, "iterations": 64, "regular_iterations": 0, "reach": 0.0, "width": 64}
    assert window.operator("optimize_contour", **settings) == {"RUNNING_MODAL"}
    yield from window.rest()
    window.picture("search")
    yield from window.press("ESC")
    assert mesh_state(obj) == before
    assert "Cancelled" in bpy.context.window_manager.minimum_ratio_contours.message
    yield from window.wait()
    left = window.upper(window.picture("search-after"))
    assert np.abs(left - untouched).max(axis=2).mean() < 1e-3  # Blender redraws some edges of such a fine mesh
