# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh.optimize_seams on simple meshes: the network moves as a whole, and every island stays one island."""

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import (
    GROOVE,
    RINGS,
    SEGMENTS,
    START,
    dumbbell,
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
    torus,
    torus_ring,
)
from minimum_ratio_contours import api
from minimum_ratio_contours.core import native, parameters
from minimum_ratio_contours.mesh.arrays import synchronize


def start(seams, **more):
    obj = grooved_cylinder(**more)
    edit(obj)
    mark_edges(obj, seams, "seam")
    return obj


def run(**properties):
    return bpy.ops.mesh.optimize_seams(**properties)


def upright(column, low=0, high=RINGS - 1):
    """Return the edges from one ring to another, in a column."""
    return pairs([row * SEGMENTS + column for row in range(low, high + 1)], closed=False)


def islands(obj):
    """Return the number of pieces into which the seams cut the mesh."""
    bm = bmesh.from_edit_mesh(obj.data)
    pending, count = set(bm.faces), 0
    while pending:
        count += 1
        reached = [pending.pop()]
        while reached:
            neighbors = {f for edge in reached.pop().edges if not edge.seam for f in edge.link_faces} & pending
            pending -= neighbors
            reached += neighbors
    return count


def frozen(edges):
    return {frozenset(pair) for pair in edges}


def test_a_closed_seam_moves_into_the_groove(last, capfd):
    obj = start(pairs(START))
    assert run() == {"FINISHED"}
    assert marked_edges(obj, "seam") == edge_set(ring(GROOVE))
    assert marked_edges(obj, "select") == marked_edges(obj, "sharp") == set()
    assert last.message.startswith("1 of 1 seams moved: clear boundary, ")
    assert f"Info: {last.message}" in capfd.readouterr().out
    assert last.contours[0].ratio < last.contours[0].initial_ratio


def test_junctions_stay_and_the_chains_between_them_move():
    """A vertical seam and the loop stay together where they meet; the rest of the loop moves into the groove."""
    loop = rough_loop(GROOVE - 2, steps=1)
    obj = start(pairs(loop) + upright(0, high=GROOVE - 2))
    assert islands(obj) == 2
    assert run(min_salience=0.0) == {"FINISHED"}
    seams = marked_edges(obj, "seam")
    junction = (GROOVE - 2) * SEGMENTS
    assert sum(junction in edge for edge in seams) == 3
    assert len(seams & edge_set(ring(GROOVE))) > SEGMENTS // 2
    assert islands(obj) == 2


def groove_along(columns=17, rows=9, groove=10):
    """Make a sheet with a groove along column `groove`."""
    x, y = np.meshgrid(np.arange(columns) * 1.0, np.arange(rows) * 1.0)
    z = -1.2 * np.exp(-((x - groove) ** 2) / 2)
    faces = [
        (y * columns + x, y * columns + x + 1, (y + 1) * columns + x + 1, (y + 1) * columns + x)
        for y in range(rows - 1)
        for x in range(columns - 1)
    ]
    return mesh_object("Sheet", np.stack([x, y, z], axis=-1).reshape(-1, 3).tolist(), faces=faces)


def test_ends_on_the_border_slide_along_it():
    obj = groove_along()
    edit(obj)
    mark_edges(obj, pairs([17 * y + 8 for y in range(9)], closed=False), "seam")
    assert run() == {"FINISHED"}
    assert marked_edges(obj, "seam") == frozen(pairs([17 * y + 10 for y in range(9)], closed=False))
    assert islands(obj) == 2


def test_an_end_inside_the_surface_stays():
    obj = groove_along()
    edit(obj)
    mark_edges(obj, pairs([17 * y + 8 for y in range(7)], closed=False), "seam")
    assert run() == {"FINISHED"}
    seams = marked_edges(obj, "seam")
    assert sum(17 * 6 + 8 in edge for edge in seams) == 1
    assert not any(8 in edge for edge in seams)  # the other end has moved along the border
    assert islands(obj) == 1


def test_only_the_selected_seams_move():
    other = rough_loop(2)
    obj = start(pairs(START) + pairs(other))
    select(obj, pairs(START))
    assert run(selected_only=True, min_salience=0.0) == {"FINISHED"}
    assert marked_edges(obj, "seam") == edge_set(ring(GROOVE)) | edge_set(other)
    assert marked_edges(obj, "select") == edge_set(ring(GROOVE))


@pytest.mark.parametrize("offset", [0.0, 0.1])
def test_x_mirror_moves_the_seams_on_the_other_side_too(offset, last):
    obj = dumbbell(offset)
    obj.data.use_mirror_x = True
    edit(obj)
    low, high = rough_loop(4), [(RINGS - 1 - v // SEGMENTS) * SEGMENTS + v % SEGMENTS for v in rough_loop(4)]
    mark_edges(obj, pairs(low) + pairs(high), "seam")
    select(obj, pairs(low))
    assert run(selected_only=True) == {"FINISHED"}
    symmetric = offset == 0
    assert marked_edges(obj, "seam") == edge_set(ring(5)) | edge_set(ring(15) if symmetric else high)
    assert ("X Mirror is on" in last.message) != symmetric


def test_x_mirror_of_a_seam_that_ends_in_the_middle(last):
    """A seam and its mirror image that meet at a junction stay symmetric."""
    obj = dumbbell()
    obj.data.use_mirror_x = True
    edit(obj)
    mark_edges(obj, upright(3) + pairs(ring(10)), "seam")
    select(obj, upright(3, high=10) + pairs(ring(10)))
    run(selected_only=True)
    assert "X Mirror" not in last.message


def test_an_uneven_scale_causes_a_warning(last):
    obj = start(pairs(START))
    obj.scale = (1, 1, 2)
    bpy.context.view_layer.update()
    run()
    assert "apply it (Ctrl A > Scale)" in last.message


def test_inverted_normals_cause_a_warning(last):
    obj = torus()
    edit(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.flip_normals()
    mark_edges(obj, pairs(torus_ring(0)), "seam")
    run()
    assert "Recalculate Outside (Shift N)" in last.message


def test_part_of_a_seam_is_selected():
    obj = start(pairs(START))
    part = START[4:20]
    select(obj, pairs(part, closed=False) + upright(3, high=4))
    before = marked_edges(obj, "select")
    assert run(selected_only=True) == {"FINISHED"}
    seams = marked_edges(obj, "seam")
    assert seams >= edge_set(START) - frozen(pairs(part, closed=False))
    assert seams != edge_set(START)
    assert marked_edges(obj, "select") == before  # more than seams was selected


def test_a_selection_without_seams(last):
    obj = start(pairs(START))
    select(obj, upright(3, high=4))
    before = mesh_state(obj)
    assert run(selected_only=True) == {"CANCELLED"}
    assert last.message.endswith("or clear Selected Only")
    assert mesh_state(obj) == before


@pytest.mark.parametrize("seams", [[], upright(5, low=3, high=4), pairs(ring(0))])
def test_nothing_to_optimize(seams, last):
    """There are no seams, a single edge, or only seams along the mesh border."""
    obj = start(seams)
    before = mesh_state(obj)
    assert run() == {"CANCELLED"}
    assert last.message.startswith("Nothing to optimize")
    assert "Selected Only" not in last.message
    assert mesh_state(obj) == before


def test_a_network_that_is_already_optimal(last):
    obj = start(pairs(ring(GROOVE)))
    before = mesh_state(obj)
    assert run() == {"FINISHED"}  # finished, so that the redo panel can change the settings
    assert last.message == (
        "No better position was found for the seams: already the best nearby: raise Width or Reach to look farther"
    )
    assert mesh_state(obj) == before


def test_a_low_sharpest_turn_is_named_if_nothing_better_is_found(last):
    start(pairs(ring(GROOVE)))
    run(max_turn=1.0)
    assert "Sharpest Turn is below its default: raise it" in last.message


def test_an_empty_mesh():
    obj = mesh_object("Empty", [])
    edit(obj)
    assert run() == {"CANCELLED"}


def test_all_objects_in_edit_mode(last):
    first, second = grooved_cylinder("First"), grooved_cylinder("Second")
    edit(first, second)
    for obj in (first, second):
        mark_edges(obj, pairs(START), "seam")
    assert run() == {"FINISHED"}
    assert marked_edges(first, "seam") == marked_edges(second, "seam") == edge_set(ring(GROOVE))
    assert last.message.startswith("2 of 2 seams moved")


def test_hidden_geometry_is_untouched():
    obj = start(upright(8) + pairs(START))
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        if all(vertex.index // SEGMENTS <= 5 for vertex in face.verts):
            face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    hidden = {i for i, state in enumerate(mesh_state(obj)["edges"]) if state[3]}
    before = mesh_state(obj)
    assert run() == {"FINISHED"}
    after = mesh_state(obj)
    assert after != before
    assert [after["edges"][i] for i in hidden] == [before["edges"][i] for i in hidden]
    assert after["faces"] == before["faces"]
    assert islands(obj) == 2


def test_only_seams_change():
    obj = grooved_cylinder()
    obj.data.uv_layers.new(name="UVMap")
    group = obj.vertex_groups.new(name="Group")
    group.add(ring(4), 0.5, "ADD")
    edit(obj)
    mark_edges(obj, pairs(START) + upright(0), "seam")
    mark_edges(obj, pairs(ring(2)), "sharp")
    select(obj, upright(7, high=3))
    before = mesh_state(obj)
    run()
    after = mesh_state(obj)
    assert after["edges"] != before["edges"]
    assert [edge[:4] + edge[5:] for edge in after["edges"]] == [edge[:4] + edge[5:] for edge in before["edges"]]
    assert [after[name] for name in ("vertices", "faces", "layers")] == [
        before[name] for name in ("vertices", "faces", "layers")
    ]


@pytest.mark.parametrize("live", [False, True])
def test_live_unwrap_uses_the_moved_seams(live):
    obj = grooved_cylinder()
    obj.data.uv_layers.new(name="UVMap")
    bpy.context.scene.tool_settings.use_edge_path_live_unwrap = live
    edit(obj)
    mark_edges(obj, pairs(START) + upright(0), "seam")
    uv = ("corner", "uv", "UVMap")
    before = mesh_state(obj)["layers"][uv]
    run()
    assert (mesh_state(obj)["layers"][uv] != before) == live


def test_undo_and_redo():
    start(pairs(START) + upright(4))
    bpy.ops.ed.undo_push(message="prepared")
    before = mesh_state(bpy.data.objects["Cylinder"])
    assert bpy.ops.mesh.optimize_seams("EXEC_DEFAULT", True) == {"FINISHED"}
    after = mesh_state(bpy.data.objects["Cylinder"])
    assert after != before
    bpy.ops.ed.undo()
    assert mesh_state(bpy.data.objects["Cylinder"]) == before
    bpy.ops.ed.redo()
    assert mesh_state(bpy.data.objects["Cylinder"]) == after


def test_object_mode_is_refused():
    grooved_cylinder()
    with pytest.raises(RuntimeError, match="Edit Mode"):
        run()


def test_the_library_missing(monkeypatch):
    obj = start(pairs(START))
    before = mesh_state(obj)
    monkeypatch.setattr(native, "VERSION", "0.0.1")
    with pytest.raises(RuntimeError, match="restart Blender"):
        run()
    assert mesh_state(obj) == before


# ---- scripts


def seam_set(mesh):
    return {frozenset(edge.vertices) for edge in mesh.edges if edge.use_seam}


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_api(mode):
    obj = start(pairs(START))
    bpy.ops.object.mode_set(mode=mode)
    (result,) = api.optimize_seams(obj)
    assert result.status == "improved"
    assert edge_set(result.vertices.tolist()) == edge_set(ring(GROOVE))
    synchronize(obj)
    assert seam_set(obj.data) == edge_set(START)
    api.optimize_seams(obj, apply=True)
    synchronize(obj)
    assert seam_set(obj.data) == edge_set(ring(GROOVE))


def test_api_on_another_object_of_a_mesh_in_edit_mode():
    """The arrays are those after the edit, of the active shape key."""
    obj = grooved_cylinder(depth=0)
    instance = bpy.data.objects.new("Instance", obj.data)
    bpy.context.scene.collection.objects.link(instance)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Groove")
    for vertex, point in zip(grooved_cylinder("Shape").data.vertices, key.data):
        point.co = vertex.co
    obj.active_shape_key_index = 1
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bmesh.ops.delete(bm, geom=bm.verts[: 2 * SEGMENTS], context="VERTS")
    bmesh.update_edit_mesh(obj.data)
    mark_edges(obj, pairs(rough_loop(GROOVE - 5)), "seam")
    (result,) = api.optimize_seams(instance, apply=True)
    assert result.status == "improved"
    assert marked_edges(obj, "seam") == edge_set(ring(GROOVE - 2))


@pytest.mark.parametrize("name", sorted(parameters.SETTINGS.keys() - parameters.NETWORK))
def test_networks_do_not_take_the_setting_ends(name):
    obj = start(pairs(START))
    with pytest.raises(TypeError, match=name):
        run(**{name: parameters.SETTINGS[name]["default"]})
    with pytest.raises(TypeError, match=name):
        api.optimize_seams(obj, **{name: parameters.SETTINGS[name]["default"]})


# ---- random networks


def random_seams(rng, obj):
    """Return the borders of random regions without some of their edges, and with some single edges."""
    bm = bmesh.from_edit_mesh(obj.data)
    bm.edges.ensure_lookup_table()
    centers = np.array([face.calc_center_median() for face in bm.faces])
    seeds = centers[rng.choice(len(centers), int(rng.integers(2, 8)), replace=False)]
    distances = np.linalg.norm(centers[:, None] - seeds, axis=2) * rng.uniform(1, 1.2, (len(centers), len(seeds)))
    region = np.argmin(distances, axis=1)
    keep = rng.random() < 0.5
    return [
        tuple(vertex.index for vertex in edge.verts)
        for edge in bm.edges
        if (len({region[face.index] for face in edge.link_faces}) > 1 and (keep or rng.random() < 0.97))
        or rng.random() < 0.004
    ]


def random_body(rng):
    kind = rng.integers(4)
    if kind == 0:
        obj = grooved_cylinder(depth=float(rng.uniform(0, 0.4)))
    else:
        add = [
            lambda: bpy.ops.mesh.primitive_torus_add(major_segments=28, minor_segments=12),
            lambda: bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4),
            lambda: bpy.ops.mesh.primitive_grid_add(x_subdivisions=16, y_subdivisions=20),
        ][kind - 1]
        add()
        obj = bpy.context.object
    for vertex, shift in zip(obj.data.vertices, rng.normal(0, 0.02, (len(obj.data.vertices), 3))):
        vertex.co = [c + s for c, s in zip(vertex.co, shift)]
    return obj


def hide_some(rng, obj):
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        if rng.random() < 0.02:
            face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)


@pytest.mark.parametrize("seed", range(30))
def test_the_number_of_islands_is_preserved(seed):
    rng = np.random.default_rng(seed)
    obj = random_body(rng)
    edit(obj)
    if seed % 4 == 3:
        hide_some(rng, obj)
    mark_edges(obj, random_seams(rng, obj), "seam")
    if seed % 2:
        shown = {frozenset(state[:2]) for state in mesh_state(obj)["edges"] if not state[3]}
        select(obj, [pair for pair in sorted(map(sorted, marked_edges(obj, "seam") & shown)) if rng.random() < 0.9])
    before, count = mesh_state(obj), islands(obj)
    ran = run(width=int(rng.integers(1, 6)), min_salience=0.0, selected_only=bool(seed % 2))
    after = mesh_state(obj)
    assert (after["edges"] != before["edges"]) == (ran == {"FINISHED"})
    assert islands(obj) == count
    assert [state[-3:] for state in after["faces"]] == [state[-3:] for state in before["faces"]]
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not obj.data.validate(verbose=True)
