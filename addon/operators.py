# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: they alone talk to the user."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from . import native, outputs, panels, report, selection
from .parameters import SETTINGS


class ContourSettings:
    """The properties of the settings table, for every operator that optimizes."""

    width: IntProperty(**SETTINGS["width"])
    whole_surface: BoolProperty(**SETTINGS["whole_surface"])
    reach: FloatProperty(**SETTINGS["reach"])
    refinement: IntProperty(**SETTINGS["refinement"])
    regular_iterations: IntProperty(**SETTINGS["regular_iterations"])
    iterations: IntProperty(**SETTINGS["iterations"])
    length_bias: FloatProperty(**SETTINGS["length_bias"])
    length_floor: FloatProperty(**SETTINGS["length_floor"])
    anchor: FloatProperty(**SETTINGS["anchor"])
    crease: FloatProperty(**SETTINGS["crease"])
    feature_clamp: FloatProperty(**SETTINGS["feature_clamp"])
    min_salience: FloatProperty(**SETTINGS["min_salience"])
    max_turn: FloatProperty(**SETTINGS["max_turn"])
    flow: EnumProperty(**SETTINGS["flow"])
    ends: EnumProperty(**SETTINGS["ends"])

    def settings(self):
        return {name: getattr(self, name) for name in SETTINGS}


class ContourOutput:
    """The properties that say what becomes of a contour, for every operator that outputs one."""

    output: EnumProperty(
        name="Output",
        description="What becomes of the contour found. Refined contours are cut into the faces in any case",
        items=(
            ("SELECT", "Select", "Select it"),
            ("SEAM", "Seam", "Mark it as a UV seam"),
            ("SHARP", "Sharp", "Mark it as sharp edges"),
            ("CUT", "Cut", "Cut it into the faces that it crosses; a contour along edges is selected"),
            ("RIP", "Rip", "Open the mesh along it; both rims stay in this object"),
            ("SEPARATE", "Separate", "Make an object of its own of each part that it cuts off"),
        ),
        default="SELECT",
    )
    keep_old: BoolProperty(
        name="Keep Old",
        description="Leave seams or sharp edges along the given contour where they are; otherwise they move with it",
        default=False,
    )
    fill_holes: BoolProperty(
        name="Fill Holes",
        description="Close both rims of a ripped or separated loop with a face each",
        default=False,
    )
    merge: FloatProperty(
        name="Merge",
        description="Points of a refined contour closer to a vertex than this share of their edge are moved onto it, "
        "so that the cut leaves no slivers; the contour gives way by as much. 0: cut where it was found",
        default=0.0,
        min=0.0,
        max=0.5,
    )

    def wish(self, context):
        face_mode = tuple(context.tool_settings.mesh_select_mode) == (False, False, True)
        return outputs.Wish(self.output, self.keep_old, self.fill_holes, self.merge, face_mode)

    def finish(self, context, parts, wish):
        """Makes the output of what was found and says what became of it; the operator's last step."""
        outputs.refuse(parts, wish)
        outcomes = [outcome for part in parts for outcome in part.outcomes]
        if not outcomes:
            return self.give_up(context, "WARNING", report.NOTHING_SELECTED)
        warnings = [warning for part in parts for warning in part.warnings]
        message = report.summary(outcomes, warnings)
        level = "WARNING" if warnings or any(outcome.problem for outcome in outcomes) else "INFO"
        if not outputs.changes_anything(parts, wish):
            return self.give_up(context, level, message, outcomes)
        outputs.write(context, parts, wish)
        panels.show_result(context, message, outcomes)
        self.report({level}, message)
        return {"FINISHED"}

    def give_up(self, context, level, message, outcomes=()):
        panels.show_result(context, message, outcomes)
        self.report({level}, message)
        return {"CANCELLED"}


class InEditMode:
    """Where the operators can be called, with the reason where they cannot."""

    @classmethod
    def poll(cls, context):
        if context.mode == "EDIT_MESH":
            return True
        obj = context.object
        if obj and obj.type == "MESH" and (obj.library or obj.data.library):
            cls.poll_message_set(report.linked(obj))
        else:
            cls.poll_message_set("Contours are optimized in Edit Mode of a mesh")
        return False


class MESH_OT_optimize_contour(ContourSettings, ContourOutput, InEditMode, bpy.types.Operator):
    """Move each selected loop or chain to the part boundary nearby, where the surface is most concave for its length"""

    bl_idname = "mesh.optimize_contour"
    bl_label = "Optimize Contour"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            native.module()
        except native.Unavailable as error:
            return self.give_up(context, "ERROR", str(error))
        wish = self.wish(context)
        parts = selection.optimize_selection(context.objects_in_mode_unique_data, wish.face_mode, self.settings())
        return self.finish(context, parts, wish)

    def draw(self, context):
        panels.draw_settings(self.layout, self)
        panels.draw_more_settings(self.layout, self)


def register():
    bpy.utils.register_class(MESH_OT_optimize_contour)


def unregister():
    bpy.utils.unregister_class(MESH_OT_optimize_contour)
