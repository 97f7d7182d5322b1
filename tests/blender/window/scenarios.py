# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user does with the modal operator, and the expected results."""

import math

import bmesh
import bpy
import numpy as np
from made_meshes import (
    GROOVE,
    SEGMENTS,
    edge_set,
    marked_edges,
    mesh_state,
    pairs,
    ring,
    select,
)
from mathutils import Matrix, Vector
from minimum_ratio_contours.core.preview import Preview
from prepared import FRONT, LOOP, cylinder, now


def test_escape_changes_nothing(window):
    obj = cylinder()
    before = mesh_state(obj)
    yield from window.wait()
    untouched = window.picture("before")
    for leave in ("ESC", "RIGHTMOUSE"):
        assert window.operator("adjust_contour", width=2) == {"RUNNING_MODAL"}
        yield from window.press("WHEELUPMOUSE", times=3)
        yield from window.press("R")
        yield from window.click(obj, (GROOVE - 2) * SEGMENTS + FRONT)
        assert not np.array_equal(window.picture("adjusting"), untouched)
        yield from window.move(20, 20)
        yield from window.press(leave)
        assert mesh_state(obj) == before
        assert np.array_equal(window.picture("after"), untouched)


def test_the_wheel_widens_the_band_and_one_undo_reverts_everything(window):
    before = mesh_state(cylinder())
    window.operator("adjust_contour", width=1, reach=0.0)
    yield from window.press("WHEELUPMOUSE", times=5)
    yield from window.press("RET")
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))
    assert bpy.context.window_manager.operators[-1].width == 6
    yield from window.press("Z", ctrl=True)
    assert mesh_state(now()) == before


def test_queued_events_cause_one_search(window):
    cylinder()
    window.operator("adjust_contour", width=1, reach=0.0)
    widths, search = [], Preview.search

    def counted(preview, state):
        widths.append(state.settings["width"])
        search(preview, state)

    Preview.search = counted
    try:
        yield from window.turn("WHEELUPMOUSE", 12)
        yield from window.turn("WHEELDOWNMOUSE", 7)
        assert widths == [13, 6]
        yield from window.wait()
        assert widths == [13, 6]  # no further search starts by itself
        for key in ("WHEELUPMOUSE", "WHEELDOWNMOUSE", "RET"):  # confirming waits for the search
            window.turn(key, 1).send(None)
        yield from window.wait()
    finally:
        Preview.search = search
    assert widths == [13, 6, 6]
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))


def test_a_narrow_band_does_not_reach_the_groove(window):
    cylinder()
    window.operator("adjust_contour", width=6, reach=0.0)
    yield from window.press("WHEELDOWNMOUSE", times=5)
    yield from window.press("SPACE")
    assert marked_edges(now(), "select") != edge_set(ring(GROOVE))


def test_the_contour_passes_a_pinned_vertex_and_a_second_click_unpins_it(window):
    matrix = Matrix.Translation((0.5, 0.0, 0.5)) @ Matrix.Rotation(math.radians(20.0), 4, "Y")
    vertex = (GROOVE - 3) * SEGMENTS + FRONT
    for clicks in (1, 2):
        obj = cylinder(matrix)
        window.operator("adjust_contour", width=8, reach=0.0)
        for _ in range(clicks):
            yield from window.click(obj, vertex)
        yield from window.wait()
        window.picture(f"pins-{clicks}")
        yield from window.press("NUMPAD_ENTER")
        passed = {end for pair in marked_edges(now(), "select") for end in pair}
        assert (vertex in passed) == (clicks == 1)
        with window.context():
            bpy.ops.ed.undo_redo()  # as the redo panel does after a change
        assert {end for pair in marked_edges(now(), "select") for end in pair} == passed
        yield from window.fresh()


def test_pins_outside_the_band_are_not_applied(window):
    obj = cylinder()
    before = mesh_state(obj)
    window.operator("adjust_contour", width=8, reach=0.0)
    yield from window.click(obj, (GROOVE + 1) * SEGMENTS + FRONT)
    yield from window.press("WHEELDOWNMOUSE", times=7)
    window.picture("pin-outside")
    yield from window.press("RET")
    assert mesh_state(obj) == before
    yield from window.press("WHEELUPMOUSE", times=7)
    yield from window.press("RET")
    assert (GROOVE + 1) * SEGMENTS + FRONT in {end for pair in marked_edges(now(), "select") for end in pair}


def test_keys_refine_and_choose_the_output(window):
    faces = len(cylinder().data.polygons)
    window.operator("adjust_contour", width=8, reach=0.0)
    yield from window.press("R", times=2)
    yield from window.press("S")
    yield from window.press("O")
    window.picture("refined")
    yield from window.press("RET")
    last = bpy.context.window_manager.operators[-1]
    assert (last.refinement, last.length_bias, last.output) == (2, 2.5, "SEAM")
    seam = marked_edges(now(), "seam")
    assert seam
    assert seam != edge_set(LOOP)
    yield from window.press("Z", ctrl=True)
    assert not marked_edges(now(), "seam")
    assert len(now().data.polygons) == faces


def test_the_view_can_be_turned_meanwhile(window):
    cylinder()
    rotation = window.view.view_rotation.copy()
    window.operator("adjust_contour", width=1, reach=0.0)
    yield from window.move(400, 400)
    yield from window.drag("MIDDLEMOUSE", 60, 20)
    assert window.view.view_rotation.rotation_difference(rotation).angle > 0.01
    yield from window.press("NUMPAD_5")
    yield from window.wait()
    window.picture("turned")
    yield from window.press("WHEELUPMOUSE", times=5)
    yield from window.press("RET")
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))


def test_other_keys_and_clicks_do_nothing(window):
    obj = cylinder()
    before = mesh_state(obj)
    window.operator("adjust_contour", width=8, reach=0.0)
    yield from window.move(30, 30)
    yield from window.press("LEFTMOUSE")
    for key in ("A", "G", "TAB", "DEL"):
        yield from window.press(key)
    yield from window.press("Z", ctrl=True)
    yield from window.press("ESC")
    assert mesh_state(obj) == before


def test_the_operator_starts_from_the_settings_of_the_panel(window):
    cylinder()
    last = bpy.context.window_manager.operator_properties_last("mesh.optimize_contour")
    last.width, last.reach, last.output = 5, 0.0, "SEAM"
    window.operator("adjust_contour")
    yield from window.press("WHEELUPMOUSE")
    yield from window.press("RET")
    assert marked_edges(now(), "seam") == edge_set(ring(GROOVE))
    assert (last.width, last.output) == (6, "SEAM")


def test_the_sidebar_can_be_open(window):
    cylinder()
    window.area.spaces.active.show_region_ui = True
    window.operator("adjust_contour", width=8)
    yield from window.wait()
    window.picture("sidebar")
    yield from window.press("ESC")


def test_what_is_refused_is_framed_and_undo_restores_the_selection(window):
    """The culprit is an edge that has three faces."""
    obj = cylinder()
    a, b, *_ = ring(GROOVE - 3)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.faces.new([bm.verts[a], bm.verts[b], bm.verts.new((2, 0, 1))])
    for edge in bm.edges:
        edge.select_set(False)
    bmesh.update_edit_mesh(obj.data)
    select(obj, pairs(ring(GROOVE - 3)))
    bpy.ops.ed.undo_push(message="prepared")
    before = mesh_state(obj)
    assert window.operator("optimize_contour") == {"CANCELLED"}
    for _ in range(30):  # the view moves smoothly
        yield
    shown = [vertex for vertex in bmesh.from_edit_mesh(now().data).verts if vertex.select]
    assert {a, b} <= {vertex.index for vertex in shown} != set(ring(GROOVE - 3))
    center = sum((vertex.co for vertex in shown), Vector()) / len(shown)
    assert (window.view.view_location - center).length < 0.5
    window.picture("refused")
    yield from window.press("Z", ctrl=True)
    assert mesh_state(now()) == before


def test_nothing_selected(window):
    obj = cylinder()
    bpy.ops.mesh.select_all(action="DESELECT")
    before = mesh_state(obj)
    assert window.operator("adjust_contour") == {"CANCELLED"}
    assert mesh_state(obj) == before
    yield from window.wait()


def test_outside_a_3d_viewport_the_message_says_what_to_do(window):
    obj = cylinder()
    before = mesh_state(obj)
    outliner = next(area for area in window.window.screen.areas if area.type == "OUTLINER")
    with bpy.context.temp_override(window=window.window, area=outliner):
        assert bpy.ops.mesh.adjust_contour("INVOKE_DEFAULT", True) == {"CANCELLED"}
    assert mesh_state(obj) == before
    assert "3D Viewport" in bpy.context.window_manager.minimum_ratio_contours.message
    yield from window.wait()


def test_a_failure_leaves_no_overlay_behind(window):
    cylinder()
    yield from window.wait()
    untouched = window.upper(window.picture("before"))
    window.operator("adjust_contour")
    search, Preview.search = Preview.search, None
    try:
        yield from window.press("PAGE_UP")  # the viewport does not use this key
    finally:
        Preview.search = search
    yield from window.wait()
    assert np.array_equal(window.upper(window.picture("after")), untouched)
