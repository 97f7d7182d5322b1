# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh.show_curvature: attributes and colors of the least principal curvature, in Edit Mode."""

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import GROOVE, SEGMENTS, edit, grooved_cylinder, mesh_object, mesh_state, ring
from minimum_ratio_contours import api
from minimum_ratio_contours.ui import show_curvature


def run(**properties):
    return bpy.ops.mesh.show_curvature(**properties)


def shown(obj):
    """Return the values and colors of all vertices, read in Object Mode."""
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = obj.data
    values = np.empty(len(mesh.vertices))
    colors = np.empty(4 * len(mesh.vertices))
    mesh.attributes[show_curvature.VALUES].data.foreach_get("value", values)
    mesh.attributes[show_curvature.COLORS].data.foreach_get("color", colors)
    return values, colors.reshape(-1, 4)


def test_the_groove_is_blue_and_the_values_are_the_native_ones(capfd):
    obj = grooved_cylinder()
    edit(obj)
    assert run() == {"FINISHED"}
    assert obj.data.color_attributes.active_color.name == show_curvature.COLORS
    assert "'kappa_min' (1 / length) and 'Curvature'" in capfd.readouterr().out
    values, colors = shown(obj)
    native = np.asarray(api.curvature(obj).kappa_min)
    np.testing.assert_allclose(values, native, rtol=1e-6, atol=1e-6)
    red, blue = colors[:, 0], colors[:, 2]
    assert (blue[ring(GROOVE)] > 3 * red[ring(GROOVE)]).all()
    assert (colors[np.abs(native) < 1e-3 * np.abs(native).max()][:, :3].min(axis=1) > 0.8).all()
    assert (colors[:, 3] == 1).all()


def test_a_second_run_writes_the_same_attributes_and_nothing_else_changes():
    obj = grooved_cylinder()
    edit(obj)
    before = mesh_state(obj)
    run()
    after = mesh_state(obj)
    added = after["layers"].keys() - before["layers"].keys()
    assert {name for _, _, name in added} == {show_curvature.VALUES, show_curvature.COLORS}
    for key in added:
        del after["layers"][key]
    assert after == before
    run(quantile=0.2, radius=3.0)
    assert mesh_state(obj)["layers"].keys() == before["layers"].keys() | added


def test_the_radius_averages_and_a_lower_quantile_gives_more_contrast():
    obj = grooved_cylinder()
    contrast, deepest = [], []
    for properties in ({}, {"quantile": 0.3}, {"radius": 4.0}):
        edit(obj)
        run(**properties)
        values, colors = shown(obj)
        contrast.append(-colors[:, :3].sum(axis=1).mean())  # colors are darker than white
        deepest.append(values[ring(GROOVE)].min())
    assert contrast[1] > contrast[0]
    assert deepest[1] == deepest[0] < deepest[2]


def test_meshes_without_faces_are_reported_and_the_others_are_shown(capfd):
    obj, empty = grooved_cylinder(), mesh_object("Empty", [(0, 0, 0), (1, 0, 0)], edges=[(0, 1)])
    other = grooved_cylinder("Other")
    edit(obj, other, empty)
    assert run() == {"FINISHED"}
    message = capfd.readouterr().out
    assert "Curvature of 2 meshes written to" in message
    assert "Not shown: Empty: it has no faces, and only faces have a curvature" in message
    for mesh in (obj.data, other.data):
        assert show_curvature.COLORS in bmesh.from_edit_mesh(mesh).verts.layers.float_color


@pytest.mark.parametrize("name", [show_curvature.VALUES, show_curvature.COLORS])
def test_attributes_of_another_type_are_left_alone(name, capfd):
    obj = grooved_cylinder()
    obj.data.attributes.new(name, "INT", "FACE").data[0].value = 7
    edit(obj)
    before = mesh_state(obj)
    assert run() == {"CANCELLED"}
    assert f"there is an attribute of another type named '{name}': rename or remove it" in capfd.readouterr().out
    assert mesh_state(obj) == before


def test_undo_removes_the_attributes():
    obj = grooved_cylinder()
    edit(obj)
    bpy.ops.ed.undo_push()
    bpy.ops.mesh.show_curvature("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    layers = bmesh.from_edit_mesh(bpy.context.object.data).verts.layers
    assert not layers.float_color.keys()
    assert len(bpy.context.object.data.vertices) % SEGMENTS == 0


def test_only_in_edit_mode():
    grooved_cylinder()
    assert not bpy.ops.mesh.show_curvature.poll()
