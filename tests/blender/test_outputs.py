# SPDX-License-Identifier: GPL-3.0-or-later
"""The outputs of mesh.optimize_contour: open chains, cuts, rips and separate parts, in every select mode."""

import bmesh
import bpy
import numpy as np
import pytest
from contour_shapes import edges_by_ends
from made_meshes import (
    GROOVE,
    GROOVE_EDGES,
    OUTPUTS,
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
    run,
    select,
    select_faces_below,
    torus,
    torus_ring,
)
from minimum_ratio_contours.core import edge_paths

REFINED = {"refinement": 2, "min_salience": 0.0}


def tilted_cylinder(name="Cylinder"):
    """Make a cylinder whose groove does not follow the rings, so that the best contour runs across faces."""
    obj = grooved_cylinder(name, depth=0)
    for vertex in obj.data.vertices:
        height = vertex.co.z - 0.2 * GROOVE - 0.45 * vertex.co.x
        factor = 1 - 0.3 * np.exp(-((height / 0.25) ** 2))
        vertex.co.x *= factor
        vertex.co.y *= factor
    return obj


def start(make=grooved_cylinder, mode="EDGE", loop=START):
    obj = make()
    edit(obj, mode=mode)
    select(obj, pairs(loop))
    return obj


def bm_of(obj):
    return bmesh.from_edit_mesh(obj.data)


def components(bm):
    """Return the number of connected pieces."""
    left, count = set(bm.faces), 0
    while left:
        count += 1
        pending = [left.pop()]
        while pending:
            for edge in pending.pop().edges:
                neighbors = [face for face in edge.link_faces if face in left]
                left.difference_update(neighbors)
                pending += neighbors
    return count


def is_sound(obj):
    bm = bm_of(obj)
    bm.normal_update()
    assert max(edges_by_ends(bm).values()) == 1
    assert min(face.calc_area() for face in bm.faces) > 1e-9
    obj.update_from_editmode()
    return not obj.data.copy().validate(verbose=True)


# ---- refined contours


@pytest.mark.parametrize("output", OUTPUTS[:4])
def test_a_refined_contour_is_cut_into_the_faces(output):
    obj = start(tilted_cylinder)
    faces = len(bm_of(obj).faces)
    assert run(output=output, **REFINED) == {"FINISHED"}
    assert len(bm_of(obj).faces) > faces
    assert is_sound(obj)
    selected = marked_edges(obj, "select")
    loops = edge_paths.sort_edges([sorted(edge) for edge in selected])
    assert (len(loops.loops), loops.chains, loops.branching) == (1, [], [])
    assert marked_edges(obj, "seam") == (selected if output == "SEAM" else set())
    assert marked_edges(obj, "sharp") == (selected if output == "SHARP" else set())


@pytest.mark.parametrize("output", OUTPUTS[:4])
def test_a_regular_contour_cuts_nothing(output):
    obj = start(tilted_cylinder)
    before = mesh_state(obj)
    run(output=output)
    after = mesh_state(obj)
    for kind, fields in (("vertices", 1), ("edges", 2), ("faces", 4)):
        assert [row[:fields] for row in after[kind]] == [row[:fields] for row in before[kind]]


@pytest.mark.parametrize("flag", ["seam", "sharp"])
def test_a_cut_seam_moves_and_is_not_doubled(flag):
    obj = start(tilted_cylinder)
    mark_edges(obj, pairs(START), flag)
    run(output=flag.upper(), **REFINED)
    assert marked_edges(obj, flag) == marked_edges(obj, "select")


def length_of(obj, flag):
    bm = bm_of(obj)
    bm.verts.ensure_lookup_table()
    return sum((bm.verts[a].co - bm.verts[b].co).length for a, b in map(sorted, marked_edges(obj, flag)))


@pytest.mark.parametrize("flag", ["seam", "sharp"])
def test_a_kept_seam_stays_whole_where_the_new_one_crosses_it(flag):
    obj = start(tilted_cylinder)
    mark_edges(obj, pairs(START), flag)
    before = length_of(obj, flag)
    run(output=flag.upper(), keep_old=True, **REFINED)
    old_edges = marked_edges(obj, flag) - marked_edges(obj, "select")
    assert old_edges
    assert marked_edges(obj, flag) > marked_edges(obj, "select")
    # Edges of both contours count once.
    assert before - 1e-5 <= length_of(obj, flag) <= before + length_of(obj, "select") + 1e-5


def test_merging_moves_the_points_of_a_cut_onto_vertices():
    """With two points per edge, each is within 0.35 of an end, so that all cuts are diagonals of faces."""
    obj = start(tilted_cylinder)
    vertices, faces = len(bm_of(obj).verts), len(bm_of(obj).faces)
    run(output="CUT", merge=0.35, **REFINED)
    assert len(bm_of(obj).verts) == vertices
    assert len(bm_of(obj).faces) > faces
    assert is_sound(obj)


# ---- open chains


def half_way(row):
    """Return a chain halfway around the cylinder."""
    return rough_loop(row)[: SEGMENTS // 2 + 2]


@pytest.mark.parametrize("output", OUTPUTS[:5])
def test_an_open_chain_keeps_its_first_and_last_edge(output, last):
    chain = half_way(GROOVE - 1)
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(chain, closed=False))
    assert run(output=output, anchor=0.0, length_bias=0.0) == {"FINISHED"}
    assert [numbers.status for numbers in last.contours] == ["improved"]
    if output != "RIP":
        selected = marked_edges(obj, "select")
        given = [frozenset(pair) for pair in pairs(chain, closed=False)]
        assert {given[0], given[-1]} <= selected
        assert selected != set(given)
        assert marked_edges(obj, "seam") == (selected if output == "SEAM" else set())


def test_loops_and_chains_together(last):
    obj = start()
    chain = pairs(ring(4)[:9], closed=False)
    select(obj, chain)
    assert run(output="SEAM") == {"FINISHED"}
    assert len(last.contours) == 2
    assert marked_edges(obj, "seam") == GROOVE_EDGES | {frozenset(pair) for pair in chain}


VALLEY, BESIDE = 5, 8


def upright(column):
    return [row * SEGMENTS + column for row in range(RINGS)]


def cylinder_with_a_valley():
    """Make a cylinder with a straight valley from border to border."""
    obj = grooved_cylinder(depth=0)
    for vertex in obj.data.vertices:
        factor = 1 - 0.25 * np.exp(-(((vertex.index % SEGMENTS - VALLEY) / 1.5) ** 2))
        vertex.co.x *= factor
        vertex.co.y *= factor
    return obj


@pytest.mark.parametrize(("ends", "held"), [("EDGES", 2), ("VERTICES", 1), ("BORDER", 0), ("AUTO", 0)])
def test_the_setting_ends_says_what_is_held(ends, held):
    obj = cylinder_with_a_valley()
    edit(obj)
    select(obj, pairs(upright(BESIDE), closed=False))
    run(ends=ends, anchor=0.0, length_bias=0.0, min_salience=0.0, reach=0.0)
    path = marked_edges(obj, "select")
    vertices = {vertex for edge in path for vertex in edge}
    assert vertices & set(upright(VALLEY))
    first = upright(BESIDE)[:held]
    assert vertices >= set(first)
    if ends in ("BORDER", "AUTO"):
        assert path == {frozenset(pair) for pair in pairs(upright(VALLEY), closed=False)}
    if ends == "EDGES":
        assert frozenset(first) in path


# ---- rip and separate


@pytest.mark.parametrize("settings", [{}, REFINED])
@pytest.mark.parametrize("fill", [False, True])
def test_rip_opens_the_mesh(settings, fill):
    obj = start(tilted_cylinder)
    assert run(output="RIP", fill_holes=fill, **settings) == {"FINISHED"}
    bm = bm_of(obj)
    assert components(bm) == 2
    assert is_sound(obj)
    rims = [edge for edge in bm.edges if edge.select]
    assert {len(edge.link_faces) for edge in rims} == ({2} if fill else {1})
    assert len({frozenset(vertex.index for vertex in edge.verts) for edge in rims}) == len(rims)
    assert sum(edge.is_boundary for edge in bm.edges) == 2 * SEGMENTS + (0 if fill else len(rims))


def test_faces_that_fill_a_hole_are_visible_even_next_to_hidden_ones():
    obj = start()
    bm = bm_of(obj)
    hidden = [face for face in bm.faces if min(vertex.index // SEGMENTS for vertex in face.verts) >= GROOVE]
    for face in hidden:
        face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    assert run(output="RIP", fill_holes=True) == {"FINISHED"}
    caps = [face for face in bm_of(obj).faces if len(face.verts) > 4]
    assert [face.hide for face in caps] == [False, False]
    assert sum(face.hide for face in bm_of(obj).faces) == len(hidden)


def test_faces_that_fill_a_hole_look_outward():
    obj = start(tilted_cylinder)
    run(output="RIP", fill_holes=True)
    bm = bm_of(obj)
    bm.normal_update()
    caps = [face for face in bm.faces if len(face.verts) > 4]
    assert len(caps) == 2
    for cap in caps:
        for edge in cap.edges:
            assert len({loop.vert for loop in edge.link_loops}) == 2  # neighbors run along it in opposite directions


@pytest.mark.parametrize("settings", [{}, REFINED])
@pytest.mark.parametrize("fill", [False, True])
def test_separate_makes_an_object_of_the_smaller_part(settings, fill):
    obj = start(tilted_cylinder, loop=rough_loop(GROOVE + 1))
    before = set(bpy.data.objects)
    assert run(output="SEPARATE", fill_holes=fill, **settings) == {"FINISHED"}
    (new,) = set(bpy.data.objects) - before
    assert is_sound(obj)
    assert not new.data.validate(verbose=True)
    assert components(bm_of(obj)) == 1
    heights = [vertex.co.z for vertex in new.data.vertices]
    assert max(heights) == pytest.approx(0.2 * (RINGS - 1))
    assert min(heights) > 0.2 * (GROOVE - 5)
    assert len(new.data.polygons) < len(bm_of(obj).faces)
    assert all(edge.is_boundary != fill for edge in bm_of(obj).edges if edge.select)
    assert any(edge.select for edge in bm_of(obj).edges)


def test_each_part_becomes_a_separate_object():
    """The largest part stays in the object."""
    obj = grooved_cylinder(grooves=(5, 15))
    edit(obj)
    select(obj, pairs(rough_loop(4)) + pairs(rough_loop(13)))
    run(output="SEPARATE")
    sizes = sorted(len(other.data.polygons) for other in bpy.data.objects if other is not obj)
    assert sizes == [5 * SEGMENTS, 5 * SEGMENTS]
    assert len(bm_of(obj).faces) == 10 * SEGMENTS


@pytest.mark.parametrize("rows", [(4, 13), (3, 6), (12, 16), (2, 10)])
def test_the_largest_part_stays(rows):
    obj = grooved_cylinder(depth=0)
    edit(obj)
    select(obj, [pair for row in rows for pair in pairs(ring(row))])
    run(output="SEPARATE")
    bounds = [0, *rows, RINGS - 1]
    expected = sorted((upper - lower) * SEGMENTS for lower, upper in zip(bounds, bounds[1:]))
    assert len(bm_of(obj).faces) == expected[-1]
    assert sorted(len(other.data.polygons) for other in bpy.data.objects if other is not obj) == expected[:-1]


@pytest.mark.parametrize("normals", [False, True])
@pytest.mark.parametrize("rows", [(12,), (4, 13), (2, 5, 8, 17)])
def test_parts_keep_all_that_their_mesh_has(rows, normals):
    """However many leave it at once. Blender 4.5 loses shape keys where there are custom normals, too."""
    obj = with_custom_normals(lambda: grooved_cylinder(depth=0)) if normals else grooved_cylinder(depth=0)
    other = grooved_cylinder("Other")
    obj.vertex_groups.new(name="Unused")
    group, mesh = obj.vertex_groups.new(name="Height"), obj.data
    for vertex in mesh.vertices:
        group.add([vertex.index], vertex.co.z / 8, "REPLACE")
    if not normals:
        obj.shape_key_add(name="Basis")
        for point in obj.shape_key_add(name="Moved").data:
            point.co.x += point.co.z
    for name in ("First", "Second"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons.foreach_set("material_index", np.arange(len(mesh.polygons)) % 2)
    mesh.uv_layers.new(name="Map").data.foreach_set(
        "uv", np.ravel([mesh.vertices[loop.vertex_index].co.yz for loop in mesh.loops])
    )
    obj.modifiers.new("Bevel", "BEVEL").width = 0.25
    obj["note"] = 7
    obj.location = 1, 2, 3
    edit(obj, other)
    select(obj, [pair for row in rows for pair in pairs(ring(row))])
    known = set(bpy.data.objects)
    assert run(output="SEPARATE", min_salience=9.0) == {"FINISHED"}  # the loops stay where they are
    made = set(bpy.data.objects) - known
    assert len({part.select_get() for part in made}) == 1
    assert set(bpy.context.objects_in_mode) == {obj, other}
    assert bpy.context.view_layer.objects.active == obj
    assert {part.name for part in made} == {f"Cylinder.{number:03}" for number in range(1, len(rows) + 1)}
    assert sum(len(part.data.polygons) for part in made) + len(bm_of(obj).faces) == (RINGS - 1) * SEGMENTS
    bpy.ops.object.mode_set(mode="OBJECT")
    for part in {obj, *made}:
        mesh = part.data
        assert not mesh.validate(verbose=True)
        assert [group.name for group in part.vertex_groups] == ["Unused", "Height"]
        assert [slot.material.name[:5] for slot in part.material_slots] == ["First", "Secon"]
        assert {face.material_index for face in mesh.polygons} == {0, 1}
        assert [(modifier.name, modifier.width) for modifier in part.modifiers] == [("Bevel", 0.25)]
        assert (part["note"], part.location[:]) == (7, (1, 2, 3))
        for vertex in mesh.vertices:
            assert [member.weight for member in vertex.groups] == [pytest.approx(vertex.co.z / 8, abs=1e-6)]
        for loop, corner in zip(mesh.loops, mesh.uv_layers["Map"].data):
            assert corner.uv == mesh.vertices[loop.vertex_index].co.yz
        if normals:
            expected = [custom_normal(mesh.vertices[loop.vertex_index].co) for loop in mesh.loops]
            assert np.degrees(np.arccos(np.clip((normals_of(mesh) * expected).sum(1), -1, 1))).max() < 1.0
            continue
        moved = mesh.shape_keys.key_blocks["Moved"].data
        assert len(moved) == len(mesh.vertices)
        for vertex, point in zip(mesh.vertices, moved):
            assert point.co.x == pytest.approx(vertex.co.x + vertex.co.z, abs=1e-6)


@pytest.mark.parametrize("other", [3, 8, 12, 15, 21])
def test_of_the_parts_of_a_torus_the_largest_stays(other):
    obj = torus()
    edit(obj)
    select(obj, pairs(torus_ring(0)) + pairs(torus_ring(other)))
    run(output="SEPARATE", min_salience=5.0)  # the loops stay where they are
    assert len(bm_of(obj).faces) == 12 * max(other, 24 - other)
    assert len(bpy.data.objects) == 2


def test_the_selected_faces_are_the_part_that_is_separated():
    obj = grooved_cylinder()
    edit(obj, mode="FACE")
    select_faces_below(obj, START)
    bm = bm_of(obj)
    bm.faces.ensure_lookup_table()
    for face in bm.faces[: 2 * SEGMENTS]:
        face.select_set(True)
    run(output="SEPARATE")
    (new,) = [other for other in bpy.data.objects if other is not obj]
    assert len(new.data.polygons) == GROOVE * SEGMENTS
    assert len(bm_of(obj).faces) == (RINGS - 1 - GROOVE) * SEGMENTS


@pytest.mark.parametrize("settings", [{}, REFINED])
def test_one_loop_around_a_torus_separates_nothing(settings, last):
    obj = torus()
    edit(obj)
    select(obj, pairs(torus_ring(0)))
    before = mesh_state(obj)
    assert run(output="SEPARATE", **settings) == {"CANCELLED"}
    assert mesh_state(obj) == before
    assert "does not separate the mesh" in last.message
    assert len(bpy.data.objects) == 1


@pytest.mark.parametrize("settings", [{}, REFINED])
@pytest.mark.parametrize("fill", [False, True])
@pytest.mark.parametrize("mode", ["VERTEX", "EDGE"])
def test_rip_opens_a_torus_to_a_tube(mode, fill, settings):
    obj = torus()
    edit(obj, mode=mode)
    select(obj, pairs(torus_ring(0)))
    bm = bm_of(obj)
    euler = len(bm.verts) - len(bm.edges) + len(bm.faces)
    assert run(output="RIP", fill_holes=fill, **settings) == {"FINISHED"}
    bm = bm_of(obj)
    assert is_sound(obj)
    assert components(bm) == 1
    assert sum(edge.is_boundary for edge in bm.edges) == (0 if fill else len(marked_edges(obj, "select")))
    assert len(bm.verts) - len(bm.edges) + len(bm.faces) == euler + 2 * fill
    if not settings:
        assert len(bm.verts) == 24 * 12 + 12


def plate():
    obj = mesh_object("Plate", [])
    bm = bmesh.new()
    bmesh.ops.create_grid(bm, x_segments=8, y_segments=8, size=1)
    bm.to_mesh(obj.data)
    bm.free()
    return obj


ACROSS = list(range(4, 81, 9))  # from border to border of the plate


@pytest.mark.parametrize(("first", "last"), [(0, 9), (0, 5), (2, 9), (2, 7), (3, 6)])
@pytest.mark.parametrize("output", ["RIP", "EDGE_SPLIT"])
def test_rip_opens_a_chain_as_edge_split_does(output, first, last):
    """At each of its vertices but ends inside the mesh."""
    obj = plate()
    edit(obj)
    chain = ACROSS[first:last]
    select(obj, pairs(chain, closed=False))
    if output == "RIP":
        assert run(output="RIP", ends="VERTICES") == {"FINISHED"}
    else:
        bpy.ops.mesh.edge_split()
    bm = bm_of(obj)
    ends = (first > 0) + (last < 9)
    assert len(bm.verts) == 81 + len(chain) - ends
    assert components(bm) == (1 if ends else 2)
    assert sum(edge.is_boundary for edge in bm.edges) == 32 + 2 * (len(chain) - 1)
    assert is_sound(obj)


@pytest.mark.parametrize("output", ["RIP", "SEPARATE"])
def test_two_loops_around_a_torus_separate_it(output):
    obj = torus()
    edit(obj)
    select(obj, pairs(torus_ring(0)) + pairs(torus_ring(8)))
    assert run(output=output) == {"FINISHED"}
    assert components(bm_of(obj)) == (2 if output == "RIP" else 1)
    assert len(bpy.data.objects) == (1 if output == "RIP" else 2)


def test_a_chain_across_the_border_separates_and_one_inside_does_not(last):
    obj = plate()
    edit(obj)
    select(obj, pairs(ACROSS, closed=False))
    assert run(output="SEPARATE", ends="VERTICES") == {"FINISHED"}
    assert len(bm_of(obj).faces) == 32
    bpy.ops.object.mode_set(mode="OBJECT")
    obj = plate()
    edit(obj)
    select(obj, pairs(ACROSS[1:-1], closed=False))
    before = mesh_state(obj)
    assert run(output="SEPARATE") == {"CANCELLED"}
    assert mesh_state(obj) == before
    assert "the open chain" in last.message
    assert "does not separate" in last.message


def test_a_part_that_is_partly_hidden_stays(last):
    obj = start(loop=rough_loop(GROOVE + 1))
    bm = bm_of(obj)
    bm.faces.ensure_lookup_table()
    bm.faces[-1].hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    before = mesh_state(obj)
    assert run(output="SEPARATE") == {"CANCELLED"}
    assert mesh_state(obj) == before
    assert "reveal it first (Alt H)" in last.message


def test_separating_in_several_objects_keeps_other_selections():
    first, second = grooved_cylinder("First"), grooved_cylinder("Second")
    edit(first, second)
    single = pairs(ring(3)[:2], closed=False)
    for obj in (first, second):
        select(obj, pairs(rough_loop(GROOVE + 1)))
    select(second, single)
    run(output="SEPARATE")
    assert len(bpy.data.objects) == 4
    for obj in (first, second):
        assert len(bm_of(obj).faces) == GROOVE * SEGMENTS
    assert {frozenset(pair) for pair in single} < marked_edges(second, "select")


# ---- face mode


@pytest.mark.parametrize("output", ["SELECT", "SEAM", "SHARP", "CUT", "RIP"])
def test_face_mode_selects_the_faces_of_the_improved_part(output):
    obj = tilted_cylinder()
    edit(obj, mode="FACE")
    select_faces_below(obj, START)
    run(output=output, **REFINED)
    bm = bm_of(obj)
    assert is_sound(obj)
    selected = {face for face in bm.faces if face.select}
    assert selected
    assert {edge for edge in bm.edges if edge.select} == {edge for face in selected for edge in face.edges}
    inside = [face for face in selected if face.calc_center_median().z > 0.2 * GROOVE + 1.2]
    assert not inside
    border = [edge for edge in bm.edges if len({face.select for face in edge.link_faces}) == 2]
    pieces = edge_paths.sort_edges([sorted(vertex.index for vertex in edge.verts) for edge in border])
    assert not pieces.chains
    assert not pieces.branching
    assert len(pieces.loops) == (0 if output == "RIP" else 2)


def test_an_unselected_hole_in_selected_faces_stays_a_hole():
    """If all faces but a part are selected, the border of the part moves and the rest stays selected."""
    obj = grooved_cylinder()
    edit(obj, mode="FACE")
    select_faces_below(obj, START)
    bpy.ops.mesh.select_all(action="INVERT")
    run(output="SELECT")
    unselected = {face.index for face in bm_of(obj).faces if not face.select}
    assert unselected == set(range(2 * SEGMENTS, GROOVE * SEGMENTS))


# ---- what the mesh carries


def normals_of(mesh):
    values = np.empty(3 * len(mesh.loops), dtype=np.float32)
    if hasattr(mesh, "corner_normals"):
        mesh.corner_normals.foreach_get("vector", values)
    else:
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", values)
    return values.reshape(-1, 3)


def with_custom_normals(make):
    """Set normals that vary smoothly with the height and differ from those of the faces."""
    obj = make()
    mesh = obj.data
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.normals_split_custom_set([custom_normal(mesh.vertices[loop.vertex_index].co) for loop in mesh.loops])
    return obj


def custom_normal(position):
    normal = np.array([np.sin(position[2]), np.cos(position[2]), 0.4 + 0.1 * position[0]])
    return (normal / np.linalg.norm(normal)).tolist()


def test_unselectable_objects_stay_in_edit_mode():
    obj, other = with_custom_normals(tilted_cylinder), grooved_cylinder("Other")
    edit(obj, other)
    other.hide_select = True
    was_selected = other.select_get()
    select(obj, pairs(START))
    assert run(output="CUT", **REFINED) == {"FINISHED"}
    assert set(bpy.context.objects_in_mode) == {obj, other}
    assert other.hide_select
    assert other.select_get() == was_selected


@pytest.mark.parametrize("output", ["CUT", "SEAM", "RIP", "SEPARATE"])
@pytest.mark.parametrize("settings", [{}, REFINED])
def test_custom_normals_are_preserved(output, settings):
    obj = with_custom_normals(tilted_cylinder)
    other = grooved_cylinder("Other")
    edit(obj, other)
    select(obj, pairs(START))
    assert run(output=output, **settings) == {"FINISHED"}
    assert set(bpy.context.objects_in_mode) == {obj, other}
    names = [made.name for made in bpy.data.objects]
    bpy.ops.object.mode_set(mode="OBJECT")
    for made in map(bpy.data.objects.get, names):
        if made is other:
            continue
        mesh = made.data
        assert mesh.has_custom_normals
        expected = [custom_normal(mesh.vertices[loop.vertex_index].co) for loop in mesh.loops]
        worst = np.degrees(np.arccos(np.clip((normals_of(mesh) * expected).sum(1), -1, 1))).max()
        assert worst < 1.0
        assert not [attribute.name for attribute in mesh.attributes if "contours" in attribute.name]


@pytest.mark.parametrize("output", ["CUT", "SHARP"])
def test_restoring_custom_normals_marks_no_edges_as_sharp(output):
    """Setting custom normals can mark edges as sharp; here only along the contour."""
    obj = with_custom_normals(tilted_cylinder)
    edit(obj)
    mark_edges(obj, pairs(ring(2)), "sharp")
    select(obj, pairs(START))
    run(output=output, **REFINED)
    contour = marked_edges(obj, "select") if output == "SHARP" else set()
    assert marked_edges(obj, "sharp") == edge_set(ring(2)) | contour


def test_custom_normals_stored_as_vectors_are_preserved():
    if bpy.app.version < (4, 5, 0):
        pytest.skip("there are none before Blender 4.5")
    obj = tilted_cylinder()
    mesh = obj.data
    vectors = mesh.attributes.new("custom_normal", "FLOAT_VECTOR", "CORNER")
    vectors.data.foreach_set(
        "vector", np.ravel([custom_normal(mesh.vertices[loop.vertex_index].co) for loop in mesh.loops])
    )
    edit(obj)
    select(obj, pairs(START))
    run(output="CUT", **REFINED)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert mesh.attributes["custom_normal"].data_type == "FLOAT_VECTOR"
    expected = [custom_normal(mesh.vertices[loop.vertex_index].co) for loop in mesh.loops]
    found = normals_of(mesh)
    found /= np.linalg.norm(found, axis=1)[:, None]  # Blender interpolates them as vectors, a little shorter
    assert np.degrees(np.arccos(np.clip((found * expected).sum(1), -1, 1))).max() < 1.0


def test_an_active_shape_key_is_cut_where_it_is_visible():
    obj = grooved_cylinder(depth=0)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Groove")
    for vertex, point in zip(tilted_cylinder("Shape").data.vertices, key.data):
        point.co = vertex.co
    obj.active_shape_key_index = 1
    edit(obj)
    select(obj, pairs(START))
    run(output="CUT", **REFINED)
    bpy.ops.object.mode_set(mode="OBJECT")
    blocks = obj.data.shape_keys.key_blocks
    new = range(RINGS * SEGMENTS, len(obj.data.vertices))
    assert len(new) > SEGMENTS // 4
    basis = np.array([blocks["Basis"].data[vertex].co[:] for vertex in new])
    shown = np.array([blocks["Groove"].data[vertex].co[:] for vertex in new])
    # The basis is a prism on SEGMENTS sides; what was interpolated lies on it, within the depth of a side's chord.
    assert np.linalg.norm(basis[:, :2], axis=1).min() > np.cos(np.pi / SEGMENTS) - 1e-5
    assert np.linalg.norm(shown[:, :2], axis=1).mean() < 0.8
    np.testing.assert_allclose(basis[:, 2], shown[:, 2], atol=1e-5)


@pytest.mark.parametrize("scale", [(1, 1, 2), (-1, 1, 1), (-1, -1, -1)])
def test_an_uneven_or_negative_scale_causes_a_warning(scale, last, capfd):
    obj = start()
    obj.scale = scale
    bpy.context.view_layer.update()
    run()
    assert "apply it (Ctrl A > Scale)" in last.message
    assert f"Warning: {last.message}" in capfd.readouterr().out


def test_an_even_scale_causes_no_warning(last):
    obj = start()
    obj.scale = (3, 3, 3)
    bpy.context.view_layer.update()
    run()
    assert "Scale" not in last.message


@pytest.mark.parametrize("settings", [{}, REFINED])
@pytest.mark.parametrize("mode", ["EDGE", "FACE"])
def test_x_mirror_also_moves_the_other_side(mode, settings, last):
    obj = dumbbell()
    obj.data.use_mirror_x = True
    edit(obj, mode=mode)
    if mode == "EDGE":
        select(obj, pairs(rough_loop(4)))
    else:
        bm = bm_of(obj)
        bm.faces.ensure_lookup_table()
        for face in bm.faces[: 4 * SEGMENTS]:
            face.select_set(True)
    run(output="SEAM", **settings)
    assert len(last.contours) == 2
    bm = bm_of(obj)
    seams = [edge for edge in bm.edges if edge.seam]
    if not settings:
        assert marked_edges(obj, "seam") == edge_set(ring(5)) | edge_set(ring(15))
    assert sum(edge.verts[0].co.x > 0 for edge in seams) == sum(edge.verts[0].co.x < 0 for edge in seams)
    if mode == "FACE":
        heights = [face.calc_center_median().x for face in bm.faces if face.select]
        assert sum(height > 0 for height in heights) == sum(height < 0 for height in heights) > 0
        assert min(map(abs, heights)) > 0.7


def tilted_arms(segments=24, rings=81):
    """A tube along x with a tilted groove round each half; its quads wind the same way everywhere."""
    x, angle = np.meshgrid(np.linspace(-3, 3, rings), 2 * np.pi * np.arange(segments) / segments, indexing="ij")
    radius = 1 - 0.3 * np.exp(-8 * (abs(x) - 1.2 - 0.2 * np.cos(angle)) ** 2)
    points = np.stack([x, radius * np.cos(angle), radius * np.sin(angle)], axis=-1).reshape(-1, 3)
    ring_pairs = [pairs([r * segments + i for i in range(segments)]) for r in range(rings)]
    faces = [(a, b, b + segments, a + segments) for ring_of_pairs in ring_pairs[:-1] for a, b in ring_of_pairs]
    return mesh_object("Arms", points.tolist(), faces=faces), ring_pairs[int(np.argmin(abs(x[:, 0] - 0.9)))]


@pytest.mark.parametrize("refinement", [0, 1, 2])
def test_x_mirror_cuts_mirror_images(refinement, last):
    obj, loop = tilted_arms()
    obj.data.use_mirror_x = True
    edit(obj)
    select(obj, loop)
    run(output="CUT", refinement=refinement)
    assert len(last.contours) == 2
    points = np.array([vertex.co for vertex in bm_of(obj).verts])
    apart = np.abs(points[:, None] * (-1, 1, 1) - points[None]).max(axis=2)
    assert apart.min(axis=1).max() < 2e-5


def test_x_mirror_on_an_asymmetric_mesh(last):
    obj = start()
    obj.data.use_mirror_x = True
    bm = bm_of(obj)
    for vertex in bm.verts:
        vertex.co.x += 0.1
    bmesh.update_edit_mesh(obj.data)
    run(output="SEAM")
    assert marked_edges(obj, "seam") == GROOVE_EDGES
    assert "X Mirror is on" in last.message


@pytest.mark.parametrize("inward", [False, True])
def test_inverted_normals_of_a_closed_mesh_cause_a_warning(inward, last):
    obj = torus()
    edit(obj)
    if inward:
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.flip_normals()
        bpy.ops.mesh.select_all(action="DESELECT")
    select(obj, pairs(torus_ring(0)))
    run(output="SEAM")
    assert ("Recalculate Outside (Shift N)" in last.message) == inward


def test_an_open_mesh_causes_no_warning_about_normals(last):
    obj = start()
    bm = bm_of(obj)
    bmesh.ops.reverse_faces(bm, faces=bm.faces)
    bmesh.update_edit_mesh(obj.data)
    run(output="SEAM")
    assert "Shift N" not in last.message


# ---- undo


def cylinder():
    return bpy.data.objects["Cylinder"]


@pytest.mark.parametrize("mode", ["EDGE", "FACE"])
@pytest.mark.parametrize("normals", [False, True])
@pytest.mark.parametrize("output", OUTPUTS[2:])
def test_undo_and_redo_of_cuts(output, normals, mode):
    obj = with_custom_normals(tilted_cylinder) if normals else tilted_cylinder()
    edit(obj, mode=mode)
    if mode == "FACE":
        select_faces_below(obj, START)
    else:
        select(obj, pairs(START))
    bpy.ops.ed.undo_push(message="prepared")
    before = mesh_state(cylinder())
    assert bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, output=output, **REFINED) == {"FINISHED"}
    after = mesh_state(cylinder())
    assert after != before
    bpy.ops.ed.undo()
    assert mesh_state(cylinder()) == before
    bpy.ops.ed.redo()
    assert mesh_state(cylinder()) == after


def test_a_second_run_gives_the_same_result():
    found = []
    for _ in range(2):
        obj = start(tilted_cylinder)
        run(output="CUT", **REFINED)
        found.append(mesh_state(obj))
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects.remove(obj)
    assert found[0] == found[1]
