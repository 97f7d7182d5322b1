# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on in a real window, driven by simulated events; pictures of it go to a folder.

xvfb-run -a -s "-screen 0 1600x1000x24" env LIBGL_ALWAYS_SOFTWARE=1 blender --factory-startup \
    --window-geometry 0 0 1600 1000 --enable-event-simulate --python tests/blender/window/run.py -- PICTURES [WORD]

Every scenario is a generator: where it yields, Blender handles the events and draws. With a word only those run that
have it in their names.
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
bpy.context.preferences.system.viewport_aa = "OFF"  # otherwise the picture changes while samples accumulate

import scenarios  # noqa: E402
import scenarios_curvature  # noqa: E402
import scenarios_menus  # noqa: E402
import scenarios_sidebar  # noqa: E402
from driver import PAUSE, Window  # noqa: E402

MODULES = scenarios, scenarios_sidebar, scenarios_menus, scenarios_curvature


def run_all(pictures, word):
    window = Window(pictures)
    for name, scenario in (item for module in MODULES for item in vars(module).items()):
        if name.startswith("test_") and word in name:
            print(f"{name} ...", end=" ", flush=True)
            try:
                yield from window.fresh()
                yield from scenario(window)
                print("passed", flush=True)
            except Exception:  # run the other scenarios all the same
                traceback.print_exc()
                print("FAILED", flush=True)
                failed.append(name)
                yield from window.press("ESC", times=3)


def step():
    """Run one step, and exit explicitly: exceptions in timers leave Blender running."""
    try:
        next(running)
    except StopIteration:
        print(f"pictures in {pictures}; failed: {', '.join(failed) or 'none'}", flush=True)
        if failed:
            os._exit(1)
        bpy.ops.wm.quit_blender()
        return None
    except BaseException:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)
    return PAUSE


folder, word, *_ = [*sys.argv[sys.argv.index("--") + 1 :], ""]
pictures = Path(folder).resolve()
pictures.mkdir(parents=True, exist_ok=True)
failed = []
running = run_all(pictures, word)
bpy.app.timers.register(step, first_interval=0.5)
