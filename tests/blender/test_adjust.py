# SPDX-License-Identifier: GPL-3.0-or-later
"""The modal operator as scripts and the redo panel run it, and its errors; window/ tests it in a window."""

import bmesh
import bpy
import pytest
from made_meshes import (
    GROOVE,
    SEGMENTS,
    but_selection,
    edge_set,
    edit,
    grooved_cylinder,
    marked_edges,
    mesh_object,
    mesh_state,
    pairs,
    ring,
    rough_loop,
    select,
)
from minimum_ratio_contours.core import native, preview_state

LOOP = rough_loop(GROOVE - 4)
ABOVE = (GROOVE + 1) * SEGMENTS + 5
ADJUST = bpy.ops.mesh.adjust_contour


def prepared(*loops):
    obj = grooved_cylinder()
    edit(obj)
    for loop in loops or (LOOP,):
        select(obj, pairs(loop))
    bpy.ops.ed.undo_push(message="prepared")
    return obj


def now():
    return bpy.data.objects["Cylinder"]


def pin(vertex, contour=0):
    return {"name": "", "contour": contour, "vertex": vertex}


def ends(edges):
    return {end for pair in edges for end in pair}


@pytest.mark.parametrize("settings", [{"output": "SEAM"}, {"output": "CUT", "refinement": 2}, {"output": "RIP"}])
def test_without_pins_the_result_is_that_of_optimize_contour(settings):
    prepared()
    assert ADJUST("EXEC_DEFAULT", True, width=8, **settings) == {"FINISHED"}
    adjusted = mesh_state(now())
    bpy.ops.ed.undo()
    bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, width=8, **settings)
    assert mesh_state(now()) == adjusted


def test_the_contour_passes_its_pins_also_after_redo():
    before = mesh_state(prepared())
    ADJUST("EXEC_DEFAULT", True, width=8, reach=0.0, pins=[pin(ABOVE)])
    adjusted = mesh_state(now())
    assert ABOVE in ends(marked_edges(now(), "select"))
    bpy.ops.ed.undo()
    assert mesh_state(now()) == before
    bpy.ops.ed.redo()
    assert mesh_state(now()) == adjusted


def test_each_contour_has_its_own_pins():
    prepared(rough_loop(3), ring(16))
    ADJUST("EXEC_DEFAULT", True, width=2, min_salience=0.0, pins=[pin(2 * SEGMENTS + 9), pin(17 * SEGMENTS + 9, 1)])
    assert ends(marked_edges(now(), "select")) >= {2 * SEGMENTS + 9, 17 * SEGMENTS + 9}


def test_pins_outside_the_band_are_counted(last):
    obj = prepared()
    before = mesh_state(obj)
    assert ADJUST(width=1, pins=[pin(ABOVE), pin(ABOVE + 1)]) == {"CANCELLED"}
    assert mesh_state(obj) == before
    assert "2 pinned vertices" in last.message


@pytest.mark.parametrize("contour", [-1, 1, 5])
def test_pins_of_a_missing_contour_count_as_outside(contour, last):
    obj = prepared()
    before = mesh_state(obj)
    assert ADJUST(pins=[pin(ABOVE, contour)]) == {"CANCELLED"}
    assert mesh_state(obj) == before
    assert last.message.startswith("1 pinned vertex lies outside the band")


def test_pins_that_no_contour_can_pass_are_reported(last):
    obj = prepared()
    before = mesh_state(obj)
    assert ADJUST(width=8, reach=0.0, max_turn=0.2, pins=[pin(ABOVE), pin(ABOVE - 3 * SEGMENTS + 1)]) == {"CANCELLED"}
    assert mesh_state(obj) == before
    assert "passes all pinned vertices" in last.message


@pytest.mark.parametrize("call", ["EXEC_DEFAULT", "INVOKE_DEFAULT"])
def test_nothing_selected(call, last):
    obj = prepared()
    bpy.ops.mesh.select_all(action="DESELECT")
    before = mesh_state(obj)
    assert ADJUST(call) == {"CANCELLED"}
    assert mesh_state(obj) == before
    assert last.message


def test_a_branching_selection_is_reported(last):
    obj = prepared()
    select(obj, [(ABOVE, ABOVE + 1), (ABOVE, ABOVE - 1), (ABOVE, ABOVE + SEGMENTS)])
    bpy.ops.mesh.select_all(action="DESELECT")
    select(obj, [(ABOVE, ABOVE + 1), (ABOVE, ABOVE - 1), (ABOVE, ABOVE + SEGMENTS)])
    before = mesh_state(obj)
    assert ADJUST() == {"CANCELLED"}
    assert but_selection(mesh_state(obj)) == but_selection(before)
    assert [vertex.index for vertex in bmesh.from_edit_mesh(obj.data).verts if vertex.select] == [ABOVE]
    assert "branches" in last.message


def test_selections_that_are_not_contours_are_left_out():
    obj = mesh_object(
        "Loose", [(column, row, 0) for row in range(2) for column in range(4)], edges=[(6, 7)], faces=[(0, 1, 5, 4)]
    )
    other = prepared()
    bpy.ops.object.mode_set(mode="OBJECT")
    edit(other, obj)
    select(obj, [(6, 7)])
    select(other, pairs(LOOP))
    assert ADJUST(width=8) == {"FINISHED"}
    assert marked_edges(other, "select") == edge_set(ring(GROOVE))


def test_a_missing_library_is_reported(monkeypatch, last):
    def missing():
        raise native.Unavailable("no library")

    prepared()
    monkeypatch.setattr(native, "module", missing)
    with pytest.raises(RuntimeError, match="no library"):
        ADJUST()
    assert last.message == "no library"


def test_the_operator_needs_edit_mode():
    grooved_cylinder()
    assert not ADJUST.poll()


def test_the_keys_cycle_through_all_outputs():
    items = ADJUST.get_rna_type().properties["output"].enum_items
    assert tuple(item.identifier for item in items) == preview_state.OUTPUTS
