# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows the user where the problems lie that kept an operator from doing anything."""

import bpy

from ..mesh import culprits


def show(context, outcomes):
    """Select what the problems of outcomes name, and frame it if there is a 3D view. Undo restores the selection."""
    objects = {obj.name: obj for obj in context.objects_in_mode_unique_data}
    elements_of = {}
    for outcome in outcomes:
        if outcome.culprits and outcome.place in objects:
            elements_of.setdefault(objects[outcome.place], []).extend(outcome.culprits)
    if culprits.select(elements_of) and context.window and not bpy.app.background:
        _frame(context)
        # A canceled operator leaves no step of its own.
        bpy.ops.ed.undo_push(message="Select Problem")


def _frame(context):
    areas = [area for area in (context.area, *context.screen.areas) if area and area.type == "VIEW_3D"]
    for area in areas[:1]:
        region = next(region for region in area.regions if region.type == "WINDOW")
        with context.temp_override(area=area, region=region):
            bpy.ops.view3d.view_selected()
