# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows the least principal curvature, which attracts contours, as colors and as an attribute."""

import bmesh
import bpy
import numpy as np
from bpy.props import BoolProperty, FloatProperty

from ..core import messages, native
from ..core.curvature_colors import colors
from ..mesh.arrays import synchronize
from ..mesh.surface_cache import surface_of

VALUES, COLORS = "kappa_min", "Curvature"
_KINDS = {VALUES: ("POINT", "FLOAT"), COLORS: ("POINT", "FLOAT_COLOR")}


class MESH_OT_show_curvature(bpy.types.Operator):
    """Color the mesh by the concavity that attracts contours: valleys blue, flat places white, convex places red"""

    bl_idname = "mesh.show_curvature"
    bl_label = "Show Curvature"
    bl_options = {"REGISTER", "UNDO"}

    quantile: FloatProperty(
        name="Full Color",
        description="The color is full from this quantile of the curvatures on; lower: more contrast",
        default=0.95,
        min=0.05,
        max=1.0,
    )
    radius: FloatProperty(
        name="Radius",
        description="Radius around a vertex in which curvature is averaged, in average edge lengths of the mesh; "
        "contours use 1.6",
        default=1.6,
        min=0.1,
        soft_max=10.0,
    )
    shade: BoolProperty(
        name="Show in Viewport",
        description="Set this viewport to solid shading with the active color attribute",
        default=True,
    )

    @classmethod
    def poll(cls, context):
        if context.mode == "EDIT_MESH":
            return True
        cls.poll_message_set("Curvature is shown in Edit Mode of a mesh")
        return False

    def execute(self, context):
        try:
            native.module()
            objects = context.objects_in_mode_unique_data
            shown, problems = 0, []
            for obj in objects:
                problem = self._show(obj, objects)
                problems += [f"{obj.name}: {problem}"] if problem else []
                shown += not problem
        except native.Unavailable as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if shown and self.shade:
            _shade(context.space_data)
        message = messages.curvature_shown(shown, problems, VALUES, COLORS)
        self.report({"WARNING" if problems else "INFO"}, message)
        return {"FINISHED" if shown else "CANCELLED"}

    def _show(self, obj, objects):
        """Write both attributes. Return why that is impossible; empty if it was done."""
        taken = [name for name in _KINDS if not _is_free(obj.data, name)]
        if taken:
            return messages.name_taken(taken[0])
        synchronize(obj)
        try:
            surface = surface_of(obj, beside=objects)
        except ValueError as error:
            return messages.problem(error)
        if surface.vertex_count == 0 or surface.face_count == 0:
            return messages.NO_FACES
        mrc = native.module()
        curvatures = np.asarray(mrc.curvature(surface, mrc.Options(curvature_radius=self.radius)).kappa_min)
        _write(obj.data, curvatures, colors(curvatures, self.quantile))
        return ""


def _is_free(mesh, name):
    attribute = mesh.attributes.get(name)
    return attribute is None or (attribute.domain, attribute.data_type) == _KINDS[name]


def _write(mesh, values, shades):
    bm = bmesh.from_edit_mesh(mesh)
    layers = bm.verts.layers
    for kind, name in ((layers.float, VALUES), (layers.float_color, COLORS)):
        if kind.get(name) is None:
            kind.new(name)  # this invalidates all references to elements
    numbers, colored = layers.float[VALUES], layers.float_color[COLORS]
    for vertex, value, shade in zip(bm.verts, values.tolist(), shades.tolist()):
        vertex[numbers] = value
        vertex[colored] = shade
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    mesh.color_attributes.active_color = mesh.color_attributes[COLORS]


def _shade(space):
    if space is not None and space.type == "VIEW_3D":
        space.shading.type = "SOLID"
        space.shading.color_type = "VERTEX"


def register():
    bpy.utils.register_class(MESH_OT_show_curvature)


def unregister():
    bpy.utils.unregister_class(MESH_OT_show_curvature)
