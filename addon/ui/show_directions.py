# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows the directions that contours prefer to follow: lines along the valleys of all meshes in Edit Mode.

Objects and meshes are looked up each time and never stored, since undo replaces them.
"""

import bpy

from ..core import curvature_directions, messages, native
from ..core.curvature_colors import full_size
from ..mesh.arrays import synchronize
from ..mesh.surface_cache import arrays_and_surface_of

_QUANTILE = 0.95  # the same as for the colors of the curvature
_DELAY = 0.3  # seconds without a change before the lines are computed again

_shown = None  # the overlay, while it is shown
_reading = False


def is_shown():
    return _shown is not None


class MESH_OT_show_curvature_directions(bpy.types.Operator):
    """Show the directions that contours prefer to follow as short lines along the valleys. The lines are updated as \
the mesh changes, and removed by running this again or leaving Edit Mode"""

    bl_idname = "mesh.show_curvature_directions"
    bl_label = "Show Curvature Directions"

    @classmethod
    def poll(cls, context):
        if bpy.app.background:
            cls.poll_message_set("Directions cannot be shown without a window")
            return False
        if context.mode == "EDIT_MESH":
            return True
        cls.poll_message_set("Directions are shown in Edit Mode of a mesh")
        return False

    def execute(self, context):
        if is_shown():
            remove()
            return {"FINISHED"}
        try:
            items, problems = read(_edited(context))
        except native.Unavailable as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        lines = sum(len(ends) // 2 for _, ends in items)
        self.report({"WARNING" if problems else "INFO"}, messages.directions_shown(lines, problems))
        if not lines:
            return {"CANCELLED"}
        _show(items)
        return {"FINISHED"}


def read(objects):
    """Return the matrix and the ends of the lines of each object, and the problems of objects that have no lines."""
    items, problems = [], []
    _synchronize(objects)
    for obj in objects:
        try:
            arrays, surface = arrays_and_surface_of(obj, beside=objects)
        except ValueError as error:
            problems.append(f"{obj.name}: {messages.problem(error)}")
            continue
        if surface.face_count:
            curvature = native.module().curvature(surface)
            full = full_size(curvature.kappa_min, _QUANTILE)
            items.append((obj.matrix_world.copy(), curvature_directions.segments(arrays, curvature, full)))
    return items, problems


def _synchronize(objects):
    """Synchronize the objects, and let the handlers ignore the updates that Blender reports because of it."""
    global _reading
    _reading = True
    try:
        for obj in objects:
            synchronize(obj)
        bpy.context.view_layer.update()
    finally:
        _reading = False


def remove():
    """Remove the lines and the handlers that update them."""
    global _shown
    if _shown is None:
        return
    _shown.remove()
    _shown = None
    for handlers, handler in _HANDLERS:
        handlers.remove(handler)
    if bpy.app.timers.is_registered(_refresh):
        bpy.app.timers.unregister(_refresh)


def _show(items):
    global _shown
    from . import overlay  # needs a GPU, which Blender does not have in background mode

    _shown = overlay.Overlay(overlay.Directions)
    _shown.show(items)
    for handlers, handler in _HANDLERS:
        handlers.append(handler)


def _edited(context):
    """Return one object of each mesh in Edit Mode; timers and handlers have no window whose context would list them."""
    objects = [obj for obj in context.view_layer.objects if obj.type == "MESH" and obj.mode == "EDIT"]
    return list({obj.data: obj for obj in objects}.values())


def _updated(scene, depsgraph):
    """Hide the lines of a mesh as soon as it changes, and draw them again when it has stopped changing."""
    if _reading:
        return
    if not _edited(bpy.context):
        remove()
    elif any(_changes_lines(update) for update in depsgraph.updates):
        _postpone()


def _changes_lines(update):
    if isinstance(update.id, bpy.types.Mesh):
        return update.is_updated_geometry
    return isinstance(update.id, bpy.types.Object) and update.is_updated_transform


def _undone(scene):
    _postpone()


def _postpone():
    assert _shown is not None, "handlers exist only while lines are shown"
    _shown.show([])
    if bpy.app.timers.is_registered(_refresh):
        bpy.app.timers.unregister(_refresh)
    bpy.app.timers.register(_refresh, first_interval=_DELAY)


def _refresh():
    try:
        objects = _edited(bpy.context)
        if objects and _shown is not None:
            _shown.show(read(objects)[0])
        else:
            remove()
    except Exception:
        remove()
        raise


def _loading(path):
    remove()


_HANDLERS = (
    (bpy.app.handlers.depsgraph_update_post, _updated),
    (bpy.app.handlers.undo_post, _undone),
    (bpy.app.handlers.redo_post, _undone),
    (bpy.app.handlers.load_pre, _loading),
)


def register():
    bpy.utils.register_class(MESH_OT_show_curvature_directions)


def unregister():
    remove()
    bpy.utils.unregister_class(MESH_OT_show_curvature_directions)
