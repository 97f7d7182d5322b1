# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs searches that may take long, shows their progress, and cancels them with ESC.

Blender handles no key while an operator runs. So an operator that the user starts searches in its own thread and polls
it with a timer. Scripts and the redo panel have to wait, so they search in the calling thread.
"""

import threading
from functools import partial
from typing import TYPE_CHECKING, Any

import bpy

from ..core import messages, native
from ..mesh.surface_cache import are_current

_WITHOUT_TIMER = 0.3  # seconds; a shorter search needs no timer, and nothing flickers
_INTERVAL = 0.1  # seconds between two polls of a search


class Cancelled(Exception):
    """The user has canceled a search."""


class BackgroundSearch:
    """Runs a search in its own thread: a function that takes a progress callback and does not use bpy."""

    def __init__(self, search):
        self.fraction = 0.0  # done
        self._search = search
        self._canceled = threading.Event()
        self._error = None
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def cancel(self):
        """Let the search end the next time it reports its progress."""
        self._canceled.set()

    def wait(self, seconds=None):
        """Wait for at most so many seconds. Return whether the search has ended."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def finish(self):
        """Wait for the end. Raise the exception of the search, or Cancelled if it was canceled."""
        self.wait()
        if self._error:
            raise self._error

    def _run(self):
        try:
            self._search(self._progress)
        except Exception as error:  # raised again in the waiting thread
            self._error = error

    def _progress(self, fraction):
        if self._canceled.is_set():
            raise Cancelled
        self.fraction = fraction
        return True


class SearchOperator:
    """An operator in three steps, which pass on a list of tasks.

    read(context)                        reads the meshes into tasks, each with its `obj` and `surface`
    optimize(tasks, settings, progress)  searches, without bpy and the operator: a static method
    apply(context, tasks)                writes the meshes, informs the user and returns the operator's result

    settings() returns the argument of `optimize`; conclude(context, level, message) tells the user why nothing changed.
    The operator releases the tasks at the end, since Blender keeps it alive for the redo panel.
    """

    if TYPE_CHECKING:  # defined by the operator
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
        noninteractive = bpy.app.background or context.window is None
        if noninteractive or native.problem():
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
            self._search.cancel()  # without waiting for its end
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
        """Stop the search when Blender ends the operator, for example because another file is opened."""
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
