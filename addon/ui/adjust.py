# SPDX-License-Identifier: GPL-3.0-or-later
"""The modal operator: band and contour over the mesh while wheel, keys and clicks change what is searched."""

from contextlib import contextmanager

import bpy
from bpy.props import CollectionProperty, IntProperty
from bpy_extras import view3d_utils

from ..core import messages, native, preview_state, search
from ..core.native_constraints import OutsideBand
from ..core.preview import Preview
from ..core.preview_state import CANCEL, CONFIRM, IGNORE, PASS, PIN, State
from ..mesh import contour_tasks, culprits
from . import panels
from .operators import (
    ContourConstraints,
    ContourOutput,
    ContourSettings,
    Folds,
    InEditMode,
    in_face_mode,
    properties_of,
)


class ContourPin(bpy.types.PropertyGroup):
    """A vertex that the contour must pass."""

    contour: IntProperty(name="Contour", description="The contour's place among those selected")
    vertex: IntProperty(name="Vertex", description="The vertex's index")


_SOON = 0.001  # seconds
_SHARED = properties_of(ContourSettings, ContourConstraints, ContourOutput)  # with Optimize Contour


def _not_kept(kinds):
    """These properties, to start from the panel's settings each time instead of from the last run's."""
    return {name: kind.function(**(kind.keywords | {"options": _skipped(kind)})) for name, kind in kinds.items()}


def _skipped(kind):
    return kind.keywords.get("options", set()) | {"SKIP_SAVE"}


class MESH_OT_adjust_contour(ContourSettings, ContourConstraints, ContourOutput, Folds, InEditMode, bpy.types.Operator):
    """Show band and contour while the wheel changes the width; clicks pin vertices that the contour must pass"""

    bl_idname = "mesh.adjust_contour"
    bl_label = "Adjust Contour"
    bl_options = {"REGISTER", "UNDO"}
    __annotations__ = _not_kept(_SHARED) | {
        "pins": CollectionProperty(
            name="Pins",
            description="Vertices that the contours must pass",
            type=ContourPin,
            options={"HIDDEN", "SKIP_SAVE"},
        )
    }

    def execute(self, context):
        if not self._begin(context):
            return {"CANCELLED"}
        self._search()
        return self._finish(context)

    def invoke(self, context, event):
        if context.area is None or context.area.type != "VIEW_3D":
            return self.conclude(context, "WARNING", messages.NO_VIEW)
        self._take_panel_settings(context)
        if not self._begin(context):
            return {"CANCELLED"}
        from . import overlay  # needs a graphics card, which a Blender without windows has not

        self._area, self._timer = context.area, None
        self._overlay = overlay.Overlay()
        with self._nothing_left_behind(context):
            self._show()
            self._say()
            context.workspace.status_text_set(_draw_keys)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        with self._nothing_left_behind(context):
            return self._react(context, event)

    def _react(self, context, event):
        command = preview_state.command_of(event.type, event.shift, event.ctrl, event.alt)
        if event.type == "TIMER" or command in (CONFIRM, PIN):
            self._catch_up(context)
        if command == PASS:
            return {"PASS_THROUGH"}
        if event.value != "PRESS" or command == IGNORE:
            return {"RUNNING_MODAL"}
        if command == CANCEL:
            self.cancel(context)
            return {"CANCELLED"}
        if command == CONFIRM:
            return self._confirm(context)
        state = self._pinned(event) if command == PIN else preview_state.changed(self._state, command)
        if state is not self._state:
            self._step(context, state)
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        """Takes away all that was shown; Blender calls it too, where the window is closed."""
        self._stop_timer(context)
        self._overlay.remove()
        self._area.header_text_set(None)
        context.workspace.status_text_set(None)

    @contextmanager
    def _nothing_left_behind(self, context):
        """Blender ends an operator that fails without a word to it."""
        try:
            yield
        except Exception:
            self.cancel(context)
            raise

    def draw(self, context):
        panels.draw_redo(self.layout, self, context.object)

    def _begin(self, context):
        """Reads selection and meshes, once; says why where there is nothing to adjust."""
        problem = native.problem()
        if problem:
            self.conclude(context, "ERROR", problem)
            return False
        objects = context.objects_in_mode_unique_data
        self._tasks = contour_tasks.read_tasks(objects, in_face_mode(context), self.close, self.constraints())
        self._previews = _previews(self._tasks)
        if not self._previews:
            outcomes = [outcome for task in self._tasks for outcome in task.outcomes]
            self.conclude(context, "WARNING", messages.summary(outcomes), outcomes)
            return False
        self._state = State.start(self.settings(), self.output, [(pin.contour, pin.vertex) for pin in self.pins])
        return True

    def _search(self):
        """Searches all contours with the state's settings; where that cannot be done, `_problem` says why."""
        self._outside = {}  # by object, required vertices where nothing is searched
        self._problem = messages.pins_outside(self._state.stray_pins(self._contour_count()))
        for obj, preview in self._previews:
            try:
                preview.search(self._state)
            except ValueError as error:
                pins_outside = preview.pins_outside(self._state)
                self._problem = messages.unsearchable(error, pins_outside)
                if isinstance(error, OutsideBand) and not pins_outside:
                    self._outside[obj] = error.elements

    def _step(self, context, state):
        """Goes on with other settings or pins; one command changes one thing, and the output needs no search.

        Blender hands a timer's event over after all those that came before it. So what piles up during a long search
        is searched once, with the last settings.
        """
        search = state.output == self._state.output
        self._state = state
        if not search:
            self._say()
        elif self._timer is None:
            self._timer = context.window_manager.event_timer_add(_SOON, window=context.window)

    def _catch_up(self, context):
        """Searches where the settings have changed since the last search."""
        if self._timer is not None:
            self._stop_timer(context)
            before, faces = self._shown, self._faces()
            self._show()
            self._say(held=preview_state.is_wider(self._state, before) and self._faces() == faces)

    def _stop_timer(self, context):
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None

    def _contour_count(self):
        return sum(len(preview.outcomes) for _, preview in self._previews)

    def _faces(self):
        """How many faces are searched."""
        return sum(len(band) for _, preview in self._previews for band in preview.bands)

    def _show(self):
        self._search()
        self._shown = self._state
        self._overlay.show([(obj.matrix_world.copy(), preview.shapes(self._state)) for obj, preview in self._previews])

    def _say(self, held=False):
        self._area.header_text_set(preview_state.header(self._state, self._output_name(), self._found(), held))

    def _found(self):
        outcomes = [outcome for _, preview in self._previews for outcome in preview.outcomes]
        return self._problem or messages.summary(outcomes)

    def _output_name(self):
        return self.properties.bl_rna.properties["output"].enum_items[self._state.output].name

    def _confirm(self, context):
        if self._problem:
            self.report({"WARNING"}, self._problem)
            return {"RUNNING_MODAL"}
        self.cancel(context)
        self._keep_settings(context)
        return self._finish(context)

    def _finish(self, context):
        tasks, outside = self._tasks, self._outside
        self._tasks, self._previews, self._outside = [], [], {}  # Blender keeps past operators: not their meshes too
        if outside:
            culprits.select(outside)
        if self._problem:
            return self.conclude(context, "WARNING", self._problem, changed=bool(outside))
        return self.apply(context, tasks)

    def _pinned(self, event):
        """The state after a click: the vertex under the mouse is pinned or unpinned."""
        hits = [hit for obj, preview in self._previews for hit in [_pick(self._area, event, obj, preview)] if hit]
        if not hits:
            return self._state
        _, contour, vertex = min(hits)
        return self._state.toggled(contour, vertex)

    def _take_panel_settings(self, context):
        last = context.window_manager.operator_properties_last(panels.OPERATOR)
        for name in _SHARED:
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(last, name))

    def _keep_settings(self, context):
        """In the operator's own properties for the redo panel, and in the sidebar's for the next run."""
        for name, value in (*self._state.settings.items(), ("output", self._state.output)):
            setattr(self, name, value)
        self.pins.clear()
        for contour, vertex in sorted(self._state.pins):
            pin = self.pins.add()
            pin.contour, pin.vertex = contour, vertex
        last = context.window_manager.operator_properties_last(panels.OPERATOR)
        for name in _SHARED:
            setattr(last, name, getattr(self, name))


def _previews(tasks):
    """A Preview of each mesh that has a contour to search, with its object; what is no contour gets its problem."""
    previews, count = [], 0
    for task in tasks:
        if task.surface is None:
            continue
        search.complete(task)
        search.find_problems(task, task.sound())
        if task.sound():
            previews.append((task.obj, Preview(task.arrays, task.surface, task.sound(), count, task.constraints)))
            count += len(task.sound())
    return previews


def _pick(area, event, obj, preview):
    """The hit of a click on a preview's bands; None outside the view or where another region lies over it."""
    inside = [region for region in area.regions if _holds(region, event.mouse_x, event.mouse_y)]
    if not inside or any(region.type != "WINDOW" for region in inside):
        return None
    region = inside[0]
    point = (event.mouse_x - region.x, event.mouse_y - region.y)
    origin = view3d_utils.region_2d_to_origin_3d(region, region.data, point)
    direction = view3d_utils.region_2d_to_vector_3d(region, region.data, point)
    to_object = obj.matrix_world.inverted_safe()
    return preview.pick(to_object @ origin, to_object.to_3x3() @ direction)


def _holds(region, x, y):
    return region.x <= x < region.x + region.width and region.y <= y < region.y + region.height and region.width > 1


_KEYS = (
    (("MOUSE_MMB",), "Width"),
    (("EVENT_E",), "Reach"),
    (("EVENT_W",), "Whole Surface"),
    (("EVENT_R",), "Refinement"),
    (("EVENT_S",), "Short"),
    (("EVENT_O",), "Output"),
    (("EVENT_SHIFT",), "R S O Back"),
    (("MOUSE_LMB",), "Pin"),
    (("EVENT_X",), "Unpin All"),
    (("EVENT_RETURN",), "Confirm"),
    (("EVENT_ESC", "MOUSE_RMB"), "Cancel"),
    (("MOUSE_MMB_DRAG",), "Rotate View"),
)


def _draw_keys(header, context):
    """The keys in the status bar."""
    row = header.layout.row(align=True)
    for icons, text in _KEYS:
        for icon in icons[:-1]:
            row.label(text="", icon=icon)
        row.label(text=text, icon=icons[-1])
        row.separator()


_CLASSES = (ContourPin, MESH_OT_adjust_contour)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
