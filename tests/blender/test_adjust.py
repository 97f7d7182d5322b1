# SPDX-License-Identifier: GPL-3.0-or-later
"""The modal operator as scripts and the redo panel run it, and where it refuses; its window has tests of its own."""

import bpy
import pytest
from made_meshes import (
    GROOVE,
    SEGMENTS,
    edge_set,
    edit,
    everything,
    flagged,
    grooved_cylinder,
    mesh_object,
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
def test_without_pins_it_does_what_optimize_contour_does(settings):
    prepared()
    assert ADJUST("EXEC_DEFAULT", True, width=8, **settings) == {"FINISHED"}
    adjusted = everything(now())
    bpy.ops.ed.undo()
    bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, width=8, **settings)
    assert everything(now()) == adjusted


def test_pins_are_passed_after_redo_too():
    before = everything(prepared())
    ADJUST("EXEC_DEFAULT", True, width=8, reach=0.0, pins=[pin(ABOVE)])
    adjusted = everything(now())
    assert ABOVE in ends(flagged(now(), "select"))
    bpy.ops.ed.undo()
    assert everything(now()) == before
    bpy.ops.ed.redo()
    assert everything(now()) == adjusted


def test_each_contour_has_its_own_pins():
    prepared(rough_loop(3), ring(16))
    ADJUST("EXEC_DEFAULT", True, width=2, min_salience=0.0, pins=[pin(2 * SEGMENTS + 9), pin(17 * SEGMENTS + 9, 1)])
    assert ends(flagged(now(), "select")) >= {2 * SEGMENTS + 9, 17 * SEGMENTS + 9}


def test_pins_outside_the_band_are_counted(last):
    obj = prepared()
    before = everything(obj)
    assert ADJUST(width=1, pins=[pin(ABOVE), pin(ABOVE + 1)]) == {"CANCELLED"}
    assert everything(obj) == before
    assert "2 pinned vertices" in last.message


@pytest.mark.parametrize("contour", [-1, 1, 5])
def test_pins_of_a_contour_that_is_not_there_are_outside(contour, last):
    obj = prepared()
    before = everything(obj)
    assert ADJUST(pins=[pin(ABOVE, contour)]) == {"CANCELLED"}
    assert everything(obj) == before
    assert last.message.startswith("1 pinned vertex lies outside the band")


def test_pins_that_no_contour_passes_are_explained(last):
    obj = prepared()
    before = everything(obj)
    assert ADJUST(width=8, reach=0.0, max_turn=0.2, pins=[pin(ABOVE), pin(ABOVE - 3 * SEGMENTS + 1)]) == {"CANCELLED"}
    assert everything(obj) == before
    assert "passes all pinned vertices" in last.message


@pytest.mark.parametrize("call", ["EXEC_DEFAULT", "INVOKE_DEFAULT"])
def test_nothing_selected(call, last):
    obj = prepared()
    bpy.ops.mesh.select_all(action="DESELECT")
    before = everything(obj)
    assert ADJUST(call) == {"CANCELLED"}
    assert everything(obj) == before
    assert last.message


def test_a_selection_that_branches_is_explained(last):
    obj = prepared()
    select(obj, [(ABOVE, ABOVE + 1), (ABOVE, ABOVE - 1), (ABOVE, ABOVE + SEGMENTS)])
    bpy.ops.mesh.select_all(action="DESELECT")
    select(obj, [(ABOVE, ABOVE + 1), (ABOVE, ABOVE - 1), (ABOVE, ABOVE + SEGMENTS)])
    before = everything(obj)
    assert ADJUST() == {"CANCELLED"}
    assert everything(obj) == before
    assert "branches" in last.message


def test_what_is_no_contour_is_left_out():
    obj = mesh_object(
        "Loose", [(column, row, 0) for row in range(2) for column in range(4)], edges=[(6, 7)], faces=[(0, 1, 5, 4)]
    )
    other = prepared()
    bpy.ops.object.mode_set(mode="OBJECT")
    edit(other, obj)
    select(obj, [(6, 7)])
    select(other, pairs(LOOP))
    assert ADJUST(width=8) == {"FINISHED"}
    assert flagged(other, "select") == edge_set(ring(GROOVE))


def test_a_missing_library_is_explained(monkeypatch, last):
    def missing():
        raise native.Unavailable("no library")

    prepared()
    monkeypatch.setattr(native, "module", missing)
    with pytest.raises(RuntimeError, match="no library"):
        ADJUST()
    assert last.message == "no library"


def test_it_needs_edit_mode():
    grooved_cylinder()
    assert not ADJUST.poll()


def test_the_keys_go_through_all_outputs():
    items = ADJUST.get_rna_type().properties["output"].enum_items
    assert tuple(item.identifier for item in items) == preview_state.OUTPUTS
