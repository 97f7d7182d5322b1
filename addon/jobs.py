# SPDX-License-Identifier: GPL-3.0-or-later
"""Searches that may take long: with their progress shown, and left with ESC.

Blender hears no key while an operator runs. So an operator that the user starts searches in a thread of its own, and
waits for it by a timer; scripts and the redo panel, which have to wait, search in the thread they call from.
"""

import threading

import bpy

from . import report

_PATIENCE = 0.3  # seconds; what is done sooner needs no timer, and nothing flickers
_INTERVAL = 0.1  # seconds between two looks at a search


class Cancelled(Exception):
    """The user has left a search."""


def share_of(progress, i, count):
    """The progress callback of the i-th of several searches; None stays None."""
    return progress and (lambda share: progress((i + share) / count))


class Job:
    """A search in a thread of its own: a function that takes a progress callback and leaves bpy alone."""

    def __init__(self, search):
        self.share = 0.0  # done
        self._search = search
        self._left = threading.Event()
        self._error = None
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def cancel(self):
        """Leaves the search, which ends the next time that it tells of its progress."""
        self._left.set()

    def wait(self, seconds=None):
        """Whether the search has ended, after so many seconds at most."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def finish(self):
        """Waits for the end; raises what the search raised, Cancelled where it was left."""
        self.wait()
        if self._error:
            raise self._error

    def _run(self):
        try:
            self._search(self._progress)
        except Exception as error:  # for the thread that waits
            self._error = error

    def _progress(self, share):
        if self._left.is_set():
            raise Cancelled
        self.share = share
        return True


class SearchOperator:
    """An operator in three steps, with `work` for what passes from one to the next.

    prepare(context)       reads the meshes into work; None where it told the user that there is nothing to search
    search(work)           gives a function of a progress callback that does the work, without bpy and the operator
    apply(context, work)   writes the meshes, tells the user and gives what the operator returns

    is_current(context, work) says whether the meshes are still those that were read; give_up(context, level, message)
    tells the user why nothing was changed. Afterwards nothing is kept: operators stay alive for the redo panel.
    """

    def execute(self, context):
        work = self.prepare(context)
        if work is None:
            return {"CANCELLED"}
        manager = context.window_manager
        manager.progress_begin(0.0, 100.0)
        try:
            self.search(work)(lambda share: manager.progress_update(100.0 * share) or True)
        finally:
            manager.progress_end()
        return self.apply(context, work)

    def invoke(self, context, event):
        if bpy.app.background or context.window is None:  # nobody could press a key
            return self.execute(context)
        work = self.prepare(context)
        if work is None:
            return {"CANCELLED"}
        job = Job(self.search(work))
        if job.wait(_PATIENCE):
            job.finish()
            return self.apply(context, work)
        self._work, self._job = work, job
        self._timer = context.window_manager.event_timer_add(_INTERVAL, window=context.window)
        context.window_manager.progress_begin(0.0, 100.0)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self._job.cancel()  # nobody waits for its end
            self._end(context)
            return self.give_up(context, "INFO", report.CANCELLED)
        if event.type == "TIMER":
            context.window_manager.progress_update(100.0 * self._job.share)
            context.workspace.status_text_set(f"{self.bl_label}: {self._job.share:.0%}    ESC: Cancel")
        if not self._job.wait(0.0):
            return {"RUNNING_MODAL"}
        work, job = self._end(context)
        job.finish()
        if not self.is_current(context, work):
            return self.give_up(context, "WARNING", report.CHANGED_MEANWHILE)
        return self.apply(context, work)

    def cancel(self, context):
        """Blender ends the operator, as when another file is opened."""
        self._job.cancel()
        self._job.wait()
        self._end(context)

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        work, job = self._work, self._job
        self._work = self._job = self._timer = None
        return work, job
