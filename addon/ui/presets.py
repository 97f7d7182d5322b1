# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the settings in the sidebar: those of the add-on, and the user's own in Blender's preset folder."""

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
from bpy.props import EnumProperty

from ..core import messages
from ..core.parameters import PRESETS, SETTINGS, preset_values
from . import panels, preferences


class MESH_OT_contour_preset(bpy.types.Operator):
    """Apply a preset to the settings in the sidebar"""

    bl_idname = "mesh.contour_preset"
    bl_label = "Contour Preset"
    bl_options = {"INTERNAL"}

    preset: EnumProperty(name="Preset", items=[(name, *row[:2]) for name, row in PRESETS.items()])

    @classmethod
    def description(cls, context, properties):
        return PRESETS[properties.preset][1]

    def execute(self, context):
        panels.remember(context, preset_values(self.preset, preferences.values(context)))
        return {"FINISHED"}


class MESH_OT_contour_preset_add(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of the settings in the sidebar"""

    bl_idname = "mesh.contour_preset_add"
    bl_label = "Add Contour Preset"
    preset_menu = "VIEW3D_PT_minimum_ratio_contours_presets"
    preset_subdir = "minimum_ratio_contours"
    # The whole path each time: Debian 13's Blender 4.3 has a newer Python than it was made for, in which names from
    # `preset_defines` get lost.
    preset_values = [
        f"bpy.context.window_manager.operator_properties_last({panels.OPERATOR!r}).{name}" for name in SETTINGS
    ]

    def execute(self, context):
        try:
            return super().execute(context)
        except OSError as error:  # where the folder may only be read, Blender would show a traceback
            self.report({"ERROR"}, messages.unsaved_preset(error))
            return {"CANCELLED"}


class VIEW3D_PT_minimum_ratio_contours_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Contour Presets"
    preset_subdir = MESH_OT_contour_preset_add.preset_subdir
    preset_operator = "script.execute_preset"
    preset_add_operator = MESH_OT_contour_preset_add.bl_idname

    def draw(self, context):
        self.layout.emboss = "PULLDOWN_MENU"
        self.layout.operator_context = "EXEC_DEFAULT"  # otherwise adding a preset asks for its name again
        for name, (text, _, _) in PRESETS.items():
            self.layout.operator(MESH_OT_contour_preset.bl_idname, text=text).preset = name
        self.layout.separator()
        if bpy.utils.preset_paths(self.preset_subdir):
            super().draw(context)
        else:
            self._draw_add(context.window_manager)

    def _draw_add(self, window_manager):
        """Draw the last row as Blender does, which would complain about the folder missing before the first preset."""
        row = self.layout.row()
        name = row.row()
        name.emboss = "NORMAL"
        name.prop(window_manager, "preset_name", text="")
        row.operator(self.preset_add_operator, text="", icon="ADD").name = window_manager.preset_name


_CLASSES = (MESH_OT_contour_preset, MESH_OT_contour_preset_add, VIEW3D_PT_minimum_ratio_contours_presets)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
