# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator on selected contours, and the properties and reports that it shares with the other operators."""

from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ..core import messages, search
from ..core.parameters import CONSTRAINTS, SETTINGS
from ..mesh import contour_tasks, outputs
from . import panels, show_place
from .background_search import SearchOperator


class NetworkSettings:
    """The properties from the settings table that all operators have in common."""

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
    """All properties from the settings table, for the operators on selected contours."""

    ends: EnumProperty(**SETTINGS["ends"])
    close: BoolProperty(
        name="Close Chains",
        description="First close each open chain of edges around the limb that it lies on, so that a quarter of a "
        "loop is enough. Stay Near then holds the contour near this closed loop",
        default=False,
    )


class ContourConstraints:
    """The properties from the constraints table, for the operators on selected contours."""

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
        description="With Refinement: move points of the contour closer to a vertex than this fraction of their edge "
        "onto it, so that the cut leaves no slivers; 0: cut exactly where the contour was found",
        default=0.0,
        min=0.0,
        max=0.5,
    )


class ContourOutput(CutSettings):
    """The properties that choose the output of contours, for the operators on selected contours."""

    if TYPE_CHECKING:  # defined by the operator
        max_turn: float
        conclude: Any

    output: EnumProperty(
        name="Output",
        description="What is made of the contour found. Refined contours are always cut into the faces",
        items=(
            ("SELECT", "Select", "Select it"),
            ("SEAM", "Seam", "Mark it as a UV seam"),
            ("SHARP", "Sharp", "Mark it as sharp edges"),
            ("CUT", "Cut", "Cut it into the faces that it crosses and select it"),
            ("RIP", "Rip", "Open the mesh along it; both sides stay in this object"),
            ("SEPARATE", "Separate", "Make a separate object of each part that it cuts off; the largest part stays"),
        ),
        default="SELECT",
    )
    keep_old: BoolProperty(
        name="Keep Old",
        description="Keep the marks along the given contour; otherwise they move with it",
        default=False,
    )
    fill_holes: BoolProperty(
        name="Fill Holes",
        description="Close each rim of a ripped or separated loop with a face",
        default=False,
    )

    def apply(self, context, tasks):
        """Make the output of the contours found and report it; the operator's last step."""
        options = outputs.OutputOptions(self.output, self.keep_old, self.fill_holes, self.merge)
        warnings = contour_tasks.warnings(tasks)
        outputs.refuse(tasks, options)
        outcomes = [outcome for task in tasks for outcome in task.outcomes]
        notes = contour_tasks.notes(tasks) + messages.turn_notes(outcomes, self.max_turn)
        message = messages.summary(outcomes, warnings + notes)
        changed = outputs.write(context, tasks, options)
        return self.conclude(context, messages.level(outcomes, warnings), message, outcomes, changed)


class Folds:
    """Which sections of the redo panel are unfolded, since Blender cannot divide it into subpanels."""

    show_more: BoolProperty(
        name="More Settings", description="Show the settings that are seldom changed", options={"HIDDEN"}
    )
    show_constraints: BoolProperty(
        name="Constraints", description="Show the constraints from layers of the mesh", options={"HIDDEN"}
    )


class InEditMode:
    """Makes operators available in Edit Mode only, with the reason elsewhere, and reports to the user."""

    if TYPE_CHECKING:  # defined by every operator
        report: Any
        options: Any
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
        """Show the outcome in the panel and the status bar, and where nothing was done the culprits in the mesh.

        Return the operator's result. If a repeated operator cancels, Blender restores what it did the last time.
        """
        panels.show_result(context, message, outcomes)
        self.report({level}, message)
        culprits = any(outcome.culprits for outcome in outcomes)
        if culprits and not changed and not self.options.is_repeat:
            show_place.show(context, outcomes)
        return {"FINISHED"} if changed else {"CANCELLED"}


def in_face_mode(context):
    """Whether face select is the only select mode, so that borders of selected faces are the contours."""
    return tuple(context.tool_settings.mesh_select_mode) == (False, False, True)


class MESH_OT_optimize_contour(
    ContourSettings, ContourConstraints, ContourOutput, Folds, InEditMode, SearchOperator, bpy.types.Operator
):
    """Move each selected loop or chain to the part boundary nearby, where the surface is most concave relative to \
its length"""

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
    """Return the properties that mixins define, by name."""
    classes = [cls for mixin in mixins for cls in mixin.__mro__]
    return {name: prop for cls in classes for name, prop in cls.__dict__.get("__annotations__", {}).items()}


def register():
    bpy.utils.register_class(MESH_OT_optimize_contour)


def unregister():
    bpy.utils.unregister_class(MESH_OT_optimize_contour)
