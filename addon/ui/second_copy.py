# SPDX-License-Identifier: GPL-3.0-or-later
"""Two enabled copies of the add-on, such as a legacy add-on and an extension: only the first registers its commands.

Both have the same names, so the second would replace the operators of the first, and disabling either would remove
them. The second waits instead: all that it has is a note in its preferences. It takes over where the first is disabled.
"""

import sys

import addon_utils
import bpy

from .wrapped_text import draw_text

_ADDON = __package__.rpartition(".")[0]  # the name under which Blender knows this copy

_waiting = False


class WaitingPreferences(bpy.types.AddonPreferences):
    bl_idname = _ADDON

    def draw(self, context):
        draw_text(self.layout, context, note(), "ERROR")


def is_waiting():
    return _waiting


def note():
    """What this copy says where there are two; else empty."""
    if _waiting or _others_waiting():
        idle = "this" if _waiting else "the other"
        return f"This add-on is enabled twice, and {idle} copy does nothing: disable one of the two in the preferences"
    return ""


def wait_for_the_first():
    """If another copy has registered its commands, let this one wait. Return whether it waits."""
    global _waiting
    _waiting = _registered() not in ("", _ADDON)
    if _waiting:
        bpy.utils.register_class(WaitingPreferences)
        print(f"{_ADDON}: {note()}")
    return _waiting


def stop_waiting():
    """End the wait of this copy. Return whether it was waiting."""
    global _waiting
    if not _waiting:
        return False
    bpy.utils.unregister_class(WaitingPreferences)
    _waiting = False
    return True


def wake_another():
    """Let a waiting copy register its commands, now that those of this copy are gone."""
    for module in _others_waiting():
        addon_utils.enable(module.__name__)
        return


def _registered():
    """The name of the copy whose commands are registered; empty if there is none."""
    operator = getattr(bpy.types, "MESH_OT_optimize_contour", None)
    return operator.__module__.removesuffix(".ui.operators") if operator else ""


def _others_waiting():
    names = [addon.module for addon in bpy.context.preferences.addons if addon.module != _ADDON]
    own = __name__.removeprefix(_ADDON)
    found = {name: sys.modules.get(name + own) for name in names}
    return [sys.modules[name] for name, module in found.items() if module and module.is_waiting()]
