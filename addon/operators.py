# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: they alone talk to the user."""

from dataclasses import dataclass

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from . import api, contours, mesh_access, native, panels, report
from .parameters import SETTINGS


class ContourSettings:
    """The properties of the settings table, for every operator that optimizes."""

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
        return {name: getattr(self, name) for name in SETTINGS}


class MESH_OT_optimize_contour(ContourSettings, bpy.types.Operator):
    """Move each selected closed loop to the part boundary nearby, where the surface is most concave for its length"""

    bl_idname = "mesh.optimize_contour"
    bl_label = "Optimize Contour"
    bl_options = {"REGISTER", "UNDO"}

    output: EnumProperty(
        name="Output",
        description="What becomes of the contour found; it is selected in any case",
        items=(
            ("SELECT", "Select", "Select it"),
            ("SEAM", "Seam", "Mark it as a UV seam"),
            ("SHARP", "Sharp", "Mark it as sharp edges"),
        ),
        default="SELECT",
    )
    keep_old: BoolProperty(
        name="Keep Old",
        description="Leave seams or sharp edges along the given loop where they are; otherwise they move with it",
        default=False,
    )

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
            return self._cancel(context, "ERROR", str(error))
        face_mode = tuple(context.tool_settings.mesh_select_mode) == (False, False, True)
        parts = optimize_selection(context.objects_in_mode_unique_data, face_mode, self.settings())
        outcomes = [outcome for part in parts for outcome in part.outcomes]
        if not outcomes:
            return self._cancel(context, "WARNING", report.NOTHING_SELECTED)
        message = report.summary(outcomes)
        if all(outcome.result is None for outcome in outcomes):
            return self._cancel(context, "WARNING", message)
        self._write(context, parts, face_mode)
        panels.show_result(context, message, outcomes)
        self.report({"WARNING" if any(outcome.problem for outcome in outcomes) else "INFO"}, message)
        return {"FINISHED"}

    def draw(self, context):
        panels.draw_settings(self.layout, self)
        panels.draw_more_settings(self.layout, self)

    def _write(self, context, parts, face_mode):
        if self.output != "SELECT":
            for part in parts:
                old_edges = [] if self.keep_old else part.old_edges()
                mesh_access.write_flags(part.obj.data, self.output.lower(), old_edges, part.new_edges())
        if self.output == "SEAM" and context.tool_settings.use_edge_path_live_unwrap:
            unwrap_live([part.obj.data for part in parts])
        if face_mode:
            use_edge_mode(context, parts)
        for part in parts:
            mesh_access.write_selection(part.obj.data, part.old_edges(), part.new_edges())

    def _cancel(self, context, level, message):
        panels.show_result(context, message, [])
        self.report({level}, message)
        return {"CANCELLED"}


@dataclass
class Part:
    """One object's share of the selection."""

    obj: bpy.types.Object
    outcomes: list

    def done(self):
        return [outcome for outcome in self.outcomes if outcome.result is not None]

    def old_edges(self):
        """The edges of the contours that have a result, as selected."""
        return _joined(outcome.edges for outcome in self.done())

    def new_edges(self):
        return _joined(contours.contour_edges(outcome.result.vertices) for outcome in self.done())

    def left_edges(self):
        return _joined(outcome.edges for outcome in self.outcomes if outcome.result is None)


def optimize_selection(objects, face_mode, settings):
    """A Part for each object, with an outcome for each connected piece of its selection. Writes nothing."""
    parts = []
    for obj in objects:
        mesh_access.synchronize(obj)
        selection = mesh_access.read_selection(obj, face_mode)
        pieces = contours.sort_edges(selection.edges)
        loops, loose = _without_loose(pieces.loops, selection.loose)
        outcomes = _optimize_loops(obj, objects, loops, settings) + _left(obj.name, pieces, loose)
        parts.append(Part(obj, outcomes))
    return parts


def _optimize_loops(obj, objects, loops, settings):
    try:
        surface = api.surface_of(obj, beside=objects) if loops else None
    except ValueError as error:
        return [report.Outcome(obj.name, contours.contour_edges(loop), problem=str(error)) for loop in loops]
    return [_optimize_loop(obj.name, surface, loop, settings) for loop in loops]


def _optimize_loop(place, surface, loop, settings):
    edges = contours.contour_edges(loop)
    try:
        return report.Outcome(place, edges, result=api.optimize_on(surface, loop, **settings))
    except ValueError as error:
        return report.Outcome(place, edges, problem=str(error))


def unwrap_live(meshes):
    """Blender's own seam tool unwraps again where Live Unwrap is on; with nothing selected that is all that it does."""
    selected = [mesh_access.clear_selection(mesh) for mesh in meshes]
    bpy.ops.mesh.mark_seam(clear=False)
    for mesh, elements in zip(meshes, selected, strict=True):
        mesh_access.restore_selection(mesh, elements)


def use_edge_mode(context, parts):
    """Faces cannot show a contour: go to edge mode, with the borders that were left as they are selected."""
    for part in parts:
        mesh_access.clear_selection(part.obj.data)
    context.tool_settings.mesh_select_mode = (False, True, False)
    for part in parts:
        mesh_access.set_edge_mode(part.obj.data)
        mesh_access.write_selection(part.obj.data, [], part.left_edges())


def _left(place, pieces, loose):
    """The outcomes of what cannot be optimized."""
    return (
        [report.Outcome(place, contours.contour_edges(loop), problem=report.loose(edges)) for loop, edges in loose]
        + [
            report.Outcome(place, contours.contour_edges(chain, closed=False), problem=report.open_chain(chain))
            for chain in pieces.chains
        ]
        + [
            report.Outcome(place, edges, problem=report.branching(contours.branch_vertices(edges)))
            for edges in pieces.branching
        ]
    )


def _without_loose(loops, loose_edges):
    """The loops along faces only, and the others with their loose edges."""
    is_loose = {frozenset(pair) for pair in loose_edges.tolist()}
    found = [[pair for pair in contours.contour_edges(loop).tolist() if frozenset(pair) in is_loose] for loop in loops]
    clean = [loop for loop, edges in zip(loops, found, strict=True) if not edges]
    return clean, [(loop, edges) for loop, edges in zip(loops, found, strict=True) if edges]


def _joined(edge_lists):
    edge_lists = list(edge_lists)
    return np.concatenate(edge_lists) if edge_lists else np.empty((0, 2), dtype=np.int32)


def register():
    bpy.utils.register_class(MESH_OT_optimize_contour)


def unregister():
    bpy.utils.unregister_class(MESH_OT_optimize_contour)
