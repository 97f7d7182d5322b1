# SPDX-License-Identifier: GPL-3.0-or-later
"""Minimum Ratio Contours: moves a rough edge loop to the part boundary nearby."""

import sys

bl_info = {
    "name": "Minimum Ratio Contours",
    "author": "Minimum Ratio Contours developers",
    "version": (0, 0, 0),  # packaging puts that of CMakeLists.txt here and in the manifest
    "blender": (3, 4, 0),
    "location": "Edit Mode > Sidebar > Contours, and Edge > Optimize Contour",
    "description": "Moves rough edge loops to the part boundaries nearby",
    "category": "Mesh",
}
VERSION = ".".join(map(str, bl_info["version"]))  # kept, since Blender deletes the bl_info of an extension

# An upgrade in a running Blender reloads this file alone: forget the others, so that they are loaded anew. The compiled
# module cannot be; core/native.py tells it from the version that belongs here.
for _name in [name for name in sys.modules if name.startswith(__name__ + ".") and not name.endswith(".mrcontour")]:
    del sys.modules[_name]
    globals().pop(_name.removeprefix(__name__ + "."), None)  # modules and folders beside this file


def _modules():
    # Imported here, not above: the modules that do without bpy can then be imported outside Blender.
    from .ui import adjust, menus, network_operators, operators, panels, preferences, presets
    from .ui import show_curvature as colors
    from .ui import show_directions as directions

    return operators, adjust, network_operators, colors, directions, panels, preferences, presets, menus


def register():
    from . import api  # noqa: F401  loaded with the add-on, for scripts

    for module in _modules():
        module.register()


def unregister():
    from .mesh import surface_cache

    for module in reversed(_modules()):
        module.unregister()
    surface_cache.forget()
