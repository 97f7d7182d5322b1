# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that optimize a whole network: all seams, or all borders between regions."""

from dataclasses import dataclass

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from . import api, flags, jobs, mesh_access, network_cutting, networks, panels, report, seams, segmentation, selection
from .chains import Network
from .operators import CutSettings, NetworkSettings, SearchInEditMode


@dataclass
class Task:
    """One object's network, and what becomes of it."""

    obj: bpy.types.Object
    problem: str = ""  # why there is no network
    about: object = None  # what the operator must know to write it
    network: Network = None
    arrays: object = None  # of the mesh, where something is movable
    surface: object = None  # the native one made from them
    asymmetric: bool = False  # whether mirror images were asked for and are not there
    plan: networks.Plan = None


def optimize_tasks(tasks, settings, progress=None):
    """Gives each task its plan, or its problem. Without bpy, for any thread."""
    for i, task in enumerate(tasks):
        try:
            task.plan = networks.optimize(
                task.surface, task.network, jobs.share_of(progress, i, len(tasks)), **settings
            )
        except ValueError as error:
            task.problem = report.problem(error)


def _warnings(task):
    """What the user should know about how the object is measured, where anything was; before it is written."""
    if not (task.plan and task.plan.taken_results()):
        return []
    return selection.warnings_of(task.obj, task.arrays) + [report.not_mirrored(task.obj.name)] * task.asymmetric


class NetworkOperator(NetworkSettings, CutSettings, SearchInEditMode):
    """What both have in common."""

    def read(self, context):
        objects = context.objects_in_mode_unique_data
        for obj in objects:
            mesh_access.synchronize(obj)
        return [self._read_task(obj, objects) for obj in objects if obj.data.polygons]

    def search(self, tasks):
        sound, settings = [task for task in tasks if not task.problem], self.settings()
        return lambda progress: optimize_tasks(sound, settings, progress)

    def apply(self, context, tasks):
        for task in tasks:
            task.plan = task.plan and network_cutting.settled(task.obj, task.plan, self.merge)
        outcomes = [outcome for task in tasks for outcome in self._outcomes(task)]
        if not outcomes:
            return self.give_up(context, "WARNING", self._nothing())
        moved = [task for task in tasks if task.plan and task.plan.changed]
        warnings = [warning for task in tasks for warning in _warnings(task)]
        notes = warnings + report.turn_notes(outcomes, self.settings())
        message = report.network_summary(outcomes, self.noun, notes)
        level = "WARNING" if warnings or any(outcome.problem for outcome in outcomes) else "INFO"
        if all(outcome.problem for outcome in outcomes):
            return self.give_up(context, level, message, outcomes)
        for task in moved:
            self._write(task, network_cutting.cut(task.obj, task.plan, self.merge))
        self._written(context)
        for task in moved:
            network_cutting.restore_normals(context, task.obj)
        return self.tell(context, level, message, outcomes)

    def surfaces(self, tasks):
        return [(task.obj, task.surface) for task in tasks if task.surface]

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        self._draw_source(layout, context)
        panels.draw_search_settings(layout, self)
        panels.draw_more_settings(layout, self)

    def _read_task(self, obj, objects):
        task = Task(obj)
        try:
            self._read_network(task)
            if task.network.movable:
                task.arrays, task.surface = api.arrays_and_surface_of(obj, beside=objects)
        except ValueError as error:
            task.problem = report.problem(error)
        return task

    def _outcomes(self, task):
        if task.problem:
            return [report.Outcome(task.obj.name, None, problem=task.problem)]
        return self._chain_outcomes(task)


class MESH_OT_optimize_seams(NetworkOperator, bpy.types.Operator):
    """Move all seams to the part boundaries nearby, where the surface is most concave for their length. \
Where seams meet they stay together, and every island stays one island"""

    bl_idname = "mesh.optimize_seams"
    bl_label = "Optimize Seams"
    noun = "seams"

    selected_only: BoolProperty(
        name="Selected Only",
        description="Move the seams among the selected edges and leave the others where they are",
        default=False,
    )

    def _read_network(self, task):
        task.network = seams.read_network(task.obj, self.selected_only)
        task.asymmetric = self.selected_only and seams.lacks_images(task.obj)
        task.about = self.selected_only and seams.only_seams_selected(task.obj)

    def _nothing(self):
        return report.no_seams(self.selected_only)

    def _chain_outcomes(self, task):
        return seams.outcomes(task.obj.name, task.plan)

    def _write(self, task, plan):
        seams.write(task.obj, plan, selection=task.about)

    def _written(self, context):
        flags.unwrap_live(context, [obj.data for obj in context.objects_in_mode_unique_data])

    def _draw_source(self, layout, context):
        layout.prop(self, "selected_only")


class MESH_OT_optimize_segmentation(NetworkOperator, bpy.types.Operator):
    """Move the borders between all regions to the part boundaries nearby; the faces' labels move with them. \
Where three regions meet they stay together, and no region is lost"""

    bl_idname = "mesh.optimize_segmentation"
    bl_label = "Optimize Segmentation"
    noun = "borders"

    source: EnumProperty(
        name="Regions",
        description="What tells the regions apart",
        items=(
            ("FACE_SETS", "Face Sets", "The face sets of Sculpt Mode"),
            ("MATERIAL", "Materials", "The material slots of the faces"),
            ("ATTRIBUTE", "Attribute", "An integer attribute of the faces"),
        ),
        default="FACE_SETS",
    )
    attribute: StringProperty(name="Attribute", description="The name of an integer attribute of the faces", default="")

    def _read_network(self, task):
        task.about = segmentation.read_labeling(task.obj, self.source, self.attribute)
        task.network = segmentation.read_network(task.obj, task.about)

    def _nothing(self):
        return report.NO_BORDERS

    def _chain_outcomes(self, task):
        return segmentation.outcomes(task.obj.name, task.about, task.plan)

    def _write(self, task, plan):
        segmentation.write(task.obj, task.about, plan)

    def _written(self, context):
        """Nothing follows from labels."""

    def _draw_source(self, layout, context):
        layout.prop(self, "source")
        row = layout.row()
        row.enabled = self.source == "ATTRIBUTE"
        row.prop_search(self, "attribute", context.object.data, "attributes")


def register():
    bpy.utils.register_class(MESH_OT_optimize_seams)
    bpy.utils.register_class(MESH_OT_optimize_segmentation)


def unregister():
    bpy.utils.unregister_class(MESH_OT_optimize_segmentation)
    bpy.utils.unregister_class(MESH_OT_optimize_seams)
