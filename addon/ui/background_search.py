# SPDX-License-Identifier: GPL-3.0-or-later
"""Searches that may take long: with their progress shown, and canceled with ESC.

Blender hears no key while an operator runs. So an operator that the user starts searches in a thread of its own, and
waits for it by a timer; scripts and the redo panel, which have to wait, search in the thread they call from.
"""

import threading
from functools import partial
from typing import TYPE_CHECKING, Any

import bpy

from ..core import messages, native
from ..mesh.surface_cache import are_current

_WITHOUT_TIMER = 0.3  # seconds; what is done sooner needs no timer, and nothing flickers
_INTERVAL = 0.1  # seconds between two looks at a search


class Cancelled(Exception):
    """The user has canceled a search."""


class BackgroundSearch:
    """A search in a thread of its own: a function that takes a progress callback and leaves bpy alone."""

    def __init__(self, search):
        self.fraction = 0.0  # done
        self._search = search
        self._canceled = threading.Event()
        self._error = None
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def cancel(self):
        """The search ends the next time that it tells of its progress."""
        self._canceled.set()

    def wait(self, seconds=None):
        """Whether the search has ended, after so many seconds at most."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def finish(self):
        """Waits for the end; raises what the search raised, Cancelled where it was canceled."""
        self.wait()
        if self._error:
            raise self._error

    def _run(self):
        try:
            self._search(self._progress)
        except Exception as error:  # for the thread that waits
            self._error = error

    def _progress(self, fraction):
        if self._canceled.is_set():
            raise Cancelled
        self.fraction = fraction
        return True


class SearchOperator:
    """An operator in three steps, with a list of tasks that passes from one to the next.

    read(context)                        reads the meshes into tasks, each with its `obj` and `surface`
    optimize(tasks, settings, progress)  searches, without bpy and the operator: a static method
    apply(context, tasks)                writes the meshes, tells the user and gives what the operator returns

    settings() gives what `optimize` takes; conclude(context, level, message) tells the user why nothing was changed.
    Afterwards nothing is kept: operators stay alive for the redo panel.
    """

    if TYPE_CHECKING:  # the operator's own
        bl_label: str
        read: Any
        optimize: Any
        apply: Any
        settings: Any
        conclude: Any
        _search: Any  # a BackgroundSearch while it runs

    def execute(self, context):
        problem = native.problem()
        if problem:
            return self.conclude(context, "ERROR", problem)
        tasks = self.read(context)
        manager = context.window_manager
        manager.progress_begin(0.0, 100.0)
        try:
            self.optimize(tasks, self.settings(), lambda fraction: manager.progress_update(100.0 * fraction) or True)
        finally:
            manager.progress_end()
        return self.apply(context, tasks)

    def invoke(self, context, event):
        nobody_could_press_a_key = bpy.app.background or context.window is None
        if nobody_could_press_a_key or native.problem():
            return self.execute(context)
        tasks = self.read(context)
        search = BackgroundSearch(partial(self.optimize, tasks, self.settings()))
        if search.wait(_WITHOUT_TIMER):
            search.finish()
            return self.apply(context, tasks)
        self._tasks, self._search = tasks, search
        self._timer = context.window_manager.event_timer_add(_INTERVAL, window=context.window)
        context.window_manager.progress_begin(0.0, 100.0)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self._search.cancel()  # nobody waits for its end
            self._end(context)
            return self.conclude(context, "INFO", messages.CANCELLED)
        if event.type == "TIMER":
            context.window_manager.progress_update(100.0 * self._search.fraction)
            context.workspace.status_text_set(f"{self.bl_label}: {self._search.fraction:.0%}    ESC: Cancel")
        if not self._search.wait(0.0):
            return {"RUNNING_MODAL"}
        tasks, search = self._end(context)
        search.finish()
        surfaces = [(task.obj, task.surface) for task in tasks if task.surface]
        if context.mode != "EDIT_MESH" or not are_current(surfaces):
            return self.conclude(context, "WARNING", messages.CHANGED_MEANWHILE)
        return self.apply(context, tasks)

    def cancel(self, context):
        """Blender ends the operator, as when another file is opened."""
        self._search.cancel()
        self._search.wait()
        self._end(context)

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        tasks, search = self._tasks, self._search
        self._tasks = self._search = self._timer = None
        return tasks, search
