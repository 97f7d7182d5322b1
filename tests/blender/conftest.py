# SPDX-License-Identifier: GPL-3.0-or-later
"""Every test starts from an empty scene with Blender's default settings."""

import bpy
import pytest
from minimum_ratio_contours import api


@bpy.app.handlers.persistent
def restore_seams(*_):
    """Copy seams to where Blender 5.1 expects them: 3.4, which saved the samples, names the attribute differently."""
    for mesh in bpy.data.meshes:
        if ".uv_seam" in mesh.attributes and not any(edge.use_seam for edge in mesh.edges):
            mesh.edges.foreach_set("use_seam", [seam.value for seam in mesh.attributes[".uv_seam"].data])


if bpy.app.version >= (5, 1, 0):
    bpy.app.handlers.load_post.append(restore_seams)


@pytest.fixture(autouse=True)
def empty_scene():
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
    settings = bpy.context.scene.tool_settings
    settings.mesh_select_mode = (False, True, False)
    settings.use_edge_path_live_unwrap = False
    bpy.context.window_manager.minimum_ratio_contours.message = ""
    for operator in ("mesh.optimize_contour", "mesh.optimize_seams", "mesh.optimize_segmentation"):
        remembered = bpy.context.window_manager.operator_properties_last(operator)
        for name in list(remembered.keys()):
            remembered.property_unset(name)
    api.forget()


@pytest.fixture
def last():
    """The message and numbers in the panel; the operator reports the same message."""
    return bpy.context.window_manager.minimum_ratio_contours
