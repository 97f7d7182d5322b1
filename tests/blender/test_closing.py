# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh.optimize_contour with close: chains of edges are closed around their limb before they are optimized."""

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import (
    GROOVE,
    GROOVE_EDGES,
    SEGMENTS,
    but_selection,
    edge_set,
    edit,
    grooved_cylinder,
    mark_edges,
    marked_edges,
    mesh_object,
    mesh_state,
    pairs,
    ring,
    rough_loop,
    select,
)

QUARTER = rough_loop(GROOVE - 3)[5:16]


def start(*chains, mode="EDGE", **shape):
    obj = grooved_cylinder(**shape)
    edit(obj, mode=mode)
    for chain in chains:
        select(obj, pairs(chain, closed=False))
    return obj


def run(**properties):
    return bpy.ops.mesh.optimize_contour(**({"close": True} | properties))


@pytest.mark.parametrize("mode", ["VERTEX", "EDGE"])
def test_a_quarter_of_a_loop_is_enough(mode, last):
    obj = start(QUARTER, mode=mode)
    assert run() == {"FINISHED"}
    assert marked_edges(obj, "select") == GROOVE_EDGES
    assert last.message.startswith("1 contour improved: clear boundary, ")


def test_without_close_a_chain_stays_open():
    obj = start(QUARTER)
    assert run(close=False, output="SEAM", min_salience=0.0) == {"FINISHED"}
    counts = np.bincount([vertex for edge in marked_edges(obj, "seam") for vertex in edge])
    assert sorted(np.flatnonzero(counts == 1)) == sorted([QUARTER[0], QUARTER[-1]])


@pytest.mark.parametrize("keep_old", [False, True])
def test_the_seam_along_the_chain_moves_with_it(keep_old):
    obj = start(QUARTER)
    chain = {frozenset(pair) for pair in pairs(QUARTER, closed=False)}
    mark_edges(obj, pairs(QUARTER, closed=False), "seam")
    assert run(output="SEAM", keep_old=keep_old) == {"FINISHED"}
    assert marked_edges(obj, "seam") == (GROOVE_EDGES | chain if keep_old else GROOVE_EDGES)


def test_the_closed_loop_is_selected_if_nothing_is_better(last):
    obj = start(ring(8)[:9], depth=0)
    assert run() == {"FINISHED"}
    assert marked_edges(obj, "select") == edge_set(ring(8))
    assert last.message.startswith("1 contour unchanged: ")


def test_a_single_edge_can_be_closed():
    obj = start(ring(GROOVE)[:2])
    assert run() == {"FINISHED"}
    assert marked_edges(obj, "select") == GROOVE_EDGES


def test_closed_loops_are_optimized_as_usual_next_to_a_chain():
    obj = start(rough_loop(4)[5:16], grooves=(5, 15))
    select(obj, pairs(rough_loop(13)))
    assert run(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == edge_set(ring(5)) | edge_set(ring(15))


@pytest.mark.parametrize("output", ["SELECT", "SEAM", "RIP"])
def test_a_chain_on_a_plane_cannot_be_closed(output, last):
    positions = [(x, y, 0) for y in range(7) for x in range(7)]
    faces = [(i, i + 1, i + 8, i + 7) for i in range(42) if i % 7 < 6]
    obj = mesh_object("Sheet", positions, faces=faces)
    edit(obj)
    select(obj, pairs([22, 23, 24, 25], closed=False))
    before = mesh_state(obj)
    assert run(output=output) == {"CANCELLED"}
    assert but_selection(mesh_state(obj)) == but_selection(before)
    assert [vertex.index for vertex in bmesh.from_edit_mesh(obj.data).verts if vertex.select] == [22, 25]
    assert last.message.startswith("Left unchanged: nothing leads from vertex 25")
    assert "draw the chain on a limb" in last.message


def test_of_two_chains_on_one_limb_only_the_first_is_closed(last):
    other = ring(GROOVE - 2)[20:28]
    obj = start(QUARTER, other)
    assert run(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == GROOVE_EDGES
    assert marked_edges(obj, "select") == GROOVE_EDGES | {frozenset(pair) for pair in pairs(other, closed=False)}
    assert f"the open chain from vertex {other[0]} to {other[-1]}, once closed, would meet another" in last.message


def test_face_mode_ignores_close():
    """A border that ends at the mesh border is an open chain and stays open."""
    selections = []
    for close in (False, True):
        obj = start(mode="FACE")
        for face in bmesh.from_edit_mesh(obj.data).faces:
            face.select_set(face.index < (GROOVE - 2) * SEGMENTS and face.index % SEGMENTS < SEGMENTS // 2)
        assert run(close=close, output="SEAM", min_salience=0.0) == {"FINISHED"}
        ends = np.bincount([vertex for edge in marked_edges(obj, "seam") for vertex in edge]) == 1
        assert sum(ends) == 2
        selections.append(mesh_state(obj))
        bpy.ops.object.mode_set(mode="OBJECT")
    assert selections[0] == selections[1]


def test_both_halves_of_a_mirrored_mesh_are_closed():
    """Of two cylinders that are mirror images, a chain on one is closed around both."""
    one = grooved_cylinder()
    points = [vertex.co.copy() for vertex in one.data.vertices]
    faces = [tuple(polygon.vertices) for polygon in one.data.polygons]
    mirrored = [(-x - 3, y, z) for x, y, z in points]
    both = [(x + 3, y, z) for x, y, z in points] + [(x, y, z) for x, y, z in mirrored]
    shifted = [tuple(len(points) + vertex for vertex in reversed(face)) for face in faces]
    obj = mesh_object("Legs", both, faces=faces + shifted)
    obj.data.use_mirror_x = True
    edit(obj)
    select(obj, pairs(QUARTER, closed=False))
    assert run(output="SEAM") == {"FINISHED"}
    image = [len(points) + vertex for vertex in ring(GROOVE)]
    assert marked_edges(obj, "seam") == GROOVE_EDGES | edge_set(image)


def test_undo_and_redo():
    start(QUARTER)
    bpy.ops.ed.undo_push(message="prepared")
    before = mesh_state(bpy.data.objects["Cylinder"])
    assert bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, close=True, output="SEAM") == {"FINISHED"}
    after = mesh_state(bpy.data.objects["Cylinder"])
    assert after != before
    bpy.ops.ed.undo()
    assert mesh_state(bpy.data.objects["Cylinder"]) == before
    bpy.ops.ed.redo()
    assert mesh_state(bpy.data.objects["Cylinder"]) == after


def test_the_tooltip_says_what_it_does():
    close = bpy.ops.mesh.optimize_contour.get_rna_type().properties["close"]
    assert "around the limb" in close.description
    assert not close.default
