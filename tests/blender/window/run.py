# SPDX-License-Identifier: GPL-3.0-or-later
"""The modal operator in a real window, driven by simulated events; pictures of it go to a folder.

xvfb-run -a -s "-screen 0 1600x1000x24" env LIBGL_ALWAYS_SOFTWARE=1 blender --factory-startup \
    --window-geometry 0 0 1600 1000 --enable-event-simulate --python tests/blender/window/run.py -- PICTURES

Every scenario is a generator: where it yields, Blender handles the events and draws.
"""

import os
import sys
import traceback
from pathlib import Path

import bpy

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1])]
import addon_module  # noqa: E402

addon_module.enable()
bpy.context.preferences.view.show_splash = False
bpy.context.preferences.system.viewport_aa = "OFF"  # its samples add up while nothing moves

import scenarios  # noqa: E402
from driver import PAUSE, Window  # noqa: E402


def run_all(pictures):
    window = Window(pictures)
    for name, scenario in vars(scenarios).items():
        if name.startswith("test_"):
            print(f"{name} ...", end=" ", flush=True)
            yield from window.fresh()
            yield from scenario(window)
            print("passed", flush=True)


def step():
    """Exceptions in timers leave Blender running: end by hand."""
    try:
        next(running)
    except StopIteration:
        print(f"pictures in {pictures}")
        bpy.ops.wm.quit_blender()
        return None
    except BaseException:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)
    return PAUSE


pictures = Path(sys.argv[sys.argv.index("--") + 1]).resolve()
pictures.mkdir(parents=True, exist_ok=True)
running = run_all(pictures)
bpy.app.timers.register(step, first_interval=0.5)
