# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions for scripts: they need no selection, return native results and leave the mesh unchanged."""

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import GROOVE, SEGMENTS, edge_set, edit, grooved_cylinder, mesh_state, ring, rough_loop
from minimum_ratio_contours import api
from minimum_ratio_contours.mesh.arrays import read_arrays


def test_object_mode():
    result = api.optimize_contour(grooved_cylinder(), rough_loop(GROOVE - 3), width=5)
    assert result.status == "improved"
    assert edge_set(np.asarray(result.vertices).tolist()) == edge_set(ring(GROOVE))


def test_edit_mode_sees_what_was_edited_and_changes_nothing():
    obj = grooved_cylinder(depth=0)
    edit(obj)
    shape = grooved_cylinder("Shape")
    bpy.context.view_layer.objects.active = obj
    for vertex, source in zip(bmesh.from_edit_mesh(obj.data).verts, shape.data.vertices):
        vertex.co = source.co
    before = mesh_state(obj)
    result = api.optimize_contour(obj, rough_loop(GROOVE - 3))
    assert edge_set(np.asarray(result.vertices).tolist()) == edge_set(ring(GROOVE))
    assert mesh_state(obj) == before


@pytest.mark.parametrize("name", ["around_limb", "close"])
def test_a_quarter_of_a_loop_is_closed_first(name):
    """`close` is the earlier name of `around_limb`."""
    obj, asked = grooved_cylinder(), {name: True}
    result = api.optimize_contour(obj, rough_loop(GROOVE - 3)[5:16], **asked)
    assert result.status == "improved"
    assert edge_set(np.asarray(result.vertices).tolist()) == edge_set(ring(GROOVE))
    with pytest.raises(ValueError, match="at least 2"):
        api.optimize_contour(obj, [12], **asked)


def test_the_old_name_asks_for_nothing_where_it_is_false():
    obj = grooved_cylinder()
    loop = rough_loop(GROOVE - 3)
    assert api.optimize_contour(obj, loop, closed=True, close=False).closed
    assert not api.optimize_contour(obj, loop[5:16], closed=False, close=False).closed


def test_a_surface_is_current_until_its_mesh_changes():
    objects = grooved_cylinder("First"), grooved_cylinder("Second")
    surfaces = [(obj, api.surface_of(obj, beside=objects)) for obj in objects]
    assert api.are_current(surfaces)
    objects[1].data.vertices[3].co.z += 0.1
    assert not api.are_current(surfaces)
    assert api.are_current([(obj, api.surface_of(obj, beside=objects)) for obj in objects])
    bpy.data.objects.remove(objects[1])
    assert not api.are_current(surfaces)


def test_errors_name_the_bad_input():
    obj = grooved_cylinder()
    with pytest.raises(ValueError, match=str(ring(0)[0])):
        api.optimize_contour(obj, [ring(0)[0], ring(4)[0], ring(8)[0]])
    with pytest.raises(TypeError, match="widht"):
        api.optimize_contour(obj, rough_loop(5), widht=3)


def test_arrays():
    obj = grooved_cylinder()
    obj.data.polygons[7].hide = True
    arrays = read_arrays(obj)
    faces = len(obj.data.polygons)
    assert arrays.positions.dtype == np.float64
    assert arrays.positions.shape == (len(obj.data.vertices), 3)
    assert arrays.face_offsets.tolist() == list(range(0, 4 * faces + 1, 4))
    assert arrays.face_vertices[:4].tolist() == [0, 1, SEGMENTS + 1, SEGMENTS]
    assert arrays.triangles.shape == (2 * faces, 3)
    assert arrays.hidden_faces.tolist() == [7]
    for array in (arrays.face_offsets, arrays.face_vertices, arrays.triangles, arrays.hidden_faces):
        assert array.dtype == np.int32
        assert array.flags.c_contiguous


def test_the_api_is_complete_and_documented():
    expected = "optimize_contour optimize_on optimize_all_on problem_on optimize_seams optimize_segmentation curvature"
    expected += " surface_of arrays_and_surface_of are_current forget native_module native_options"
    assert set(expected.split()) == set(api.__all__)
    assert all(getattr(api, name).__doc__ for name in api.__all__)


def test_scripts_can_call_the_native_module_directly():
    obj, mrc = grooved_cylinder(), api.native_module()
    edit(obj)
    surface, options = api.surface_of(obj), mrc.Options(**api.native_options(width=5))
    result = mrc.optimize(surface, rough_loop(GROOVE - 3), options=options)
    np.testing.assert_array_equal(result.vertices, api.optimize_contour(obj, rough_loop(GROOVE - 3), width=5).vertices)


def test_the_surface_follows_changes_in_edit_mode():
    obj = grooved_cylinder()
    edit(obj)
    before = api.surface_of(obj)
    assert api.surface_of(obj) is before
    bmesh.from_edit_mesh(obj.data).verts[:][0].co.x += 1
    assert api.surface_of(obj) is not before
