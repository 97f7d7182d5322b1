# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature colors, and the directions drawn over them."""

import bmesh
import bpy
import numpy as np
from made_meshes import GROOVE, edge_set, marked_edges, mesh_state, ring
from minimum_ratio_contours.ui import show_directions
from prepared import cylinder, now

RESTED = 30  # steps until the lines are computed again


def turned_on(window):
    assert window.operator("show_curvature_directions") == {"FINISHED"}
    yield from window.wait()


def drawn(window, name):
    yield from window.wait()
    return window.upper(window.picture(name))


def rested(window):
    for _ in range(RESTED):
        yield


def moved(step):
    """Move the top rows of the cylinder sideways."""
    bm = bmesh.from_edit_mesh(now().data)
    for vertex in bm.verts:
        vertex.co.x += step * (vertex.co.z > 0.2 * GROOVE - 0.1)
    bmesh.update_edit_mesh(now().data)


def test_a_button_shows_and_hides_directions(window):
    before = mesh_state(cylinder())
    yield from window.open_sidebar()
    yield from window.move(20, 20)
    untouched = yield from drawn(window, "directions-off")
    yield from window.push("UI", "mesh.show_curvature_directions()")
    yield from window.move(20, 20)
    assert not np.array_equal((yield from drawn(window, "directions")), untouched)
    yield from window.push("UI", "mesh.show_curvature_directions()")
    yield from window.move(20, 20)
    assert np.array_equal((yield from drawn(window, "directions-off-again")), untouched)
    assert mesh_state(now()) == before


def test_directions_are_drawn_over_colors_and_next_to_an_optimized_contour(window):
    cylinder()
    yield from window.open_sidebar()
    yield from turned_on(window)
    yield from window.push("UI", "mesh.show_curvature()")
    yield from window.push("UI", "mesh.optimize_contour()")
    yield from rested(window)
    window.picture("directions-colors")
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))
    assert show_directions.is_shown()
    bpy.ops.mesh.show_curvature_directions()
    window.area.spaces.active.shading.color_type = "MATERIAL"


def test_directions_follow_the_mesh(window):
    cylinder()
    yield from turned_on(window)
    with_lines = yield from drawn(window, "directions-before")
    moved(0.4)
    yield from rested(window)
    assert not np.array_equal((yield from drawn(window, "directions-moved")), with_lines)
    assert show_directions.is_shown()
    moved(-0.4)
    yield
    yield from rested(window)
    back = yield from drawn(window, "directions-back")
    assert np.abs(back - with_lines).max(axis=2).mean() < 1e-3  # positions are single-precision
    bpy.ops.mesh.show_curvature_directions()


def test_undo_moves_directions_back(window):
    cylinder()
    yield from turned_on(window)
    with_lines = yield from drawn(window, "directions-before")
    moved(0.4)
    bpy.ops.ed.undo_push(message="moved")
    yield from rested(window)
    yield from window.press("Z", ctrl=True)
    yield from rested(window)
    assert np.array_equal((yield from drawn(window, "directions-undone")), with_lines)
    bpy.ops.mesh.show_curvature_directions()


def test_leaving_edit_mode_removes_directions(window):
    cylinder()
    yield from turned_on(window)
    yield from window.press("TAB")
    assert bpy.context.mode == "OBJECT"
    assert not show_directions.is_shown()


def test_disabling_the_add_on_removes_directions(window):
    cylinder()
    yield from turned_on(window)
    show_directions.unregister()
    try:
        assert not show_directions.is_shown()
    finally:
        show_directions.register()
    yield from window.wait()


def test_without_concavity_a_message_is_shown_and_no_directions(window):
    obj = cylinder()
    bm = bmesh.from_edit_mesh(obj.data)
    for vertex in bm.verts:
        vertex.co.xy = vertex.co.xy.normalized()
    bmesh.update_edit_mesh(obj.data)
    assert window.operator("show_curvature_directions") == {"CANCELLED"}
    assert not show_directions.is_shown()
    yield from window.wait()
