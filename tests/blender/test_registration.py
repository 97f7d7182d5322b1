# SPDX-License-Identifier: GPL-3.0-or-later
"""Enabling the add-on registers everything, and disabling it removes everything."""

import inspect

import addon_utils
import bpy
import minimum_ratio_contours
import pytest
from minimum_ratio_contours.core import native

MODULE = minimum_ratio_contours.__name__  # longer where it is an extension


MENUS = (
    "VIEW3D_MT_edit_mesh",
    "VIEW3D_MT_edit_mesh_context_menu",
    "VIEW3D_MT_edit_mesh_edges",
    "VIEW3D_MT_edit_mesh_faces",
    "VIEW3D_MT_uv_map",
)


def entries(menu):
    """Return the add-on's functions that draw into one of Blender's menus."""
    functions = getattr(bpy.types, menu)._dyn_ui_initialize()
    return [function for function in functions if function.__module__.startswith(MODULE)]


def classes():
    """Return the names of the add-on's registered classes."""
    found = [getattr(bpy.types, name) for name in dir(bpy.types)]
    return {cls.__name__ for cls in found if getattr(cls, "__module__", "").startswith(MODULE)}


def traces():
    """Return whether classes, menu entries and the window manager's property exist."""
    return [bool(classes()), *(bool(entries(menu)) for menu in MENUS)] + [
        hasattr(bpy.types.WindowManager, "minimum_ratio_contours")
    ]


def test_disabling_removes_everything_and_enabling_restores_it():
    before = classes(), [len(entries(menu)) for menu in MENUS]
    assert all(traces())
    addon_utils.disable(MODULE)
    try:
        assert not any(traces())
        assert not classes()
    finally:
        addon_utils.enable(MODULE)
    assert all(traces())
    assert (classes(), [len(entries(menu)) for menu in MENUS]) == before


def test_operators_say_what_they_do_and_their_labels_fit_a_sidebar():
    """Blender itself adds the final period of a tooltip; a sidebar of the default width shows about 20 letters."""
    for name in classes():
        cls = getattr(bpy.types, name)
        if not issubclass(cls, (bpy.types.Operator, bpy.types.Panel, bpy.types.Menu)):
            continue
        assert 0 < len(cls.bl_label) <= 26, name
        if issubclass(cls, bpy.types.Operator):
            assert inspect.getdoc(cls), name
            assert not inspect.getdoc(cls).endswith("."), name
            for key, prop in cls.__annotations__.items():
                assert len(prop.keywords["name"]) <= 20, key


def settings():
    """Return the operator's current properties, which registering again replaces."""
    return bpy.ops.mesh.optimize_contour.get_rna_type().properties[1:]


@pytest.mark.parametrize("name", [prop.identifier for prop in settings()])
def test_every_setting_has_a_short_name_and_a_tooltip(name):
    (prop,) = (prop for prop in settings() if prop.identifier == name)
    assert 0 < len(prop.name) <= 18
    assert len(prop.description) > 10
    assert not prop.description.endswith(".")


def test_the_versions_agree():
    (found,) = (module for module in addon_utils.modules() if module.__name__ == MODULE)
    assert addon_utils.module_bl_info(found)["version"] == tuple(map(int, native.VERSION.split(".")))
    assert native.module().__version__ == native.VERSION
