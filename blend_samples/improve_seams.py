# SPDX-License-Identifier: GPL-3.0-or-later
"""Moves all seams of a .blend file to the part boundaries nearby, and writes another file:

    blender -b --factory-startup --python blend_samples/improve_seams.py -- in.blend out.blend

It prints one line of JSON with the result of each seam. If anything fails, it writes no file, prints the error, also in
the JSON, and exits with 1. `-- --help` lists the settings, which are the add-on's own. The add-on may be installed as a
legacy add-on or as an extension, enabled or not.
"""

import argparse
import importlib
import json
import sys
import traceback
from pathlib import Path

import bpy  # first, since the bpy wheel adds the path of the next one

# isort: split
import addon_utils
import numpy as np

ADDON = "minimum_ratio_contours"  # as an extension it is called bl_ext.<repository>.minimum_ratio_contours


class Failure(Exception):
    """An error with a message for the user, printed instead of a traceback."""


def addon_module():
    """Enable the add-on for this run and return the full name of its package."""
    names = [module.__name__ for module in addon_utils.modules() if module.__name__.split(".")[-1] == ADDON]
    names.sort(key=lambda name: not addon_utils.check(name)[1])  # an enabled one comes first
    for name in names:
        if addon_utils.check(name)[1] or addon_utils.enable(name):
            return name
    raise Failure(f"the add-on {ADDON} is not installed" if not names else f"{names[0]} could not be enabled")


def read_arguments(settings):
    """Parse the command line. Return its arguments, and the settings among them by name."""
    parser = argparse.ArgumentParser(prog="improve_seams.py --", description="Moves seams to part boundaries.")
    parser.add_argument("input", type=Path, help="the .blend file to read")
    parser.add_argument("output", type=Path, help="the .blend file to write")
    parser.add_argument(
        "--object", action="append", metavar="NAME", help="only this object; may be given several times"
    )
    for name, row in settings.items():
        option, text = "--" + name.replace("_", "-"), row["description"].replace("%", "%%")
        if isinstance(row["default"], bool):
            parser.add_argument(option, dest=name, action="store_true", default=None, help=text)
        else:
            choices = [item[0] for item in row["items"]] if "items" in row else None
            parser.add_argument(option, dest=name, type=type(row["default"]), choices=choices, help=text)
    given = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    return given, {name: getattr(given, name) for name in settings if getattr(given, name) is not None}


def mesh_objects(names):
    """Return an object for each mesh of the file, or of the named objects; linked ones are left out as read-only."""
    missing = sorted(set(names or ()) - set(bpy.data.objects.keys()))
    if missing:
        raise Failure(f"there is no object named {', '.join(missing)}")
    of_mesh = {}
    for obj in bpy.data.objects:
        if obj.type == "MESH" and not (obj.library or obj.data.library) and (not names or obj.name in names):
            of_mesh.setdefault(obj.data.name, obj)
    return list(of_mesh.values())


def describe(result):
    """Return a native result as plain numbers and text."""
    points = np.asarray(result.positions)
    ends = np.roll(points, -1, axis=0) if result.closed else points[1:]
    return {
        "status": result.status,
        "reason": result.reason,
        "closed": result.closed,
        "salience": result.salience,
        "initial_ratio": result.initial_ratio,
        "ratio": result.ratio,
        "length": float(np.linalg.norm(ends - points[: len(ends)], axis=1).sum()),
    }


def improve(api, obj, settings):
    """Move the seams of one object, and return their results."""
    try:
        seams = [describe(seam) for seam in api.optimize_seams(obj, apply=True, **settings)]
        forget_old_seams(obj.data)
        return {"object": obj.name, "seams": seams}
    except ValueError as error:
        return {"object": obj.name, "seams": [], "error": str(error)}


def forget_old_seams(mesh):
    """Remove the copy of the seams that samples have for Blender 5.1. Releases after 3.4 keep it up to date."""
    if bpy.app.version < (3, 5, 0) and ".uv_seam" in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[".uv_seam"])


def run():
    """Process the file and write the other one if nothing failed. Return the summary to be printed."""
    name = addon_module()
    parameters = importlib.import_module(name + ".core.parameters")
    given, settings = read_arguments({setting: parameters.SETTINGS[setting] for setting in parameters.NETWORK})
    api = importlib.import_module(name + ".api")
    try:
        bpy.ops.wm.open_mainfile(filepath=str(given.input.resolve()), load_ui=False)
    except RuntimeError as error:
        raise Failure(str(error).strip()) from error
    objects = [improve(api, obj, settings) for obj in mesh_objects(given.object)]
    failed = [f"{found['object']}: {found['error']}" for found in objects if "error" in found]
    if not failed:
        bpy.ops.wm.save_as_mainfile(filepath=str(given.output.resolve()), copy=True)
    return {"input": str(given.input), "output": None if failed else str(given.output), "objects": objects} | (
        {"error": "; ".join(failed)} if failed else {}
    )


def main():
    try:
        summary = run()
        json.dumps(summary, allow_nan=False)
    except Failure as failure:
        summary = {"error": str(failure)}
    except Exception as error:  # otherwise Blender would go on and exit with 0
        traceback.print_exc()
        summary = {"error": f"{type(error).__name__}: {error}"}
    print(json.dumps(summary), flush=True)
    if "error" in summary:
        print(f"improve_seams.py: {summary['error']}", file=sys.stderr)
    return 1 if "error" in summary else 0


if __name__ == "__main__":
    sys.exit(main())
