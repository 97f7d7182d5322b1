# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes of a mesh equal the values of its bmesh elements, in Edit Mode and Object Mode, set or never set."""

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import GROOVE, edit, find_edges, grooved_cylinder, marked_edges, pairs, ring, select
from minimum_ratio_contours.mesh import attributes, constraint_layers
from minimum_ratio_contours.mesh.arrays import synchronize

PROPERTIES = {
    ("edges", "select"): lambda edge: edge.select,
    ("edges", "hide"): lambda edge: edge.hide,
    ("edges", "use_seam"): lambda edge: edge.seam,
    ("edges", "use_edge_sharp"): lambda edge: not edge.smooth,
    ("edges", "vertices"): lambda edge: [vertex.index for vertex in edge.verts],
    ("polygons", "select"): lambda face: face.select,
    ("polygons", "hide"): lambda face: face.hide,
    ("polygons", "material_index"): lambda face: face.material_index,
    ("polygons", "loop_start"): lambda face: face.loops[0].index,
    ("loops", "vertex_index"): lambda corner: corner.vert.index,
    ("loops", "edge_index"): lambda corner: corner.edge.index,
}
TYPES = {"vertices": (np.int32, 2), "material_index": (np.int32,), "loop_start": (np.int32,)}
TYPES |= {"vertex_index": (np.int32,), "edge_index": (np.int32,)}


def changed_cylinder():
    """Make a cylinder with some hidden, selected and marked elements."""
    obj = grooved_cylinder()
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    bm.faces[40].hide_set(True)
    bm.faces[41].select_set(True)
    bm.faces[42].material_index = 3
    for edge in find_edges(bm, pairs(ring(5))):
        edge.seam, edge.smooth = True, False
    bmesh.update_edit_mesh(obj.data)
    select(obj, pairs(ring(GROOVE)))
    return obj


def elements(bm):
    return {"edges": bm.edges, "polygons": bm.faces, "loops": [corner for face in bm.faces for corner in face.loops]}


@pytest.mark.parametrize("make", [grooved_cylinder, changed_cylinder])
@pytest.mark.parametrize("mode", ["EDIT", "OBJECT"])
def test_attributes_equal_those_of_the_elements(make, mode):
    obj = make()
    bpy.ops.object.mode_set(mode="EDIT")
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.index_update()
    expected = {
        attribute: [read(element) for element in elements(bm)[attribute[0]]] for attribute, read in PROPERTIES.items()
    }
    synchronize(obj)
    bpy.ops.object.mode_set(mode=mode)
    for (collection, name), values in expected.items():
        found = attributes.read(obj, collection, name, *TYPES.get(name, (bool,)))
        assert found.tolist() == values, (collection, name)
        assert found.dtype == TYPES.get(name, (bool,))[0]


def test_an_attribute_can_be_read_while_another_mesh_is_edited():
    one, other = changed_cylinder(), grooved_cylinder("Other")
    assert other.data.is_editmode is False
    synchronize(one)
    assert attributes.read(other, "edges", "select", bool).tolist() == [edge.select for edge in other.data.edges]
    assert attributes.read(one, "edges", "use_seam", bool).sum() == len(marked_edges(one, "seam"))


def test_reading_attributes_leaves_no_temporary_mesh():
    obj = changed_cylinder()
    before = set(bpy.data.meshes)
    synchronize(obj)
    attributes.read(obj, "edges", "select", bool)
    assert set(bpy.data.meshes) == before


@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
@pytest.mark.parametrize("mode", ["EDIT", "OBJECT"])
def test_brightness_is_the_mean_of_the_stored_colors_of_a_face(domain, mode):
    obj = grooved_cylinder()
    layer = obj.data.color_attributes.new("Layer", "BYTE_COLOR", domain)
    layer.data.foreach_set("color", np.random.default_rng(7).random(4 * len(layer.data)).astype(np.float32))
    edit(obj)
    bm = bmesh.from_edit_mesh(obj.data)
    layer = (bm.verts if domain == "POINT" else bm.loops).layers.color["Layer"]
    stored = [
        [tuple((corner.vert if domain == "POINT" else corner)[layer])[:3] for corner in face.loops] for face in bm.faces
    ]
    synchronize(obj)
    bpy.ops.object.mode_set(mode=mode)
    density = constraint_layers.read(obj, region_source="COLOR", region_layer="Layer").density
    assert np.allclose(density, [np.mean(face) for face in stored], atol=1e-6)
