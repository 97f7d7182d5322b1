# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar panel, the menu entry and the numbers of the last result."""

import textwrap

import bpy
from bpy.props import CollectionProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import native, report
from .parameters import MAIN, MORE

OPERATOR = "mesh.optimize_contour"
_SHOWN = 8  # contours with their numbers in the panel


class ContourNumbers(bpy.types.PropertyGroup):
    """The numbers of one contour, for display."""

    place: StringProperty()
    status: StringProperty()
    initial_ratio: FloatProperty()
    ratio: FloatProperty()
    faces: IntProperty()
    milliseconds: FloatProperty()


class LastResult(bpy.types.PropertyGroup):
    """What the last run of an operator said and found."""

    message: StringProperty()
    contours: CollectionProperty(type=ContourNumbers)


def show_result(context, message, outcomes):
    """Puts a message and the numbers of the results into the panel."""
    last = context.window_manager.minimum_ratio_contours
    last.message = message
    last.contours.clear()
    for outcome in outcomes:
        if outcome.result is not None:
            _fill(last.contours.add(), outcome)


def draw_settings(layout, settings):
    """The main settings, for the panel and the redo panel alike."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.prop(settings, "output")
    row = layout.row()
    row.enabled = settings.output in ("SEAM", "SHARP")
    row.prop(settings, "keep_old")
    row = layout.row()
    row.enabled = settings.output in ("RIP", "SEPARATE")
    row.prop(settings, "fill_holes")
    row = layout.row()
    row.enabled = not settings.whole_surface
    row.prop(settings, "width")
    row = layout.row()
    row.use_property_split = False  # beside a split the name would not fit into a sidebar of the usual width
    row.prop(settings, "whole_surface")
    for name in MAIN:
        layout.prop(settings, name)


def draw_more_settings(layout, settings):
    layout.use_property_split = True
    layout.use_property_decorate = False
    for name in MORE:
        layout.prop(settings, name)
    row = layout.row()
    row.enabled = settings.refinement > 0
    row.prop(settings, "merge")


class VIEW3D_PT_minimum_ratio_contours(bpy.types.Panel):
    bl_label = "Minimum Ratio Contours"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Contours"
    bl_context = "mesh_edit"

    def draw(self, context):
        layout = self.layout
        problem = native.problem()
        if problem:
            _draw_text(layout, context, problem, "ERROR")
            return
        # The panel's settings are the operator's own: those of the last run, which the next run from the panel takes.
        draw_settings(layout.column(), context.window_manager.operator_properties_last(OPERATOR))
        layout.operator(OPERATOR, icon="MOD_EDGESPLIT")
        layout.operator("mesh.adjust_contour", icon="MODIFIER")
        last = context.window_manager.minimum_ratio_contours
        if last.message:
            _draw_result(layout.box(), context, last)


class VIEW3D_PT_minimum_ratio_contours_more(bpy.types.Panel):
    bl_label = "More Settings"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Contours"
    bl_parent_id = "VIEW3D_PT_minimum_ratio_contours"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        draw_more_settings(self.layout.column(), context.window_manager.operator_properties_last(OPERATOR))


def _draw_result(box, context, last):
    _draw_text(box, context, last.message, "INFO")
    for numbers in last.contours[:_SHOWN]:
        column = box.column(align=True)
        column.label(text=f"{numbers.place}: {numbers.status}")
        column.label(text=f"ratio {numbers.initial_ratio:.4g} to {numbers.ratio:.4g}")
        column.label(text=f"{numbers.faces} faces, {numbers.milliseconds:.1f} ms")
    if len(last.contours) > _SHOWN:
        box.label(text=f"and {len(last.contours) - _SHOWN} more")


def _draw_text(layout, context, text, icon):
    """Labels do not wrap by themselves. About 70 points go to margins, icon and tabs, and 6.5 to a character."""
    points = context.region.width / context.preferences.system.ui_scale
    column = layout.column(align=True)
    for index, line in enumerate(textwrap.wrap(text, max(16, int((points - 70) / 6.5)))):
        column.label(text=line, icon=icon if index == 0 else "BLANK1")


def _fill(numbers, outcome):
    numbers.place = outcome.place
    numbers.status = outcome.result.status
    numbers.initial_ratio = outcome.result.initial_ratio
    numbers.ratio = outcome.result.ratio
    numbers.faces = outcome.result.statistics["faces"]
    numbers.milliseconds = report.milliseconds(outcome.result)


def _draw_menu(self, context):
    self.layout.separator()
    self.layout.operator(OPERATOR)
    self.layout.operator("mesh.adjust_contour")


_CLASSES = (
    ContourNumbers,
    LastResult,
    VIEW3D_PT_minimum_ratio_contours,
    VIEW3D_PT_minimum_ratio_contours_more,
)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.minimum_ratio_contours = PointerProperty(type=LastResult)
    bpy.types.VIEW3D_MT_edit_mesh_edges.append(_draw_menu)


def unregister():
    bpy.types.VIEW3D_MT_edit_mesh_edges.remove(_draw_menu)
    del bpy.types.WindowManager.minimum_ratio_contours
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
