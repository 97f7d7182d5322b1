# SPDX-License-Identifier: GPL-3.0-or-later
"""What enabling the add-on brings, and that disabling it takes all of it away."""

import addon_utils
import bpy
import minimum_ratio_contours
from minimum_ratio_contours import native

MODULE = "minimum_ratio_contours"


def traces():
    """Whether the operators, the panel, the menu entry and the window manager's property are there."""
    menu = bpy.types.VIEW3D_MT_edit_mesh_edges
    entries = [function for function in menu._dyn_ui_initialize() if function.__module__.startswith(MODULE)]
    return (
        hasattr(bpy.types, "MESH_OT_optimize_contour"),
        hasattr(bpy.types, "MESH_OT_adjust_contour"),
        hasattr(bpy.types, "VIEW3D_PT_minimum_ratio_contours"),
        len(entries) == 1,
        hasattr(bpy.types.WindowManager, "minimum_ratio_contours"),
    )


def test_disabling_leaves_nothing_and_enabling_brings_it_back():
    assert traces() == (True,) * 5
    addon_utils.disable(MODULE)
    try:
        assert traces() == (False,) * 5
    finally:
        addon_utils.enable(MODULE)
    assert traces() == (True,) * 5


def test_the_versions_agree():
    assert minimum_ratio_contours.bl_info["version"] == tuple(map(int, native.VERSION.split(".")))
    assert native.module().__version__ == native.VERSION
