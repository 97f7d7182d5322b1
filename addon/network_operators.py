# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that optimize a whole network: all seams, or all borders between regions."""

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from . import api, mesh_access, native, outputs, panels, report, seams, segmentation
from .operators import NetworkSettings


class NetworkOperator(NetworkSettings):
    """What both have in common."""

    @classmethod
    def poll(cls, context):
        if context.mode == "EDIT_MESH":
            return True
        cls.poll_message_set("Contours are optimized in Edit Mode of a mesh")
        return False

    def execute(self, context):
        try:
            native.module()
        except native.Unavailable as error:
            return self._finish(context, "ERROR", str(error), [], changed=False)
        objects = context.objects_in_mode_unique_data
        outcomes, writers = [], []
        for obj in objects:
            found, write = self._plan(obj, objects)
            outcomes += found
            writers += [write] if write else []
        if not outcomes:
            return self._finish(context, "WARNING", self.nothing, [], changed=False)
        for write in writers:
            write()
        if writers:
            self._written(context)
        message = report.network_summary(outcomes, self.noun)
        level = "WARNING" if any(outcome.problem for outcome in outcomes) else "INFO"
        return self._finish(context, level, message, outcomes, changed=bool(writers))

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        self._draw_source(layout, context)
        panels.draw_search_settings(layout, self)
        panels.draw_more_settings(layout, self)

    def _plan(self, obj, objects):
        """The outcomes of an object, and what writes them; None where nothing moves."""
        mesh_access.synchronize(obj)
        try:
            return self._plan_on(obj, lambda: api.surface_of(obj, beside=objects))
        except ValueError as error:
            return [report.Outcome(obj.name, None, problem=str(error))], None

    def _finish(self, context, level, message, outcomes, changed):
        panels.show_result(context, message, outcomes)
        self.report({level}, message)
        return {"FINISHED" if changed else "CANCELLED"}


class MESH_OT_optimize_seams(NetworkOperator, bpy.types.Operator):
    """Move all seams to the part boundaries nearby, where the surface is most concave for their length. \
Where seams meet they stay together, and every island stays one island"""

    bl_idname = "mesh.optimize_seams"
    bl_label = "Optimize Seams"
    bl_options = {"REGISTER", "UNDO"}
    noun = "seams"
    nothing = "Nothing to optimize: there are no seams of two edges or more; mark some, or clear Selected Only"

    selected_only: BoolProperty(
        name="Selected Only",
        description="Move the seams among the selected edges and leave the others where they are",
        default=False,
    )

    def _plan_on(self, obj, make_surface):
        plan = seams.plan(obj, make_surface, self.selected_only, **self.settings())
        select = self.selected_only and seams.only_seams_selected(obj)
        write = (lambda: seams.write(obj, plan, select)) if plan.changed else None
        return seams.outcomes(obj.name, plan), write

    def _written(self, context):
        outputs.unwrap_live(context, [obj.data for obj in context.objects_in_mode_unique_data])

    def _draw_source(self, layout, context):
        layout.prop(self, "selected_only")


class MESH_OT_optimize_segmentation(NetworkOperator, bpy.types.Operator):
    """Move the borders between all regions to the part boundaries nearby; the faces' labels move with them. \
Where three regions meet they stay together, and no region is lost"""

    bl_idname = "mesh.optimize_segmentation"
    bl_label = "Optimize Segmentation"
    bl_options = {"REGISTER", "UNDO"}
    noun = "borders"
    nothing = "Nothing to optimize: there are no borders between regions; choose another source, or label some faces"

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

    def _plan_on(self, obj, make_surface):
        labelling = segmentation.read_labelling(obj, self.source, self.attribute)
        plan = segmentation.plan(obj, make_surface, labelling, **self.settings())
        write = (lambda: segmentation.write(obj, labelling, plan)) if plan.changed else None
        return segmentation.outcomes(obj.name, labelling, plan), write

    def _written(self, context):
        """Nothing follows from labels."""

    def _draw_source(self, layout, context):
        layout.prop(self, "source")
        row = layout.row()
        row.enabled = self.source == "ATTRIBUTE"
        row.prop_search(self, "attribute", context.object.data, "attributes")


def _draw_uv_menu(self, context):
    self.layout.separator()
    self.layout.operator(MESH_OT_optimize_seams.bl_idname)


def _draw_face_menu(self, context):
    self.layout.separator()
    self.layout.operator(MESH_OT_optimize_segmentation.bl_idname)


def register():
    bpy.utils.register_class(MESH_OT_optimize_seams)
    bpy.utils.register_class(MESH_OT_optimize_segmentation)
    bpy.types.VIEW3D_MT_uv_map.append(_draw_uv_menu)
    bpy.types.VIEW3D_MT_edit_mesh_faces.append(_draw_face_menu)


def unregister():
    bpy.types.VIEW3D_MT_edit_mesh_faces.remove(_draw_face_menu)
    bpy.types.VIEW3D_MT_uv_map.remove(_draw_uv_menu)
    bpy.utils.unregister_class(MESH_OT_optimize_segmentation)
    bpy.utils.unregister_class(MESH_OT_optimize_seams)
