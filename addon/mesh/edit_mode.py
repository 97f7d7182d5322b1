# SPDX-License-Identifier: GPL-3.0-or-later
"""Leaves Edit Mode for what can only be done to meshes outside, and enters it again with the same objects."""

from contextlib import contextmanager

import bpy


@contextmanager
def left(context):
    """Leave Edit Mode, and enter it again at the end. References to elements of the bmesh become invalid."""
    editing = context.objects_in_mode[:]
    selected = context.selected_objects[:]
    unselectable = [obj for obj in editing if obj.hide_select]
    for obj in unselectable:
        obj.hide_select = False
    for obj in selected:
        obj.select_set(obj in editing)
    bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        for obj in {*context.selected_objects, *editing}:
            obj.select_set(obj in editing)
        bpy.ops.object.mode_set(mode="EDIT")
        for obj in {*selected, *editing}:
            obj.select_set(obj in selected)
        for obj in unselectable:
            obj.hide_select = True
