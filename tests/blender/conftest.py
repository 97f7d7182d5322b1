# SPDX-License-Identifier: GPL-3.0-or-later
"""Every test starts from an empty scene with Blender's default settings."""

import bpy
import pytest
from minimum_ratio_contours import api


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
