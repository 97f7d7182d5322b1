# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar panels and the numbers of the last result."""

import bpy
from bpy.props import CollectionProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from ..core import messages, native
from ..core.parameters import CONSTRAINTS, MAIN, MORE, NETWORK
from . import second_copy, show_directions
from .wrapped_text import draw_text

OPERATOR = "mesh.optimize_contour"
NETWORK_OPERATORS = ("mesh.optimize_seams", "mesh.optimize_segmentation")
_SHARED = (*NETWORK, "merge")  # the settings that networks take from the main panel
_SHOWN = 8  # contours whose numbers the panel shows


class ContourNumbers(bpy.types.PropertyGroup):
    """The numbers of one contour, for display."""

    place: StringProperty()
    status: StringProperty()
    initial_ratio: FloatProperty()
    ratios: StringProperty()
    ratio: FloatProperty()
    salience: StringProperty()
    length: FloatProperty()
    reason: StringProperty()
    faces: IntProperty()
    milliseconds: FloatProperty()


class LastResult(bpy.types.PropertyGroup):
    """The message and results of the last run of an operator."""

    message: StringProperty()
    contours: CollectionProperty(type=ContourNumbers)


def show_result(context, message, outcomes):
    """Show a message and the numbers of the results in the panel."""
    last = context.window_manager.minimum_ratio_contours
    last.message = message
    last.contours.clear()
    for outcome in outcomes:
        if outcome.result is not None:
            _fill(last.contours.add(), outcome)


def remember(context, values, operator=OPERATOR):
    """Let the operator's next run from the panel or a menu start from these values; skip those it does not have."""
    settings = context.window_manager.operator_properties_last(operator)
    for name, value in values.items():
        if hasattr(settings, name):
            setattr(settings, name, value)


def draw_redo(layout, operator, obj):
    """Draw all settings of an operator on selected contours; those that are seldom changed can be unfolded."""
    draw_settings(layout, operator)
    if _unfolded(layout, operator, "show_more"):
        draw_more_settings(layout, operator)
    if _unfolded(layout, operator, "show_constraints"):
        draw_constraints(layout, operator, obj)


def _unfolded(layout, operator, name):
    shown = getattr(operator, name)
    row = layout.row()
    row.use_property_split = False
    row.alignment = "LEFT"
    row.prop(operator, name, icon="DOWNARROW_HLT" if shown else "RIGHTARROW", emboss=False)
    return shown


def draw_settings(layout, settings):
    """Draw the main settings, for both the sidebar and the redo panel."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.prop(settings, "output")
    row = layout.row()
    row.enabled = settings.output in ("SEAM", "SHARP")
    row.prop(settings, "keep_old")
    row = layout.row()
    row.enabled = settings.output in ("RIP", "SEPARATE")
    row.prop(settings, "fill_holes")
    _draw_properties(layout, settings, ("close",))
    draw_search_settings(layout, settings)


def draw_search_settings(layout, settings):
    """Draw the settings of the search."""
    column = layout.column()
    column.enabled = not settings.whole_surface
    column.prop(settings, "width")
    column.prop(settings, "reach")
    row = layout.row(heading="Whole")  # the whole name would not fit into a sidebar of the default width
    row.prop(settings, "whole_surface", text="Surface")
    _draw_properties(layout, settings, MAIN)


def draw_more_settings(layout, settings):
    layout.use_property_split = True
    layout.use_property_decorate = False
    _draw_properties(layout, settings, MORE)
    if hasattr(settings, "merge"):
        row = layout.row()
        row.enabled = settings.refinement > 0
        row.prop(settings, "merge")


def _draw_properties(layout, settings, names):
    """Draw those of the properties that the operator has."""
    for name in names:
        if hasattr(settings, name):
            layout.prop(settings, name)


def draw_constraints(layout, settings, obj):
    """Draw the constraints; names of layers are picked from those of the active object."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.prop_search(settings, "required_group", obj, "vertex_groups")
    _draw_marks(layout, settings, "barrier_marks")
    layout.separator()
    layout.prop_search(settings, "attractor_group", obj, "vertex_groups")
    _draw_marks(layout, settings, "attractor_marks")
    column = layout.column()
    column.enabled = bool(settings.attractor_group or settings.attractor_marks)
    column.prop(settings, "attractor_strength")
    column.prop(settings, "attractor_radius")
    layout.separator()
    layout.prop(settings, "region_source")
    column = layout.column()
    column.enabled = settings.region_source != "NONE"
    places = {"ATTRIBUTE": (obj.data, "attributes"), "COLOR": (obj.data, "color_attributes")}
    column.prop_search(settings, "region_layer", *places.get(settings.region_source, (obj, "vertex_groups")))
    column.prop(settings, "region_strength")


def _draw_marks(layout, settings, name):
    """Draw marks below their label: next to it, three names would not fit into a sidebar of the default width."""
    column = layout.column(align=True)
    column.use_property_split = False
    column.label(text=CONSTRAINTS[name]["name"])
    column.row(align=True).prop(settings, name, expand=True)


class InSidebar:
    """The place of the panels."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Contours"


class InMainPanel(InSidebar):
    """The place of the panels below the main one."""

    bl_parent_id = "VIEW3D_PT_minimum_ratio_contours"


class VIEW3D_PT_minimum_ratio_contours(InSidebar, bpy.types.Panel):
    bl_label = "Contours"
    bl_context = "mesh_edit"

    def draw(self, context):
        layout = self.layout
        problem = native.problem()
        if problem:
            draw_text(layout, context, problem, "ERROR")
            return
        note = second_copy.note()
        if note:
            draw_text(layout, context, note, "ERROR")
        column = layout.column(align=True)
        column.scale_y = 1.3
        column.operator(OPERATOR, icon="MOD_EDGESPLIT")
        column.operator("mesh.adjust_contour", icon="HIDE_OFF")
        # The panel shows the operator's last properties, which the next run from the panel takes.
        draw_settings(layout.column(), _last_properties(context))

    def draw_header_preset(self, context):
        bpy.types.VIEW3D_PT_minimum_ratio_contours_presets.draw_panel_header(self.layout)


class VIEW3D_PT_minimum_ratio_contours_result(InMainPanel, bpy.types.Panel):
    bl_label = "Last Result"

    @classmethod
    def poll(cls, context):
        return bool(context.window_manager.minimum_ratio_contours.message)

    def draw(self, context):
        _draw_result(self.layout, context, context.window_manager.minimum_ratio_contours)


class VIEW3D_PT_minimum_ratio_contours_more(InMainPanel, bpy.types.Panel):
    bl_label = "More Settings"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        draw_more_settings(self.layout.column(), _last_properties(context))


class VIEW3D_PT_minimum_ratio_contours_constraints(InMainPanel, bpy.types.Panel):
    bl_label = "Constraints"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        draw_constraints(self.layout.column(), _last_properties(context), context.object)


class VIEW3D_PT_minimum_ratio_contours_networks(InMainPanel, bpy.types.Panel):
    bl_label = "Whole Mesh"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        seams, regions = map(context.window_manager.operator_properties_last, NETWORK_OPERATORS)
        _draw_network_operator(layout, context, "mesh.optimize_seams", icon="UV_EDGESEL")
        layout.prop(seams, "selected_only")
        _draw_network_operator(layout, context, "mesh.optimize_segmentation", icon="FACE_MAPS")
        layout.prop(regions, "source")
        if regions.source == "ATTRIBUTE":
            layout.prop_search(regions, "attribute", context.object.data, "attributes")


class VIEW3D_PT_minimum_ratio_contours_curvature(InMainPanel, bpy.types.Panel):
    bl_label = "Curvature"

    def draw(self, context):
        column = self.layout.column(align=True)
        column.operator("mesh.show_curvature", text="Show Colors", icon="COLOR")
        is_shown = show_directions.is_shown()
        column.operator(
            "mesh.show_curvature_directions", text="Directions", icon="ORIENTATION_NORMAL", depress=is_shown
        )


def _draw_network_operator(layout, context, name, icon):
    """Draw a button whose operator takes the settings of the main panel."""
    button, settings = layout.operator(name, icon=icon), _last_properties(context)
    for setting in _SHARED:
        setattr(button, setting, getattr(settings, setting))


def _last_properties(context):
    return context.window_manager.operator_properties_last(OPERATOR)


def _draw_result(layout, context, last):
    draw_text(layout, context, last.message, "INFO")
    for numbers in last.contours[:_SHOWN]:
        _draw_numbers(layout.box(), context, numbers, several=len(last.contours) > 1)
    if len(last.contours) > _SHOWN:
        layout.label(text=f"and {len(last.contours) - _SHOWN} more")


def _draw_numbers(box, context, numbers, several):
    """Draw all numbers of a single contour. For several, draw the reason of each, which the message does not assign."""
    icon = "CHECKMARK" if numbers.status == "improved" else "DOT"
    box = box.column(align=True)
    draw_text(box, context, f"{numbers.place}: {numbers.status}", icon)
    if several:
        draw_text(box, context, numbers.reason or numbers.salience, "BLANK1")
        return
    lines = (
        numbers.salience,
        numbers.ratios,
        f"Length {_length(context, numbers.length)}",
        f"{numbers.faces} faces, {numbers.milliseconds:.1f} ms",
    )
    for line in filter(None, lines):
        box.label(text=line, icon="BLANK1")


def _length(context, length):
    units = context.scene.unit_settings
    if units.system == "NONE":
        return messages.readable(length)
    return bpy.utils.units.to_string(units.system, "LENGTH", length * units.scale_length, precision=3)


def _fill(numbers, outcome):
    numbers.place = outcome.place
    numbers.status = outcome.result.status
    numbers.initial_ratio = outcome.result.initial_ratio
    numbers.ratio = outcome.result.ratio
    numbers.ratios = messages.ratios(outcome.result)
    numbers.salience = messages.salience(outcome.result)
    numbers.length = outcome.result.length
    numbers.reason = str(outcome.fault) if outcome.fault else messages.reason(outcome.result)
    numbers.faces = outcome.result.statistics["faces"]
    numbers.milliseconds = messages.milliseconds(outcome.result)


_CLASSES = (
    ContourNumbers,
    LastResult,
    VIEW3D_PT_minimum_ratio_contours,
    VIEW3D_PT_minimum_ratio_contours_networks,
    VIEW3D_PT_minimum_ratio_contours_curvature,
    VIEW3D_PT_minimum_ratio_contours_result,
    VIEW3D_PT_minimum_ratio_contours_constraints,
    VIEW3D_PT_minimum_ratio_contours_more,
)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.minimum_ratio_contours = PointerProperty(type=LastResult)


def unregister():
    del bpy.types.WindowManager.minimum_ratio_contours
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
