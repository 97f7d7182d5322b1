# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs steps in one Blender process and prints the state after each as a line of JSON:

blender -b --factory-startup --python-exit-code 1 --python tests/packages/in_blender.py -- STEP...
python tests/packages/in_blender.py -- STEP...                  with an installed bpy wheel

A step is the path of a package to install and enable, or one of: look, uninstall, enable, disable, attempt. After a
colon, enable and disable may name another copy of the add-on; attempt names a package to install, which may fail.
"""

import importlib
import json
import sys
from pathlib import Path
from zipfile import ZipFile

import bpy  # first: the bpy wheel makes the next module importable

# isort: split
import addon_utils

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))
from made_meshes import GROOVE, edit, grooved_cylinder, pairs, rough_loop, select  # noqa: E402

ID = "minimum_ratio_contours"


def module():
    """The name of the installed add-on's module, which differs between extensions and legacy add-ons; or None."""
    names = [found.__name__ for found in addon_utils.modules(refresh=True)]
    return next((name for name in names if name.rpartition(".")[2] == ID), None)


def install(package):
    with ZipFile(package) as content:
        names = content.namelist()
    if bpy.app.version >= (4, 2) and any(Path(name).name == "blender_manifest.toml" for name in names):
        bpy.ops.extensions.package_install_files(
            filepath=package, repo="user_default", enable_on_install=True, overwrite=True
        )
    else:
        bpy.ops.preferences.addon_install(filepath=package, overwrite=True)
        bpy.ops.preferences.addon_enable(module=names[0].partition("/")[0])


def attempt(package):
    """Installs a package, which may fail. Returns the error that the user sees, empty if there is none."""
    try:
        install(package)
    except RuntimeError as error:
        return str(error)
    return ""


def enable(name=None):
    bpy.ops.preferences.addon_enable(module=name or module())


def disable(name=None):
    bpy.ops.preferences.addon_disable(module=name or module())


def uninstall():
    if module() != ID:
        repositories = [repository.module for repository in bpy.context.preferences.extensions.repos]
        bpy.ops.extensions.package_uninstall(repo_index=repositories.index("user_default"), pkg_id=ID)
    else:
        window = bpy.context.window_manager.windows[0]
        with bpy.context.temp_override(window=window, area=window.screen.areas[0]):  # the operator redraws the area
            bpy.ops.preferences.addon_remove(module=ID)


def optimize():
    """Optimizes a rough loop beside a groove. Returns the message that the user sees, empty if it was moved."""
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(rough_loop(GROOVE - 3)))
    try:
        return "" if bpy.ops.mesh.optimize_contour() == {"FINISHED"} else "cancelled"
    except (AttributeError, RuntimeError) as error:
        return str(error)
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")


def state():
    """Whether the add-on is installed and enabled; what its operator says; which copy has registered that, and the
    versions of the copy and of its library; what each enabled copy notes."""
    enabled = [addon.module for addon in bpy.context.preferences.addons]
    operator = getattr(bpy.types, "MESH_OT_optimize_contour", None)
    found = {
        "installed": module() is not None,
        "enabled": any(name.rpartition(".")[2] == ID for name in enabled),
        "operator": operator is not None,
    }
    if operator:
        name = operator.__module__.removesuffix(".ui.operators")
        native = importlib.import_module(name + ".core.native")
        found |= {"module": name, "says": optimize(), "problem": native.problem(), "version": native.VERSION}
        library = sys.modules.get(name + ".mrcontour") or sys.modules.get("mrcontour")
        found["library"] = getattr(library, "__version__", None)
        found["library_file"] = Path(getattr(library, "__file__", "")).as_posix()
    copies = {name: sys.modules.get(name + ".ui.second_copy") for name in enabled}
    return found | {"notes": {name: copy.note() for name, copy in copies.items() if copy}}


STEPS = {"look": lambda: None, "enable": enable, "disable": disable, "uninstall": uninstall, "attempt": attempt}
for step in sys.argv[sys.argv.index("--") + 1 :]:
    action, *names = step.split(":")
    said = STEPS[action](*names) if action in STEPS else install(step)
    print("STATE " + json.dumps(state() | {"said": said}), flush=True)
