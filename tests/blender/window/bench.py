# SPDX-License-Identifier: GPL-3.0-or-later
"""Times the modal operator's steps on a million triangles against the native calls within them.

xvfb-run -a -s "-screen 0 1600x1000x24" env LIBGL_ALWAYS_SOFTWARE=1 blender --factory-startup --python \
    tests/blender/window/bench.py
"""

import os
import sys
import traceback
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
import addon_module  # noqa: E402

addon_module.enable()

from bench_meshes import GROOVE, grooved_tube, milliseconds, square  # noqa: E402
from made_meshes import edit, pairs, select  # noqa: E402
from minimum_ratio_contours import api  # noqa: E402
from minimum_ratio_contours.core import native, parameters, preview, preview_state  # noqa: E402
from minimum_ratio_contours.mesh import contour_tasks  # noqa: E402
from minimum_ratio_contours.ui import overlay  # noqa: E402

LIMIT = 1000  # faces of a band
STEPS = ["WIDER", "SHORTER", "NARROWER", "LONGER"] * 25


def begin(obj):
    """Do what the operator does before its first frame."""
    task = contour_tasks.read_task(obj, False)
    arrays, surface = api.arrays_and_surface_of(obj)
    return preview.Preview(arrays, surface, task.sound())


def step(shown, state):
    """Do what the operator does at every change, up to the arrays on the GPU."""
    shown.search(state)
    overlay._Batches(shown.shapes(state))


class TimedModule:
    """Wraps the native module and measures the time of its calls."""

    def __init__(self, module):
        self._module, self.taken = module, 0.0

    def __getattr__(self, name):
        def call(*arguments, **keywords):
            taken, result = milliseconds(getattr(self._module, name), *arguments, **keywords)
            self.taken += taken
            return result

        return call


def measure():
    obj = grooved_tube()
    edit(obj)
    select(obj, pairs(square(GROOVE - 10, 100, 25)))
    first, shown = milliseconds(begin, obj)
    print(f"{len(obj.data.polygons)} triangles, before the first frame: {first:.0f} ms")
    timed = TimedModule(native.module())
    native.module = lambda: timed
    for refinement in (0, 1, 2):
        measure_steps(shown, timed, refinement)


def measure_steps(shown, timed, refinement):
    settings = {name: row["default"] for name, row in parameters.SETTINGS.items()}
    settings |= {"reach": 0.0, "width": 1, "refinement": refinement}
    state, rows = preview_state.State.start(settings, "SELECT"), []
    for command in STEPS:
        state, timed.taken = preview_state.changed(state, command), 0.0
        whole, _ = milliseconds(step, shown, state)
        rows.append((len(shown.bands[0]), whole, whole - timed.taken))
    faces, whole, outside = np.array(rows[1:]).T
    assert faces.max() <= LIMIT
    print(f"refinement {refinement}, bands of {faces.min():.0f} to {faces.max():.0f} faces:", end=" ")
    for name, values in (("a step", whole), ("; of it outside the native calls", outside)):
        print(f"{name} {np.median(values):.2f} ms (95 %: {np.percentile(values, 95):.2f})", end="")
    print()


def run():
    """Run one step, and exit explicitly: exceptions in timers leave Blender running."""
    status = 1
    try:
        measure()
        status = 0
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(status)


bpy.app.timers.register(run, first_interval=0.5)
