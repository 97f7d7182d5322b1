# SPDX-License-Identifier: GPL-3.0-or-later
"""If nothing can be done, the operator says why, cancels, and leaves the mesh and selection unchanged."""

import sys

import bmesh
import bpy
import pytest
from made_meshes import (
    GROOVE,
    OUTPUTS,
    RINGS,
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
    torus,
    torus_ring,
)
from minimum_ratio_contours.core import mesh_faults, native


def cancelled(obj, **properties):
    """Run the operator, which must cancel and change nothing."""
    before = mesh_state(obj)
    assert bpy.ops.mesh.optimize_contour(**properties) == {"CANCELLED"}
    assert mesh_state(obj) == before


def shown_by(obj, **properties):
    """Run the operator, which must cancel and change nothing but the selection. Return the vertices that it selects."""
    before = mesh_state(obj)
    assert bpy.ops.mesh.optimize_contour(**properties) == {"CANCELLED"}
    assert but_selection(mesh_state(obj)) == but_selection(before)
    assert bpy.context.tool_settings.mesh_select_mode[:] == (True, False, False)
    return {vertex.index for vertex in bmesh.from_edit_mesh(obj.data).verts if vertex.select}


@pytest.mark.parametrize("mode", ["VERTEX", "EDGE", "FACE"])
@pytest.mark.parametrize("output", OUTPUTS)
def test_nothing_selected(mode, output, last, capfd):
    obj = grooved_cylinder()
    edit(obj, mode=mode)
    cancelled(obj, output=output)
    assert last.message.startswith("Nothing to optimize: select closed loops or open chains")
    assert last.message in capfd.readouterr().out


def test_one_vertex_selected(last):
    obj = grooved_cylinder()
    edit(obj, mode="VERTEX")
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.verts[40].select_set(True)
    cancelled(obj)
    assert last.message.startswith("Nothing to optimize")


@pytest.mark.parametrize("output", OUTPUTS)
def test_a_chain_of_one_edge(output, last):
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(ring(5)[:2], closed=False))
    assert shown_by(obj, output=output) == set(ring(5)[:2])
    ends = f"{ring(5)[0]}-{ring(5)[1]}"
    assert last.message == (
        f"Left unchanged: a single edge, {ends}, has nothing between its ends to move; "
        "turn on Close Chains to take the loop through it around the limb, or select a longer chain"
    )


def test_everything_selected(last):
    obj = grooved_cylinder()
    edit(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    assert shown_by(obj) == set(range(RINGS * SEGMENTS))
    assert "the selection branches at vertices 0, 1, 2 and " in last.message


@pytest.mark.parametrize("several", [False, True])
def test_the_whole_mesh_in_face_mode_has_no_border_to_move(several, last):
    obj = grooved_cylinder()
    edit(obj, *([grooved_cylinder("Other")] if several else []), mode="FACE")
    bpy.ops.mesh.select_all(action="SELECT")
    cancelled(obj)
    assert last.message == "Left unchanged: the selected faces have no border inside the mesh: deselect some"


def test_a_mesh_selected_as_a_whole_is_named_and_the_other_is_done(last):
    obj, other = grooved_cylinder(), grooved_cylinder("Other")
    edit(obj, other, mode="FACE")
    bpy.ops.mesh.select_all(action="SELECT")
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        face.select_set(max(vertex.index for vertex in face.verts) < (GROOVE - 2) * SEGMENTS)
    bmesh.update_edit_mesh(obj.data)
    assert bpy.ops.mesh.optimize_contour(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == edge_set(ring(GROOVE))
    assert "Other: the selected faces have no border" in last.message


@pytest.mark.parametrize("row", [0, RINGS - 1])
def test_a_loop_along_the_mesh_border_is_named(row, last):
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(ring(row)))
    shown = shown_by(obj, output="SEAM")
    assert shown
    assert shown <= set(ring(row))
    assert "border" in last.message
    assert any(str(vertex) in last.message for vertex in ring(row))


def hide_faces(obj, hidden):
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        if hidden({vertex.index // SEGMENTS for vertex in face.verts}):
            face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)


def test_a_loop_along_hidden_faces_is_searched_on_its_visible_side(last):
    obj = grooved_cylinder()
    edit(obj)
    hide_faces(obj, lambda rows: max(rows) <= GROOVE - 2)
    before = [face.hide for face in bmesh.from_edit_mesh(obj.data).faces]
    select(obj, pairs(ring(GROOVE - 2)))
    assert bpy.ops.mesh.optimize_contour(width=4) == {"FINISHED"}
    assert marked_edges(obj, "select") == edge_set(ring(GROOVE))
    assert [face.hide for face in bmesh.from_edit_mesh(obj.data).faces] == before


def test_a_mesh_without_faces(last):
    obj = mesh_object("Points", [(0, 0, 0), (1, 0, 0)], edges=[(0, 1)])
    edit(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    assert shown_by(obj) == {0, 1}
    assert "an open chain has loose edges that no face uses (0-1)" in last.message


def test_an_empty_mesh(last):
    obj = mesh_object("Empty", [])
    edit(obj)
    cancelled(obj)
    assert last.message.startswith("Nothing to optimize")


def without_library(monkeypatch):
    monkeypatch.setitem(sys.modules, "minimum_ratio_contours.mrcontour", None)
    monkeypatch.setitem(sys.modules, "mrcontour", None)


def test_the_library_missing(monkeypatch, last):
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(rough_loop(9)))
    before = mesh_state(obj)
    without_library(monkeypatch)
    # For scripts, Blender turns an error report of an operator into an exception.
    with pytest.raises(RuntimeError, match="compiled library"):
        bpy.ops.mesh.optimize_contour(output="SEAM")
    assert mesh_state(obj) == before
    assert last.message == native.problem()


@pytest.mark.parametrize(
    "command", ["optimize_contour", "adjust_contour", "optimize_seams", "optimize_segmentation", "show_curvature"]
)
def test_every_command_of_a_package_for_another_system_says_so_in_one_sentence(monkeypatch, command):
    obj = grooved_cylinder()
    edit(obj)
    before = mesh_state(obj)
    without_library(monkeypatch)
    monkeypatch.setattr(native, "TARGET", "plan9-mips-cp27")
    with pytest.raises(RuntimeError, match=r"^Error: This package is for plan9 mips and Python 2\.7, .* cp3\d+\n$"):
        getattr(bpy.ops.mesh, command)()
    assert mesh_state(obj) == before


def test_a_library_of_another_version(monkeypatch):
    obj = grooved_cylinder()
    edit(obj)
    monkeypatch.setattr(native.module(), "__version__", "0.0.1")
    with pytest.raises(RuntimeError, match="restart Blender"):
        bpy.ops.mesh.optimize_contour()


def with_fin():
    """Add a triangle on the first edge of ring 5, which then has three faces."""
    obj = grooved_cylinder()
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    tip = bm.verts.new((2, 0, 1))
    bm.verts.ensure_lookup_table()
    bm.faces.new([bm.verts[ring(5)[0]], bm.verts[ring(5)[1]], tip])
    bmesh.update_edit_mesh(obj.data)
    obj.update_from_editmode()
    return obj


@pytest.mark.parametrize("output", OUTPUTS)
def test_an_edge_of_three_faces(output, last):
    obj = with_fin()
    select(obj, pairs(ring(5)))
    assert shown_by(obj, output=output) >= set(ring(5)[:2])
    assert last.message == f"Left unchanged: {mesh_faults.WALLED}"


def test_faces_whose_normals_disagree(last):
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(ring(5)))
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    bm.faces[5 * SEGMENTS + 3].normal_flip()
    bmesh.update_edit_mesh(obj.data)
    shown = shown_by(obj)
    assert shown & set(ring(5)[3:5])
    assert len(shown) <= 4
    assert last.message == f"Left unchanged: {mesh_faults.FLIPPED}"


def test_loose_edges_attached_to_a_surface(last):
    """Two points of the surface are joined by a chain of edges without faces."""
    obj = grooved_cylinder()
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    middle = bm.verts.new((2, 0, 1))
    bm.verts.ensure_lookup_table()
    loose = [bm.edges.new((bm.verts[ring(5)[0]], middle)), bm.edges.new((middle, bm.verts[ring(5)[9]]))]
    for edge in loose:
        edge.select_set(True)
    bmesh.update_edit_mesh(obj.data)
    obj.update_from_editmode()
    assert shown_by(obj) == {vertex.index for edge in loose for vertex in edge.verts}
    assert "has loose edges that no face uses" in last.message
    assert "select edges of faces only" in last.message


def test_a_selection_that_branches(last):
    obj = grooved_cylinder()
    edit(obj)
    column = [row * SEGMENTS + 4 for row in range(3, 20)]
    select(obj, pairs(ring(7)) + pairs(column, closed=False))
    assert shown_by(obj, output="SEAM") == {7 * SEGMENTS + 4}
    assert f"the selection branches at vertex {7 * SEGMENTS + 4}; select single loops" in last.message


def test_vertices_at_the_same_point(last):
    obj = grooved_cylinder()
    for vertex in obj.data.vertices:
        vertex.co = (1, 2, 3)
    edit(obj)
    select(obj, pairs(ring(7)))
    cancelled(obj)
    assert "lie at one point" in last.message or "length 0" in last.message


def test_a_bad_contour_does_not_block_the_others(last):
    obj = with_fin()
    select(obj, pairs(ring(5)) + pairs(rough_loop(GROOVE - 3)))
    assert bpy.ops.mesh.optimize_contour(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == edge_set(ring(GROOVE))
    assert marked_edges(obj, "select") == edge_set(ring(GROOVE)) | edge_set(ring(5))
    assert "an edge of more than two faces" in last.message


def cylinder_of_loops():
    """Select every inner ring, so that the bands have no room to grow."""
    obj = grooved_cylinder(depth=0)
    edit(obj)
    select(obj, [pair for row in range(1, RINGS - 1) for pair in pairs(ring(row))])
    return obj


@pytest.mark.parametrize("output", ["SELECT", "CUT"])
def test_loops_without_room_between_them(output, last):
    obj = torus()
    edit(obj)
    select(obj, [pair for i in range(24) for pair in pairs(torus_ring(i))])
    cancelled(obj, output=output, min_salience=0.0)
    assert "no faces around it to search: select fewer contours" in last.message
    assert "nearby limited the search" in last.message


def test_loops_without_room_are_output_anyway(last):
    obj = cylinder_of_loops()
    expected = marked_edges(obj, "select")
    assert bpy.ops.mesh.optimize_contour(output="SEAM", min_salience=0.0) == {"FINISHED"}
    assert marked_edges(obj, "seam") == expected
    assert "no faces around it to search: select fewer contours" in last.message


def test_a_linked_mesh(tmp_path):
    """Blender cannot edit it; the message says how to make it editable."""
    library = str(tmp_path / "library.blend")
    bpy.data.libraries.write(library, {grooved_cylinder("Linked")})
    with bpy.data.libraries.load(library, link=True) as (_, linked):
        linked.objects = ["Linked"]
    bpy.context.scene.collection.objects.link(linked.objects[0])
    bpy.context.view_layer.objects.active = linked.objects[0]
    try:
        with pytest.raises(RuntimeError, match="read-only: make it local first"):
            bpy.ops.mesh.optimize_contour()
    finally:
        bpy.data.libraries.remove(linked.objects[0].library)


def test_object_mode():
    grooved_cylinder()
    assert not bpy.ops.mesh.optimize_contour.poll()
    with pytest.raises(RuntimeError, match="Edit Mode"):
        bpy.ops.mesh.optimize_contour()


def test_edit_mode_of_something_else():
    curve = bpy.data.objects.new("Curve", bpy.data.curves.new("Curve", "CURVE"))
    bpy.context.scene.collection.objects.link(curve)
    bpy.context.view_layer.objects.active = curve
    bpy.ops.object.mode_set(mode="EDIT")
    assert not bpy.ops.mesh.optimize_contour.poll()


def test_no_object():
    assert not bpy.ops.mesh.optimize_contour.poll()
