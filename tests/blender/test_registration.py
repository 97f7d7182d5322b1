# SPDX-License-Identifier: GPL-3.0-or-later
"""What enabling the add-on brings, and that disabling it takes all of it away."""

import addon_utils
import bpy
import minimum_ratio_contours
from minimum_ratio_contours import native

MODULE = "minimum_ratio_contours"


OPERATORS = ("MESH_OT_optimize_contour", "MESH_OT_optimize_seams", "MESH_OT_optimize_segmentation")
MENUS = ("VIEW3D_MT_edit_mesh_edges", "VIEW3D_MT_uv_map", "VIEW3D_MT_edit_mesh_faces")


def entries(menu):
    return [entry for entry in getattr(bpy.types, menu)._dyn_ui_initialize() if entry.__module__.startswith(MODULE)]


def traces():
    """Whether the operators, the panel, a menu entry for each and the window manager's property are there."""
    return (
        *(hasattr(bpy.types, name) for name in OPERATORS),
        hasattr(bpy.types, "VIEW3D_PT_minimum_ratio_contours"),
        *(len(entries(menu)) == 1 for menu in MENUS),
        hasattr(bpy.types.WindowManager, "minimum_ratio_contours"),
    )


def test_disabling_leaves_nothing_and_enabling_brings_it_back():
    assert traces() == (True,) * 8
    addon_utils.disable(MODULE)
    try:
        assert traces() == (False,) * 8
    finally:
        addon_utils.enable(MODULE)
    assert traces() == (True,) * 8


def test_the_versions_agree():
    assert minimum_ratio_contours.bl_info["version"] == tuple(map(int, native.VERSION.split(".")))
    assert native.module().__version__ == native.VERSION
