# SPDX-License-Identifier: GPL-3.0-or-later
"""Constraints from a mesh's layers: vertex groups, marked edges, face attributes, colors."""

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import (
    GROOVE,
    RINGS,
    SEGMENTS,
    START,
    but_selection,
    edge_set,
    edit,
    find_edges,
    grooved_cylinder,
    mark_edges,
    marked_edges,
    mesh_state,
    pairs,
    ring,
    rough_loop,
    run,
    select,
    select_faces_below,
)
from minimum_ratio_contours import api


def start(obj, loop=START, mode="EDGE"):
    edit(obj, mode=mode)
    select(obj, pairs(loop))
    return obj


def group(obj, vertices, name="Group", weight=1.0):
    """Add vertices to a vertex group, in Object Mode."""
    found = obj.vertex_groups.get(name) or obj.vertex_groups.new(name=name)
    found.add([int(vertex) for vertex in vertices], weight, "REPLACE")


def crease(obj, edges):
    bm = bmesh.from_edit_mesh(obj.data)
    layers = bm.edges.layers
    layer = layers.crease.verify() if hasattr(layers, "crease") else layers.float.new("crease_edge")
    for edge in find_edges(bm, edges):
        edge[layer] = 1.0
    bmesh.update_edit_mesh(obj.data)


def mark(obj, edges, kind):
    if kind == "CREASE":
        crease(obj, edges)
    else:
        mark_edges(obj, edges, kind.lower())


def selected_vertices(obj):
    return {vertex.index for vertex in bmesh.from_edit_mesh(obj.data).verts if vertex.select}


def heights(obj):
    """Return the rows of the cylinder that the selected contour touches."""
    return sorted({vertex // SEGMENTS for vertex in selected_vertices(obj)})


# ---- required vertices


@pytest.mark.parametrize("mode", ["VERTEX", "EDGE"])
def test_required_vertices_are_passed(mode, last):
    obj = grooved_cylinder()
    required = [ring(GROOVE - 2)[4], ring(GROOVE + 1)[20]]
    group(obj, required, "Pins")
    group(obj, ring(0)[:3], "Pins", weight=0.0)
    start(obj, mode=mode)
    assert run(required_group="Pins") == {"FINISHED"}
    assert set(required) <= selected_vertices(obj)
    assert marked_edges(obj, "select") != edge_set(ring(GROOVE))


def test_required_vertices_outside_the_band_are_counted_and_selected(last):
    obj = grooved_cylinder()
    outside = [ring(RINGS - 2)[3], ring(RINGS - 2)[5], ring(0)[1]]
    group(obj, [*outside, ring(GROOVE - 2)[4]], "Pins")
    start(obj)
    assert run(required_group="Pins", width=3, output="SEAM") == {"FINISHED"}
    assert "3 required vertices lie outside the band that is searched: widen it" in last.message
    assert selected_vertices(obj) == set(outside)
    assert bpy.context.tool_settings.mesh_select_mode[:] == (True, False, False)
    assert not marked_edges(obj, "seam")


def test_required_vertices_outside_in_one_object_do_not_block_the_others(last):
    """Contours reported as improved are written, and the selection of the other object is its contour."""
    bad, sound = grooved_cylinder("Bad"), grooved_cylinder("Sound")
    outside = ring(0)[3]
    group(bad, [outside], "Pins")
    sound.vertex_groups.new(name="Pins")
    edit(bad, sound)
    for obj in (bad, sound):
        select(obj, pairs(START))
    assert run(required_group="Pins", width=3, output="SEAM") == {"FINISHED"}
    assert last.message.startswith("1 contour improved")
    assert not marked_edges(bad, "seam")
    assert marked_edges(sound, "seam") == marked_edges(sound, "select") == edge_set(ring(GROOVE))
    assert selected_vertices(bad) == {outside}


def test_adjusting_selects_the_required_vertices_outside_too(last):
    obj = grooved_cylinder()
    group(obj, [ring(0)[3]], "Pins")
    start(obj)
    assert bpy.ops.mesh.adjust_contour(required_group="Pins", width=3) == {"FINISHED"}
    assert "1 required vertex lies outside" in last.message
    assert selected_vertices(obj) == {ring(0)[3]}


def test_undo_and_redo_with_a_wider_band_restore_the_selection_and_its_mode():
    obj = grooved_cylinder()
    group(obj, [ring(GROOVE + 4)[3]], "Pins")
    start(obj)
    bpy.ops.ed.undo_push()
    bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, required_group="Pins", width=2)
    assert selected_vertices(bpy.context.object) == {ring(GROOVE + 4)[3]}
    bpy.ops.ed.undo()
    obj = bpy.context.object
    assert bpy.context.tool_settings.mesh_select_mode[:] == (False, True, False)
    assert marked_edges(obj, "select") == edge_set(START)
    run(required_group="Pins", width=10, reach=0.0)
    assert ring(GROOVE + 4)[3] in selected_vertices(obj)


def test_each_required_vertex_goes_to_the_nearest_contour():
    obj = grooved_cylinder(grooves=(5, 15))
    low, high = ring(6)[4], ring(14)[20]
    group(obj, [low, high], "Pins")
    start(obj, rough_loop(4))
    select(obj, pairs(rough_loop(13)))
    run(required_group="Pins", output="SEAM")
    seams = {vertex for edge in marked_edges(obj, "seam") for vertex in edge}
    assert {low, high} <= seams
    assert edge_set(ring(5)) & marked_edges(obj, "seam")
    assert edge_set(ring(15)) & marked_edges(obj, "seam")


def test_required_vertices_that_no_contour_can_pass_are_refused(last):
    """No contour that winds around once can pass all vertices of a column."""
    obj = grooved_cylinder()
    pins = [ring(row)[4] for row in range(GROOVE - 3, GROOVE + 3)] + [ring(GROOVE)[5], ring(GROOVE)[3]]
    group(obj, pins, "Pins")
    start(obj)
    before = mesh_state(obj)
    assert run(required_group="Pins", max_turn=0.3, reach=0.0) == {"CANCELLED"}
    assert "no contour in the band passes all required vertices: raise Width, Reach or Sharpest Turn" in last.message
    assert but_selection(mesh_state(obj)) == but_selection(before)
    assert selected_vertices(obj) <= set(pins)


# ---- attractors


@pytest.mark.parametrize("strength", [20.0, 0.0, -20.0])
def test_a_painted_ring_attracts_or_repels_by_its_strength(strength):
    """On a plain cylinder all rings are equal, so the sign of the strength decides about the painted one."""
    obj = grooved_cylinder(depth=0)
    group(obj, ring(GROOVE))
    start(obj)
    run(attractor_group="Group", attractor_strength=strength, min_salience=0.0)
    assert (heights(obj) == [GROOVE]) == (strength > 0)


def test_attractors_override_the_least_salience():
    obj = grooved_cylinder(depth=0)
    group(obj, ring(GROOVE - 2))
    start(obj)
    run()
    assert heights(obj) != [GROOVE - 2]
    start(obj)
    run(attractor_group="Group")
    assert heights(obj) == [GROOVE - 2]


def test_a_greater_weight_attracts_more_strongly():
    obj = grooved_cylinder(depth=0)
    group(obj, ring(8), weight=0.2)
    group(obj, ring(14), weight=1.0)
    start(obj, ring(11))
    run(attractor_group="Group", anchor=0.0, reach=0.0)
    assert heights(obj) == [14]


@pytest.mark.parametrize("kind", ["SEAM", "SHARP", "CREASE"])
def test_marked_edges_attract_the_contour(kind):
    obj = start(grooved_cylinder(depth=0))
    mark(obj, pairs(ring(GROOVE)), kind)
    run(attractor_marks={kind})
    assert heights(obj) == [GROOVE]


def test_marks_along_the_given_contour_do_not_hold_it():
    obj = start(grooved_cylinder())
    mark(obj, pairs(START), "SEAM")
    run(attractor_marks={"SEAM"}, barrier_marks={"SEAM"}, output="SEAM")
    assert marked_edges(obj, "seam") == edge_set(ring(GROOVE))


# ---- barriers


@pytest.mark.parametrize("kind", ["SEAM", "SHARP", "CREASE"])
def test_marked_edges_are_not_crossed(kind):
    obj = start(grooved_cylinder(), ring(GROOVE - 4))
    mark(obj, pairs(ring(GROOVE - 2)), kind)
    run(barrier_marks=set(), reach=0.0)
    assert heights(obj) == [GROOVE]
    bpy.ops.mesh.select_all(action="DESELECT")
    select(obj, pairs(ring(GROOVE - 4)))
    run(barrier_marks={kind}, min_salience=0.0, reach=0.0)
    assert max(heights(obj)) <= GROOVE - 2


def test_a_contour_across_a_barrier_stays_and_the_others_move(last):
    obj = grooved_cylinder(grooves=(5, 15))
    start(obj, rough_loop(4))
    select(obj, pairs(rough_loop(13)))
    mark(obj, pairs([ring(row)[7] for row in range(3, 9)], closed=False), "SHARP")
    assert run(barrier_marks={"SHARP"}, output="SEAM") == {"FINISHED"}
    assert "Left unchanged: the contour crosses a barrier" in last.message
    assert marked_edges(obj, "seam") == edge_set(ring(15))


# ---- regions


def paint(obj, faces, kind):
    """Paint faces of the cylinder in Object Mode and return the operator's properties that name the layer."""
    mesh = obj.data
    values = np.zeros(len(mesh.polygons))
    values[list(faces)] = 1.0
    corners = np.array([corner for face in faces for corner in mesh.polygons[face].loop_indices])
    if kind == "GROUP":
        group(obj, {vertex for face in faces for vertex in mesh.polygons[face].vertices}, "Layer")
    elif kind == "ATTRIBUTE":
        mesh.attributes.new("Layer", "FLOAT", "FACE").data.foreach_set("value", values)
    elif kind == "INTEGER":
        mesh.attributes.new("Layer", "INT", "FACE").data.foreach_set("value", values.astype(np.int32))
    else:
        layer = mesh.color_attributes.new("Layer", *kind)
        used = corners if kind[1] == "CORNER" else {mesh.loops[corner].vertex_index for corner in corners}
        for index in range(len(layer.data)):
            layer.data[index].color = (0, 0, 0, 1)
        for index in used:
            layer.data[index].color = (1, 1, 1, 1)
    source = {"GROUP": "GROUP", "ATTRIBUTE": "ATTRIBUTE", "INTEGER": "ATTRIBUTE"}.get(kind, "COLOR")
    return {"region_source": source, "region_layer": "Layer"}


LAYERS = ["GROUP", "ATTRIBUTE", "INTEGER"] + [
    (kind, domain) for kind in ("BYTE_COLOR", "FLOAT_COLOR") for domain in ("POINT", "CORNER")
]


@pytest.mark.parametrize("kind", LAYERS, ids=str)
@pytest.mark.parametrize("upper", [True, False])
def test_the_contour_takes_in_the_painted_faces(kind, upper):
    """On a plain cylinder painted from one end to beyond a loop, the loop moves to the border of the paint."""
    obj = grooved_cylinder(depth=0)
    rows = range(8, RINGS - 1) if upper else range(12)
    layer_settings = paint(obj, [row * SEGMENTS + column for row in rows for column in range(SEGMENTS)], kind)
    start(obj, ring(10))
    assert run(**layer_settings, region_strength=50.0, anchor=0.0) == {"FINISHED"}
    (row,) = heights(obj)
    assert row < 10 if upper else row > 10
    bpy.ops.mesh.select_all(action="DESELECT")
    select(obj, pairs(ring(10)))
    run(**layer_settings, region_strength=-50.0, anchor=0.0)
    (row,) = heights(obj)
    assert row > 10 if upper else row < 10


def test_in_face_mode_the_selected_part_takes_in_the_painted_faces():
    """Even if most painted faces lie on the other side."""
    obj = grooved_cylinder(depth=0)
    layer_settings = paint(obj, range(8 * SEGMENTS, 16 * SEGMENTS), "ATTRIBUTE")
    edit(obj, mode="FACE")
    select_faces_below(obj, ring(9))
    before = sum(face.select for face in bmesh.from_edit_mesh(obj.data).faces)
    run(**layer_settings, region_strength=50.0, anchor=0.0, width=4)
    assert sum(face.select for face in bmesh.from_edit_mesh(obj.data).faces) > before


def test_an_open_chain_cannot_have_a_region(last):
    obj = grooved_cylinder()
    layer_settings = paint(obj, range(40), "ATTRIBUTE")
    edit(obj)
    select(obj, pairs(START[:12], closed=False))
    before = mesh_state(obj)
    assert run(**layer_settings) == {"CANCELLED"}
    assert "an open chain does not enclose a region" in last.message
    assert mesh_state(obj) == before


# ---- what is missing


@pytest.mark.parametrize(
    ("layer_settings", "words"),
    [
        ({"required_group": "Pins"}, "there is no vertex group named Pins"),
        ({"attractor_group": "Pins"}, "there is no vertex group named Pins"),
        ({"region_source": "GROUP"}, "no vertex group is chosen: choose one under Constraints, or set Region to None"),
        ({"region_source": "GROUP", "region_layer": "Pins"}, "there is no vertex group named Pins"),
        ({"region_source": "ATTRIBUTE", "region_layer": "Pins"}, "there is no face attribute named Pins"),
        ({"region_source": "COLOR", "region_layer": "Pins"}, "there is no color attribute named Pins"),
    ],
)
def test_missing_layers_are_named(layer_settings, words, last):
    obj = start(grooved_cylinder())
    before = mesh_state(obj)
    assert run(**layer_settings) == {"CANCELLED"}
    assert words in last.message
    assert mesh_state(obj) == before
    bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(ValueError, match=words):
        api.optimize_contour(obj, START, **layer_settings)


def test_scripts_have_the_same_constraints():
    obj = grooved_cylinder(depth=0)
    pin = ring(GROOVE)[4]
    group(obj, [pin], "Pins")
    group(obj, ring(GROOVE - 2))
    pulled = api.optimize_contour(obj, START, attractor_group="Group")
    assert edge_set(np.asarray(pulled.vertices).tolist()) == edge_set(ring(GROOVE - 2))
    pinned = api.optimize_contour(obj, START, attractor_group="Group", required_group="Pins")
    assert pin in pinned.vertices
    group(obj, ring(RINGS - 1), "Pins")
    with pytest.raises(ValueError, match="32 required vertices lie outside the band"):
        api.optimize_contour(obj, START, required_group="Pins", width=3)
    with pytest.raises(TypeError, match="requird"):
        api.optimize_contour(obj, START, requird="Pins")
