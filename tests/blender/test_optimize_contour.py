# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh.optimize_contour on simple meshes: every output, several loops and objects, and what must not change."""

import bmesh
import bpy
import pytest
from made_meshes import (
    GROOVE,
    GROOVE_EDGES,
    RINGS,
    SEGMENTS,
    START,
    edge_set,
    edit,
    find_edges,
    grooved_cylinder,
    mark_edges,
    marked_edges,
    mesh_object,
    mesh_state,
    pairs,
    ring,
    rough_loop,
    run,
    select,
    select_faces_below,
)
from minimum_ratio_contours.core import edge_paths


def start(mode="EDGE", loop=START):
    """Make a grooved cylinder in Edit Mode with a rough loop near the groove selected."""
    obj = grooved_cylinder()
    edit(obj, mode=mode)
    select(obj, pairs(loop))
    return obj


@pytest.mark.parametrize("mode", ["VERTEX", "EDGE"])
def test_the_selection_moves_into_the_groove(mode, last, capfd):
    obj = start(mode)
    assert marked_edges(obj, "select") == edge_set(START)
    assert run(output="SELECT") == {"FINISHED"}
    assert marked_edges(obj, "select") == GROOVE_EDGES
    assert not marked_edges(obj, "seam")
    assert not marked_edges(obj, "sharp")
    numbers = last.contours[0]
    assert (numbers.place, numbers.status) == ("Cylinder", "improved")
    assert numbers.ratio < numbers.initial_ratio
    assert numbers.faces > 0
    assert numbers.milliseconds > 0
    assert last.message.startswith("1 contour improved: clear boundary, ")
    assert f"Info: {last.message}" in capfd.readouterr().out


@pytest.mark.parametrize("flow", ["GATES", "ARC_LENGTH", "HARMONIC"])
def test_every_flow_finds_the_groove(flow):
    obj = start()
    run(flow=flow)
    assert marked_edges(obj, "select") == GROOVE_EDGES


@pytest.mark.parametrize("flag", ["seam", "sharp"])
def test_a_mark_is_set_along_the_result_and_nowhere_else(flag):
    obj = start()
    other = {"seam": "sharp", "sharp": "seam"}[flag]
    assert run(output=flag.upper()) == {"FINISHED"}
    assert marked_edges(obj, flag) == marked_edges(obj, "select") == GROOVE_EDGES
    assert not marked_edges(obj, other)


@pytest.mark.parametrize("flag", ["seam", "sharp"])
@pytest.mark.parametrize("keep_old", [False, True])
def test_a_mark_along_the_given_loop_moves_unless_it_is_kept(flag, keep_old):
    obj = start()
    elsewhere = pairs(ring(2))
    mark_edges(obj, pairs(START) + elsewhere, flag)
    run(output=flag.upper(), keep_old=keep_old)
    expected = GROOVE_EDGES | {frozenset(pair) for pair in elsewhere}
    assert marked_edges(obj, flag) == (expected | edge_set(START) if keep_old else expected)


def test_the_whole_surface_reaches_farther_than_the_width():
    obj = start(loop=rough_loop(2))
    run(width=1, whole_surface=True, anchor=0.0)
    assert marked_edges(obj, "select") == GROOVE_EDGES


@pytest.mark.parametrize(("iterations", "arrives"), [(1, False), (64, True)])
def test_iterations_reach_farther_than_one_search(iterations, arrives):
    obj = start()
    run(width=1, iterations=iterations)
    assert (marked_edges(obj, "select") == GROOVE_EDGES) == arrives


def test_an_unchanged_contour_is_output_anyway_and_the_report_says_why(last):
    obj = start(loop=ring(GROOVE))
    assert run(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == marked_edges(obj, "select") == GROOVE_EDGES
    assert last.contours[0].status == "unchanged"
    assert last.message.startswith("1 contour unchanged: ")


def test_a_redo_that_finds_nothing_shows_the_given_contour():
    """If a redo is canceled, Blender restores the previous result."""
    obj = start(loop=ring(GROOVE))
    before = mesh_state(obj)
    assert run() == {"FINISHED"}
    assert mesh_state(obj) == before


def test_several_loops_at_once_move_and_never_cross(last):
    obj = grooved_cylinder(grooves=(5, 15))
    edit(obj)
    select(obj, pairs(rough_loop(4)) + pairs(rough_loop(13)))
    run(output="SEAM")
    assert marked_edges(obj, "seam") == edge_set(ring(5)) | edge_set(ring(15))
    assert [numbers.status for numbers in last.contours] == ["improved", "improved"]
    assert last.message.startswith("2 contours improved: clear boundaries, up to ")


def test_two_loops_near_one_groove_do_not_both_move_into_it():
    obj = start()
    select(obj, pairs(rough_loop(GROOVE + 1)))
    run(output="SEAM")
    seams = marked_edges(obj, "seam")
    loops = edge_paths.sort_edges([sorted(edge) for edge in seams])
    assert len(loops.loops) == 2
    assert not loops.branching


def test_selected_faces_are_those_whose_edges_are_all_selected():
    """A loop around one face selects that face too; it must be deselected when the loop moves away."""
    face = [5 * SEGMENTS, 5 * SEGMENTS + 1, 6 * SEGMENTS + 1, 6 * SEGMENTS]
    obj = start(loop=face)
    assert sum(face.select for face in bmesh.from_edit_mesh(obj.data).faces) == 1
    run(min_salience=0.0, length_bias=0.0, anchor=0.0)
    assert marked_edges(obj, "select") != edge_set(face)
    for face in bmesh.from_edit_mesh(obj.data).faces:
        assert face.select == all(edge.select for edge in face.edges)


def test_branching_selections_stay_and_are_named(last, capfd):
    obj = start()
    branch = pairs(ring(2)[:11], closed=False) + [(row * SEGMENTS + 5, (row + 1) * SEGMENTS + 5) for row in range(2, 6)]
    select(obj, branch)
    assert run(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == GROOVE_EDGES
    assert marked_edges(obj, "select") == GROOVE_EDGES | {frozenset(pair) for pair in branch}
    assert f"Warning: {last.message}" in capfd.readouterr().out
    assert f"branches at vertex {2 * SEGMENTS + 5};" in last.message


def test_the_border_of_selected_faces_in_face_mode():
    """The rough border of the region moves into the groove; nothing is concave near its border at ring 2."""
    obj = grooved_cylinder()
    edit(obj, mode="FACE")
    select_faces_below(obj, START)
    run(output="SEAM")
    seams = marked_edges(obj, "seam")
    assert seams > GROOVE_EDGES
    assert not edge_set(START) & (seams - GROOVE_EDGES)
    assert tuple(bpy.context.tool_settings.mesh_select_mode) == (False, False, True)
    assert selected_faces(obj) == set(range(2 * SEGMENTS, GROOVE * SEGMENTS))


def selected_faces(obj):
    return {face.index for face in bmesh.from_edit_mesh(obj.data).faces if face.select}


def select_first_faces(obj, count):
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    for face in bm.faces[:count]:
        face.select_set(True)
    bmesh.update_edit_mesh(obj.data)


def test_only_the_inner_border_of_a_region_at_the_mesh_border_moves():
    obj = grooved_cylinder()
    edit(obj, mode="FACE")
    select_first_faces(obj, (GROOVE - 2) * SEGMENTS)
    run(output="SELECT")
    assert selected_faces(obj) == set(range(GROOVE * SEGMENTS))
    assert not marked_edges(obj, "seam")


def selected_faces_but(obj, *changed):
    """Select the faces below the groove, but for these, of which those above it are added."""
    edit(obj, mode="FACE")
    select_first_faces(obj, (GROOVE - 2) * SEGMENTS)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    for index in changed:
        bm.faces[index].select_set(not bm.faces[index].select)
    bmesh.update_edit_mesh(obj.data)


@pytest.mark.parametrize("output", ["SELECT", "SEAM", "SEPARATE"])
def test_stray_islands_and_pinholes_are_left_out_and_the_report_says_so(output, last):
    """Two faces that share a vertex above, one hole amid the part, and one whose corner touches the border."""
    obj = grooved_cylinder()
    above = [(RINGS - 4) * SEGMENTS + 3, (RINGS - 3) * SEGMENTS + 4]
    notch = (GROOVE - 3) * SEGMENTS + 9
    selected_faces_but(obj, *above, 2 * SEGMENTS + 20, notch, notch - SEGMENTS + 1)
    assert run(output=output) == {"FINISHED"}
    assert last.message.startswith("1 contour improved: ")
    assert last.message.endswith("Left out of the selection: 2 islands, 2 pinholes")
    if output == "SEPARATE":
        obj.update_from_editmode()
        assert sorted(len(other.data.vertices) for other in bpy.data.objects) == sorted(
            [(GROOVE + 1) * SEGMENTS, (RINGS - GROOVE) * SEGMENTS]
        )
        return
    assert selected_faces(obj) == set(range(GROOVE * SEGMENTS))
    assert marked_edges(obj, "seam") == (GROOVE_EDGES if output == "SEAM" else set())
    lower = {edge for edge in map(frozenset, all_pairs(obj)) if max(edge) < (GROOVE + 1) * SEGMENTS}
    assert marked_edges(obj, "select") == lower


def all_pairs(obj):
    return [[vertex.index for vertex in edge.verts] for edge in bmesh.from_edit_mesh(obj.data).edges]


def test_parts_that_touch_at_a_vertex_are_contours_of_their_own(last):
    """Two patches of similar size share a corner, so both are meant."""
    obj = grooved_cylinder()
    edit(obj, mode="FACE")
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        row, column = divmod(face.index, SEGMENTS)
        face.select_set((3 <= row < 7 and 3 <= column < 9) or (7 <= row < 10 and 9 <= column < 15))
    bmesh.update_edit_mesh(obj.data)
    run(output="SEAM", min_salience=0.0)
    assert len(last.contours) == 2
    assert "Left out" not in last.message


def test_all_objects_in_edit_mode_are_optimized(last):
    first, second = grooved_cylinder("First"), grooved_cylinder("Second")
    edit(first, second)
    for obj in (first, second):
        select(obj, pairs(START))
    assert run(output="SHARP") == {"FINISHED"}
    assert marked_edges(first, "sharp") == marked_edges(second, "sharp") == GROOVE_EDGES
    assert {numbers.place for numbers in last.contours} == {"First", "Second"}


def test_faces_selected_in_several_objects():
    first, second = grooved_cylinder("First"), grooved_cylinder("Second")
    edit(first, second, mode="FACE")
    for obj in (first, second):
        select_first_faces(obj, (GROOVE - 2) * SEGMENTS)
    run(output="SEAM")
    for obj in (first, second):
        assert marked_edges(obj, "seam") == GROOVE_EDGES
        assert selected_faces(obj) == set(range(GROOVE * SEGMENTS))


def test_an_object_with_a_problem_is_named_and_unchanged(last):
    done, left = grooved_cylinder("Done"), grooved_cylinder("Left")
    edit(done, left)
    select(done, pairs(START))
    select(left, pairs(START[:2], closed=False))
    before = mesh_state(left)
    assert run(output="SEAM") == {"FINISHED"}
    assert mesh_state(left) == before
    assert "Left: a single edge" in last.message


def test_a_shared_mesh_is_optimized_once(last):
    obj = grooved_cylinder()
    twin = bpy.data.objects.new("Twin", obj.data)
    bpy.context.scene.collection.objects.link(twin)
    edit(obj, twin)
    select(obj, pairs(START))
    run()
    assert len(last.contours) == 1
    assert marked_edges(obj, "select") == GROOVE_EDGES


def test_hidden_geometry_is_untouched():
    obj = grooved_cylinder()
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    hidden = [face.index for face in bm.faces[(GROOVE - 1) * SEGMENTS : (GROOVE + 1) * SEGMENTS]]
    mark_edges(obj, pairs(ring(GROOVE)), "sharp")
    for edge in find_edges(bm, pairs(ring(GROOVE))):
        edge.hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    assert {face.index for face in bm.faces if face.hide} == set(hidden)
    select(obj, pairs(rough_loop(GROOVE - 4)))
    assert run(output="SEAM", width=8) == {"FINISHED"}
    bm = bmesh.from_edit_mesh(obj.data)
    assert {face.index for face in bm.faces if face.hide} == set(hidden)
    assert not any(edge.hide and (edge.seam or edge.select) for edge in bm.edges)
    assert marked_edges(obj, "sharp") == GROOVE_EDGES
    assert marked_edges(obj, "seam")


def test_measured_in_object_space(last):
    """Mirroring, scaling and moving the object changes none of the numbers."""
    obj = start()
    run()
    expected = last.contours[0].initial_ratio, last.contours[0].ratio
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(obj)
    obj = start()
    obj.scale = (-1, 1, 40)
    obj.rotation_euler = (1, 2, 3)
    obj.location = (0, 50, 0)
    bpy.context.view_layer.update()
    run()
    assert marked_edges(obj, "select") == GROOVE_EDGES
    assert (last.contours[0].initial_ratio, last.contours[0].ratio) == expected


def test_the_active_shape_key_is_measured():
    obj = grooved_cylinder(depth=0)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Groove")
    for vertex, point in zip(grooved_cylinder("Shape").data.vertices, key.data):
        point.co = vertex.co
    obj.active_shape_key_index = 1
    edit(obj)
    select(obj, pairs(START))
    run()
    assert marked_edges(obj, "select") == GROOVE_EDGES


def test_ngons():
    """Merging pairs of quads outside the band gives hexagons; the loop still finds the groove."""
    obj = grooved_cylinder()
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    across = [pair for row in range(1, RINGS - 2) for pair in pairs(ring(row)[: SEGMENTS // 4 : 2], closed=False)]
    uprights = [(a, a + SEGMENTS) for a, _ in across if a // SEGMENTS not in (GROOVE - 4, GROOVE - 3, GROOVE - 2)]
    bmesh.ops.dissolve_edges(bm, edges=find_edges(bm, uprights))
    bm.normal_update()
    bmesh.update_edit_mesh(obj.data)
    assert max(len(face.verts) for face in bm.faces) > 4
    select(obj, pairs(START))
    assert run() == {"FINISHED"}
    assert marked_edges(obj, "select") == GROOVE_EDGES


def test_only_marks_and_selection_change():
    obj = grooved_cylinder()
    mesh = obj.data
    mesh.uv_layers.new(name="UVMap")
    heat = mesh.attributes.new("Heat", "FLOAT", "POINT")
    heat.data.foreach_set("value", [0.5 * vertex.index for vertex in mesh.vertices])
    group = obj.vertex_groups.new(name="Group")
    group.add(ring(4), 0.5, "ADD")
    edit(obj)
    select(obj, pairs(START))
    mark_edges(obj, pairs(ring(2)), "sharp")
    before = mesh_state(obj)
    assert len(before["layers"]) >= 3
    run(output="SEAM")
    after = mesh_state(obj)
    assert after["layers"] == before["layers"]
    assert [co for co, _, _ in after["vertices"]] == [co for co, _, _ in before["vertices"]]
    assert [edge[:2] + edge[5:] for edge in after["edges"]] == [edge[:2] + edge[5:] for edge in before["edges"]]
    assert [face[:4] for face in after["faces"]] == [face[:4] for face in before["faces"]]
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not mesh.validate(verbose=True)
    assert sum(edge.use_seam for edge in mesh.edges) == SEGMENTS


@pytest.mark.parametrize("live", [False, True])
def test_live_unwrap_uses_a_new_seam(live):
    obj = grooved_cylinder()
    obj.data.uv_layers.new(name="UVMap")
    bpy.context.scene.tool_settings.use_edge_path_live_unwrap = live
    edit(obj)
    single = pairs(ring(3)[:2], closed=False)
    select(obj, pairs(START) + single)
    uv = ("corner", "uv", "UVMap")
    before = mesh_state(obj)["layers"][uv]
    run(output="SEAM")
    assert (mesh_state(obj)["layers"][uv] != before) == live
    assert marked_edges(obj, "seam") == GROOVE_EDGES
    assert marked_edges(obj, "select") == GROOVE_EDGES | {frozenset(pair) for pair in single}


def test_loops_of_loose_edges_are_named(last):
    positions = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    obj = mesh_object("Wire", positions, edges=pairs([0, 1, 2, 3]))
    edit(obj)
    select(obj, pairs([0, 1, 2, 3]))
    before = mesh_state(obj)
    assert run() == {"CANCELLED"}
    assert "a loop has loose edges that no face uses (0-1, 1-2, 2-3 and 1 more)" in last.message
    assert mesh_state(obj) == before
