# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on preferences: the user's own defaults, from which operators start in each session."""

import bpy

from ..core import native
from . import panels, second_copy
from .operators import ContourOutput, ContourSettings, properties_of
from .wrapped_text import draw_text

_PROPERTIES = properties_of(ContourSettings, ContourOutput)
_ADDON = __package__.rpartition(".")[0]  # the name under which Blender knows the add-on


def _applied(name):
    """Return the update callback of one preference, which leaves the other settings in the sidebar alone."""

    def changed(preferences, context):
        apply(context, (name,))

    return changed


class ContourPreferences(bpy.types.AddonPreferences):
    bl_idname = _ADDON
    # The same properties as the operator's; a change takes effect immediately.
    __annotations__ = {
        name: prop.function(**prop.keywords, update=_applied(name)) for name, prop in sorted(_PROPERTIES.items())
    }

    def draw(self, context):
        layout = self.layout
        for problem in filter(None, (native.problem(), second_copy.note())):
            draw_text(layout, context, problem, "ERROR")
        layout.label(text="Operator settings at the start of each session:")
        row = layout.row()
        panels.draw_settings(row.column(), self)
        panels.draw_more_settings(row.column(), self)
        layout.operator("mesh.contour_defaults", icon="LOOP_BACK")


class MESH_OT_contour_defaults(bpy.types.Operator):
    """Reset all preferences of this add-on to the factory defaults"""

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
    """Return the user's defaults by name; an empty dictionary if the add-on runs without preferences."""
    preferences = _find(context)
    return {name: getattr(preferences, name) for name in _PROPERTIES} if preferences else {}


def apply(context, names=tuple(_PROPERTIES)):
    """Let the next run of each operator start from the user's defaults for the named properties (default: all)."""
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
