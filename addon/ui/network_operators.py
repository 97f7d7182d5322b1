# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that optimize a whole network: all seams, or all borders between regions."""

from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..core import messages, networks
from ..core.outcomes import Outcome
from ..mesh import edge_marks, network_cutting, network_tasks, seam_network, segmentation
from ..mesh.arrays import synchronize
from ..mesh.network_tasks import NetworkTask
from ..mesh.surface_cache import arrays_and_surface_of
from . import panels
from .background_search import SearchOperator
from .operators import CutSettings, InEditMode, NetworkSettings


class NetworkOperator(NetworkSettings, CutSettings, InEditMode, SearchOperator):
    """The common part of the operators on networks."""

    bl_options = {"REGISTER", "UNDO"}
    optimize = staticmethod(networks.optimize_networks)

    if TYPE_CHECKING:  # defined by the operator
        noun: str
        layout: bpy.types.UILayout
        _read_network: Any
        _draw_source: Any
        _nothing: Any
        _chain_outcomes: Any
        _write: Any
        _written: Any

    def read(self, context):
        objects = context.objects_in_mode_unique_data
        for obj in objects:
            synchronize(obj)
        return [self._read_task(obj, objects) for obj in objects if obj.data.polygons]

    def apply(self, context, tasks):
        for task in tasks:
            task.plan = task.plan and network_cutting.check_when_cut(task.obj, task.plan, self.merge)
        outcomes = [outcome for task in tasks for outcome in self._outcomes(task)]
        if not outcomes:
            return self.conclude(context, "WARNING", self._nothing())
        warnings = network_tasks.warnings(tasks)
        notes = warnings + messages.turn_notes(outcomes, self.max_turn)
        message, level = messages.network_summary(outcomes, self.noun, notes), messages.level(outcomes, warnings)
        if all(outcome.problem for outcome in outcomes):
            return self.conclude(context, level, message, outcomes)
        moved = [task for task in tasks if task.plan and task.plan.changed]
        for task in moved:
            self._write(task, network_cutting.cut(task.obj, task.plan, self.merge))
        self._written(context)
        for task in moved:
            network_cutting.restore_normals(context, task.obj)
        return self.conclude(context, level, message, outcomes, changed=True)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        self._draw_source(layout, context)
        panels.draw_search_settings(layout, self)
        panels.draw_more_settings(layout, self)

    def _read_task(self, obj, objects):
        task = NetworkTask(obj=obj)
        try:
            self._read_network(task)
            if task.network is not None and task.network.movable:
                task.arrays, task.surface = arrays_and_surface_of(obj, beside=objects)
        except ValueError as error:
            task.error = error
        return task

    def _outcomes(self, task):
        if task.error is not None:
            outcome = Outcome(task.obj.name, None)
            outcome.refuse(task.error)
            return [outcome]
        return self._chain_outcomes(task)


class MESH_OT_optimize_seams(NetworkOperator, bpy.types.Operator):
    """Move all seams to the part boundaries nearby, where the surface is most concave relative to their length. \
Seams that meet stay together, and every island stays one island"""

    bl_idname = "mesh.optimize_seams"
    bl_label = "Optimize Seams"
    noun = "seams"

    selected_only: BoolProperty(
        name="Selected Only",
        description="Move the seams among the selected edges and leave the others where they are",
        default=False,
    )

    def _read_network(self, task):
        task.network = seam_network.read_network(task.obj, self.selected_only)
        task.asymmetric = self.selected_only and seam_network.lacks_images(task.obj)
        task.details = self.selected_only and seam_network.only_seams_selected(task.obj)

    def _nothing(self):
        return messages.no_seams(self.selected_only)

    def _chain_outcomes(self, task):
        return seam_network.outcomes(task.obj.name, task.plan)

    def _write(self, task, plan):
        seam_network.write(task.obj, plan, selection=task.details)

    def _written(self, context):
        edge_marks.unwrap_live(context, [obj.data for obj in context.objects_in_mode_unique_data])

    def _draw_source(self, layout, context):
        layout.prop(self, "selected_only")


class MESH_OT_optimize_segmentation(NetworkOperator, bpy.types.Operator):
    """Move the borders between all regions to the part boundaries nearby, and the labels of the faces with them. \
Borders that meet stay together, and no region is lost"""

    bl_idname = "mesh.optimize_segmentation"
    bl_label = "Optimize Segmentation"
    noun = "borders"

    source: EnumProperty(
        name="Regions",
        description="Where the labels of the regions are stored",
        items=(
            ("FACE_SETS", "Face Sets", "The face sets of Sculpt Mode"),
            ("MATERIAL", "Materials", "The material slots of the faces"),
            ("ATTRIBUTE", "Attribute", "An integer face attribute"),
        ),
        default="FACE_SETS",
    )
    attribute: StringProperty(name="Attribute", description="Name of an integer face attribute", default="")

    def _read_network(self, task):
        task.details = segmentation.read_labeling(task.obj, self.source, self.attribute)
        task.network = segmentation.read_network(task.obj, task.details)

    def _nothing(self):
        return messages.NO_BORDERS

    def _chain_outcomes(self, task):
        return segmentation.outcomes(task.obj.name, task.details, task.plan)

    def _write(self, task, plan):
        segmentation.write(task.obj, task.details, plan)

    def _written(self, context):
        """Do nothing: no other data depends on labels."""

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
