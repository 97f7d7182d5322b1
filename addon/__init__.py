# SPDX-License-Identifier: GPL-3.0-or-later
"""Minimum Ratio Contours: moves a rough edge loop to the part boundary nearby."""

import sys

bl_info = {
    "name": "Minimum Ratio Contours",
    "author": "Minimum Ratio Contours developers",
    # Packaging writes the version and the addresses in CMakeLists.txt here and into the manifest.
    "version": (0, 0, 0),
    "blender": (3, 4, 0),
    "location": "Edit Mode > Sidebar > Contours, and Edge > Optimize Contour",
    "description": "Moves rough edge loops to the part boundaries nearby",
    "doc_url": "",
    "tracker_url": "",
    "category": "Mesh",
}
VERSION = ".".join(map(str, bl_info["version"]))  # stored here because Blender deletes the bl_info of an extension
TARGET = ""  # packaging writes here what the package is for, such as linux-x64-cp311; the source is for none

# An upgrade in a running Blender reloads only this file: drop the others, so that they are loaded again. The compiled
# module cannot be reloaded; core/native.py checks its version.
for _name in [name for name in sys.modules if name.startswith(__name__ + ".") and not name.endswith(".mrcontour")]:
    del sys.modules[_name]
    globals().pop(_name.removeprefix(__name__ + "."), None)  # modules and folders next to this file


def _modules():
    # Imported here so that the modules without bpy can be imported outside Blender.
    from .ui import adjust, menus, network_operators, operators, panels, preferences, presets
    from .ui import show_curvature as colors
    from .ui import show_directions as directions

    return operators, adjust, network_operators, colors, directions, panels, preferences, presets, menus


def register():
    from . import api  # noqa: F401  for scripts, loaded with the add-on
    from .ui import second_copy

    if second_copy.wait_for_the_first():
        return
    for module in _modules():
        module.register()


def unregister():
    from .mesh import surface_cache
    from .ui import second_copy

    if second_copy.stop_waiting():
        return
    for module in reversed(_modules()):
        module.unregister()
    surface_cache.forget()
    second_copy.wake_another()
