# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: they alone talk to the user."""

from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ..core import messages, search
from ..core.parameters import CONSTRAINTS, SETTINGS
from ..mesh import contour_tasks, outputs
from . import panels
from .background_search import SearchOperator


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

    if TYPE_CHECKING:  # the operator's own
        max_turn: float
        conclude: Any

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

    def apply(self, context, tasks):
        """Makes the output of what was found and says what became of it; the operator's last step."""
        options = outputs.OutputOptions(self.output, self.keep_old, self.fill_holes, self.merge)
        warnings = contour_tasks.warnings(tasks)
        outputs.refuse(tasks, options)
        outcomes = [outcome for task in tasks for outcome in task.outcomes]
        message = messages.summary(outcomes, warnings + messages.turn_notes(outcomes, self.max_turn))
        changed = outputs.write(context, tasks, options)
        return self.conclude(context, messages.level(outcomes, warnings), message, outcomes, changed)


class Folds:
    """What is unfolded in the redo panel, which Blender cannot divide into panels."""

    show_more: BoolProperty(
        name="More Settings", description="Show the settings that are seldom changed", options={"HIDDEN"}
    )
    show_constraints: BoolProperty(name="Constraints", description="Show what the contours keep to", options={"HIDDEN"})


class InEditMode:
    """Where the operators can be called, with the reason where they cannot, and how they talk to the user."""

    if TYPE_CHECKING:  # every operator's
        report: Any
        poll_message_set: Any

    @classmethod
    def poll(cls, context):
        if context.mode == "EDIT_MESH":
            return True
        obj = context.object
        if obj and obj.type == "MESH" and (obj.library or obj.data.library):
            cls.poll_message_set(messages.linked(obj))
        else:
            cls.poll_message_set("Contours are optimized in Edit Mode of a mesh")
        return False

    def conclude(self, context, level, message, outcomes=(), changed=False):
        """Says in panel and status bar what came of it; gives what the operator returns."""
        panels.show_result(context, message, outcomes)
        self.report({level}, message)
        return {"FINISHED"} if changed else {"CANCELLED"}


def in_face_mode(context):
    """Whether faces alone are selected, so that their borders are the contours."""
    return tuple(context.tool_settings.mesh_select_mode) == (False, False, True)


class MESH_OT_optimize_contour(
    ContourSettings, ContourConstraints, ContourOutput, Folds, InEditMode, SearchOperator, bpy.types.Operator
):
    """Move each selected loop or chain to the part boundary nearby, where the surface is most concave for its length"""

    bl_idname = "mesh.optimize_contour"
    bl_label = "Optimize Contour"
    bl_options = {"REGISTER", "UNDO"}
    optimize = staticmethod(search.optimize_contours)

    def read(self, context):
        objects = context.objects_in_mode_unique_data
        return contour_tasks.read_tasks(objects, in_face_mode(context), self.close, self.constraints())

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
