# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults of a mesh are named in one sentence and selected, and the cure that the sentence names helps."""

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import (
    GROOVE,
    GROOVE_EDGES,
    SEGMENTS,
    edge_set,
    edit,
    grooved_cylinder,
    marked_edges,
    mesh_object,
    pairs,
    ring,
    select,
)
from minimum_ratio_contours.core import mesh_faults

ROW = GROOVE - 3


def shape():
    obj = grooved_cylinder()
    return [tuple(v.co) for v in obj.data.vertices], [tuple(f.vertices) for f in obj.data.polygons]


def at_height(obj, row):
    """The edges of a mesh that lie on a ring of the cylinder, wherever its vertices are numbered."""
    on = {v.index for v in obj.data.vertices if abs(v.co.z - 0.2 * row) < 1e-5}
    return [tuple(e.vertices) for e in obj.data.edges if set(e.vertices) <= on]


def refused(last, **properties):
    assert bpy.ops.mesh.optimize_contour(**properties) == {"CANCELLED"}
    return last.message


def selected(obj, kind="verts"):
    return {element.index for element in getattr(bmesh.from_edit_mesh(obj.data), kind) if element.select}


def finds_the_groove(obj, last):
    """With the loop selected anew."""
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.mesh.select_mode(type="EDGE")
    obj.update_from_editmode()
    select(obj, at_height(obj, ROW))
    assert bpy.ops.mesh.optimize_contour() == {"FINISHED"}
    assert last.message == "1 contour improved: clear boundary, 3 rings away"


def exploded():
    positions, faces = shape()
    corners = [vertex for face in faces for vertex in face]
    ends = np.cumsum([0, *(len(face) for face in faces)]).tolist()
    obj = mesh_object(
        "Exploded", [positions[v] for v in corners], faces=[tuple(range(*pair)) for pair in zip(ends, ends[1:])]
    )
    edit(obj)
    return obj


@pytest.mark.parametrize("close", [False, True])
@pytest.mark.parametrize("output", ["SELECT", "SEPARATE"])
def test_a_loop_on_faces_with_vertices_of_their_own(output, close, last):
    obj = exploded()
    select(obj, at_height(obj, ROW))
    assert refused(last, output=output, close=close) == f"Left unchanged: {mesh_faults.NOT_JOINED}"
    assert selected(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.remove_doubles()
    finds_the_groove(obj, last)


def test_selected_faces_with_vertices_of_their_own(last):
    obj = exploded()
    bpy.ops.mesh.select_mode(type="FACE")
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    for face in bm.faces[: ROW * SEGMENTS]:
        face.select_set(True)
    bmesh.update_edit_mesh(obj.data)
    assert refused(last) == f"Left unchanged: {mesh_faults.NOT_JOINED}"


@pytest.mark.parametrize("row", [ROW, GROOVE])
def test_a_loop_along_a_split(row, last):
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(ring(row)))
    bmesh.ops.split_edges(
        bmesh.from_edit_mesh(obj.data), edges=[e for e in bmesh.from_edit_mesh(obj.data).edges if e.select]
    )
    bmesh.update_edit_mesh(obj.data)
    obj.update_from_editmode()
    bpy.ops.mesh.select_all(action="DESELECT")
    select(obj, at_height(obj, row))
    assert refused(last) == f"Left unchanged: {mesh_faults.NOT_JOINED}"
    assert len(selected(obj)) == 2 * SEGMENTS


@pytest.mark.parametrize("close", [False, True])
def test_a_loop_across_a_split(close, last):
    """It is a loop to the eye, and a chain whose ends lie at the same place."""
    obj = grooved_cylinder()
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    column = [e for e in bm.edges if all(v.index % SEGMENTS == 5 for v in e.verts)]
    bmesh.ops.split_edges(bm, edges=column)
    bm.verts.index_update()
    bmesh.update_edit_mesh(obj.data)
    obj.update_from_editmode()
    select(obj, at_height(obj, ROW))
    assert refused(last, close=close) == f"Left unchanged: {mesh_faults.NOT_JOINED}"
    places = {tuple(round(x, 5) for x in obj.data.vertices[v].co) for v in selected(obj)}
    assert len(places) == 1
    assert len(selected(obj)) == 2


def test_a_part_of_a_loop_that_a_split_does_not_let_close(last):
    obj = grooved_cylinder()
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    column = [e for e in bm.edges if all(v.index % SEGMENTS == 20 for v in e.verts)]
    bmesh.ops.split_edges(bm, edges=column)
    bm.verts.index_update()
    bmesh.update_edit_mesh(obj.data)
    obj.update_from_editmode()
    select(obj, pairs(ring(ROW)[:10], closed=False))
    assert "Merge by Distance" in refused(last, close=True) or mesh_faults.NOT_JOINED in last.message


def test_faces_that_lie_on_each_other(last):
    positions, faces = shape()
    obj = mesh_object("Doubled", positions, faces=faces)
    obj.data.clear_geometry()
    obj.data.from_pydata(positions, [], faces + [face[::-1] for face in faces])
    edit(obj)
    select(obj, pairs(ring(ROW)))
    assert refused(last) == f"Left unchanged: {mesh_faults.DOUBLED}"
    assert bpy.context.tool_settings.mesh_select_mode[:] == (False, False, True)
    assert selected(obj, "faces") == set(range(len(faces), 2 * len(faces)))
    bpy.ops.mesh.delete(type="FACE")
    finds_the_groove(obj, last)


BESIDE = [(ROW, "Left unchanged"), (ROW - 1, "1 contour unchanged")]  # on a fault, and a ring beside it


@pytest.mark.parametrize(("row", "start"), BESIDE)
def test_a_wall_inside(row, start, last):
    positions, faces = shape()
    obj = mesh_object("Walled", positions, faces=[*faces, tuple(ring(ROW))])
    edit(obj)
    select(obj, pairs(ring(row)))
    assert refused(last) == f"{start}: {mesh_faults.WALLED}"
    assert selected(obj) == set(ring(ROW))


def test_normals_that_are_flipped_in_part(last):
    positions, faces = shape()
    obj = mesh_object("Flipped", positions, faces=[f[::-1] if min(f) >= ring(ROW)[0] else f for f in faces])
    edit(obj)
    select(obj, pairs(ring(ROW)))
    assert refused(last) == f"Left unchanged: {mesh_faults.FLIPPED}"
    assert selected(obj) == set(ring(ROW))
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.normals_make_consistent(inside=False)
    finds_the_groove(obj, last)


def bow_tie(row):
    positions, faces = shape()
    tip, n = ring(row)[4], len(positions)
    x, y, z = positions[tip]
    positions += [(x + 0.4, y, z + 0.1), (x + 0.4, y + 0.2, z - 0.1), (x + 0.4, y - 0.2, z - 0.1)]
    faces += [(tip, n, n + 1), (tip, n + 1, n + 2), (tip, n + 2, n), (n, n + 2, n + 1)]
    obj = mesh_object("Bow tie", positions, faces=faces)
    edit(obj)
    return obj, tip


@pytest.mark.parametrize(("row", "start"), BESIDE)
def test_a_vertex_at_which_faces_meet_in_a_point(row, start, last):
    obj, tip = bow_tie(ROW)
    select(obj, pairs(ring(row)))
    assert refused(last) == f"{start}: {mesh_faults.PINCHED}"
    assert selected(obj) == {tip}


@pytest.mark.parametrize("row", [GROOVE, GROOVE + 1])
def test_a_dent_is_explained(row, last):
    """The result goes around a vertex at which faces meet in a point."""
    obj, _ = bow_tie(row)
    select(obj, pairs(ring(ROW)))
    assert bpy.ops.mesh.optimize_contour() == {"FINISHED"}
    assert last.message.startswith("1 contour improved: ")
    assert last.message.endswith(f". A fault of the mesh may have dented a contour: {mesh_faults.PINCHED}")


def test_far_from_a_fault_nothing_is_said_of_it(last):
    obj, _ = bow_tie(2)
    select(obj, pairs(ring(ROW)))
    assert bpy.ops.mesh.optimize_contour() == {"FINISHED"}
    assert last.message == "1 contour improved: clear boundary, 3 rings away"
    assert marked_edges(obj, "select") == GROOVE_EDGES


def test_where_a_band_has_ended_at_a_fault_it_says_so_instead_of_why_the_contour_stays(last):
    positions, faces = shape()
    obj = mesh_object("Walled", positions, faces=[*faces, tuple(ring(7))])
    edit(obj)
    select(obj, pairs(ring(5)))
    assert refused(last) == f"1 contour unchanged: {mesh_faults.WALLED}"
    assert selected(obj) == set(ring(7))
    select(obj, pairs(ring(5)))
    assert bpy.ops.mesh.optimize_contour(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == edge_set(ring(5))
