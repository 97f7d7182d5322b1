# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: they alone talk to the user."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from . import api, jobs, native, outputs, panels, report, selection
from .parameters import CONSTRAINTS, SETTINGS


class NetworkSettings:
    """The properties of the settings table that every operator that optimizes has."""

    refinement: IntProperty(**SETTINGS["refinement"])
    regular_iterations: IntProperty(**SETTINGS["regular_iterations"])
    width: IntProperty(**SETTINGS["width"])
    whole_surface: BoolProperty(**SETTINGS["whole_surface"])
    reach: FloatProperty(**SETTINGS["reach"])
    iterations: IntProperty(**SETTINGS["iterations"])
    length_bias: FloatProperty(**SETTINGS["length_bias"])
    length_floor: FloatProperty(**SETTINGS["length_floor"])
    anchor: FloatProperty(**SETTINGS["anchor"])
    crease: FloatProperty(**SETTINGS["crease"])
    feature_clamp: FloatProperty(**SETTINGS["feature_clamp"])
    min_salience: FloatProperty(**SETTINGS["min_salience"])
    max_turn: FloatProperty(**SETTINGS["max_turn"])
    flow: EnumProperty(**SETTINGS["flow"])

    def settings(self):
        return {name: getattr(self, name) for name in SETTINGS if hasattr(self, name)}


class ContourSettings(NetworkSettings):
    """All of them, for the operators that optimize contours by themselves."""

    ends: EnumProperty(**SETTINGS["ends"])
    close: BoolProperty(
        name="Close Chains",
        description="Close each open chain of edges round the limb that it lies on before it is optimized, so that a "
        "quarter of a loop is enough. Stay Near then holds the contour near the loop so closed",
        default=False,
    )


class ContourConstraints:
    """The properties of the constraints table, for operators on selected contours."""

    required_group: StringProperty(**CONSTRAINTS["required_group"])
    barrier_marks: EnumProperty(**CONSTRAINTS["barrier_marks"])
    attractor_group: StringProperty(**CONSTRAINTS["attractor_group"])
    attractor_marks: EnumProperty(**CONSTRAINTS["attractor_marks"])
    attractor_strength: FloatProperty(**CONSTRAINTS["attractor_strength"])
    attractor_radius: FloatProperty(**CONSTRAINTS["attractor_radius"])
    region_source: EnumProperty(**CONSTRAINTS["region_source"])
    region_layer: StringProperty(**CONSTRAINTS["region_layer"])
    region_strength: FloatProperty(**CONSTRAINTS["region_strength"])

    def constraints(self):
        return {name: getattr(self, name) for name in CONSTRAINTS}


class CutSettings:
    """The property that says how refined contours are cut, for every operator that cuts."""

    merge: FloatProperty(
        name="Merge",
        description="Points of a refined contour closer to a vertex than this share of their edge are moved onto it, "
        "so that the cut leaves no slivers; the contour gives way by as much. 0: cut where it was found",
        default=0.0,
        min=0.0,
        max=0.5,
    )


class ContourOutput(CutSettings):
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

    def wish(self, context):
        face_mode = tuple(context.tool_settings.mesh_select_mode) == (False, False, True)
        return outputs.Wish(self.output, self.keep_old, self.fill_holes, self.merge, face_mode)

    def finish(self, context, parts, wish):
        """Makes the output of what was found and says what became of it; the operator's last step."""
        for part in parts:
            selection.note_warnings(part)
        outputs.refuse(parts, wish)
        outcomes = [outcome for part in parts for outcome in part.outcomes]
        if not outcomes:
            return self.give_up(context, "WARNING", report.NOTHING_SELECTED)
        warnings = [warning for part in parts for warning in part.warnings]
        message = report.summary(outcomes, warnings + report.turn_notes(outcomes, self.settings()))
        level = "WARNING" if warnings or any(outcome.problem for outcome in outcomes) else "INFO"
        outside = {part.obj: part.outside for part in parts if len(part.outside)}
        possible = outputs.is_possible(parts, wish)
        if not (possible or outside):
            return self.give_up(context, level, message, outcomes)
        if possible:
            outputs.write(context, parts, wish)
        if outside:
            outputs.select_vertices(outside)
        return self.tell(context, level, message, outcomes)


class Folds:
    """What is unfolded in the redo panel, which Blender cannot divide into panels."""

    show_more: BoolProperty(
        name="More Settings", description="Show the settings that are seldom changed", options={"HIDDEN"}
    )
    show_constraints: BoolProperty(name="Constraints", description="Show what the contours keep to", options={"HIDDEN"})


class InEditMode:
    """Where the operators can be called, with the reason where they cannot, and how they talk to the user."""

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

    def tell(self, context, level, message, outcomes=()):
        panels.show_result(context, message, outcomes)
        self.report({level}, message)
        return {"FINISHED"}

    def give_up(self, context, level, message, outcomes=()):
        self.tell(context, level, message, outcomes)
        return {"CANCELLED"}


class SearchInEditMode(InEditMode, jobs.SearchOperator):
    """What the operators that search once, and write what they found, have in common."""

    bl_options = {"REGISTER", "UNDO"}

    def prepare(self, context):
        problem = native.problem()
        if problem:
            self.give_up(context, "ERROR", problem)
            return None
        return self.read(context)

    def is_current(self, context, work):
        return context.mode == "EDIT_MESH" and api.are_current(self.surfaces(work))


class MESH_OT_optimize_contour(
    ContourSettings, ContourConstraints, ContourOutput, Folds, SearchInEditMode, bpy.types.Operator
):
    """Move each selected loop or chain to the part boundary nearby, where the surface is most concave for its length"""

    bl_idname = "mesh.optimize_contour"
    bl_label = "Optimize Contour"

    def read(self, context):
        wish = self.wish(context)
        objects = context.objects_in_mode_unique_data
        return selection.read_parts(objects, wish.face_mode, self.close, self.constraints()), wish

    def search(self, work):
        parts, settings = work[0], self.settings()
        return lambda progress: selection.optimize_parts(parts, settings, progress)

    def apply(self, context, work):
        return self.finish(context, *work)

    def surfaces(self, work):
        return [(part.obj, part.surface) for part in work[0] if part.surface]

    def draw(self, context):
        panels.draw_redo(self.layout, self, context.object)


def properties_of(*mixins):
    """The properties that mixins give an operator, by name."""
    classes = [cls for mixin in mixins for cls in mixin.__mro__]
    return {name: prop for cls in classes for name, prop in cls.__dict__.get("__annotations__", {}).items()}


def register():
    bpy.utils.register_class(MESH_OT_optimize_contour)


def unregister():
    bpy.utils.unregister_class(MESH_OT_optimize_contour)
