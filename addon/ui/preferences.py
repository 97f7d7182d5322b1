# SPDX-License-Identifier: GPL-3.0-or-later
"""The user's own defaults: what an operator starts from in each session."""

import bpy

from ..core import native
from . import panels
from .operators import ContourOutput, ContourSettings, properties_of

_PROPERTIES = properties_of(ContourSettings, ContourOutput)
_ADDON = __package__.rpartition(".")[0]  # by which Blender knows it


def _applied(name):
    """What Blender calls when this preference changes; what was set besides in the sidebar stays."""

    def changed(preferences, context):
        apply(context, (name,))

    return changed


class ContourPreferences(bpy.types.AddonPreferences):
    bl_idname = _ADDON
    # The same properties as the operator's, of which each change takes effect at once.
    __annotations__ = {
        name: prop.function(**prop.keywords, update=_applied(name)) for name, prop in sorted(_PROPERTIES.items())
    }

    def draw(self, context):
        layout = self.layout
        problem = native.problem()
        if problem:
            layout.label(text=problem, icon="ERROR")
        layout.label(text="What the operators start from in each session:")
        row = layout.row()
        panels.draw_settings(row.column(), self)
        panels.draw_more_settings(row.column(), self)
        layout.operator("mesh.contour_defaults", icon="LOOP_BACK")


class MESH_OT_contour_defaults(bpy.types.Operator):
    """Set all preferences of this add-on back to what it came with"""

    bl_idname = "mesh.contour_defaults"
    bl_label = "Restore Defaults"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        preferences = _find(context)
        for name in _PROPERTIES:
            preferences.property_unset(name)
        apply(context)
        return {"FINISHED"}


def values(context):
    """The user's defaults by name; none where the add-on runs without preferences."""
    preferences = _find(context)
    return {name: getattr(preferences, name) for name in _PROPERTIES} if preferences else {}


def apply(context, names=tuple(_PROPERTIES)):
    """Lets the next run of each operator start from the user's defaults, of all properties or of those named."""
    chosen = {name: value for name, value in values(context).items() if name in names}
    for operator in (panels.OPERATOR, *panels.NETWORK_OPERATORS):
        panels.remember(context, chosen, operator)


def _find(context):
    addon = context.preferences.addons.get(_ADDON)
    return addon.preferences if addon else None


def register():
    bpy.utils.register_class(ContourPreferences)
    bpy.utils.register_class(MESH_OT_contour_defaults)
    apply(bpy.context)


def unregister():
    bpy.utils.unregister_class(MESH_OT_contour_defaults)
    bpy.utils.unregister_class(ContourPreferences)
