# SPDX-License-Identifier: GPL-3.0-or-later
"""Enables the add-on for the tests, installed as a legacy add-on, as an extension or from a build folder."""

import importlib
import pkgutil
import sys

import bpy  # first, since the bpy wheel adds the path of the next one

# isort: split
import addon_utils

NAME = "minimum_ratio_contours"


def enable():
    """Enable the add-on and return its package, which tests import as minimum_ratio_contours even for an extension."""
    names = [module.__name__ for module in addon_utils.modules() if module.__name__.split(".")[-1] == NAME]
    if len(names) != 1:
        sys.exit(f"the add-on {NAME} should be installed exactly once; found: {names}")
    bpy.ops.preferences.addon_enable(module=names[0])
    package = importlib.import_module(names[0])
    if package.__name__ != NAME:
        _give_short_names(package)
    return package


def _give_short_names(package):
    """Register the modules under both names: importing them twice would duplicate classes and caches."""
    for found in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        importlib.import_module(found.name)
    for name, module in list(sys.modules.items()):
        if name == package.__name__ or name.startswith(package.__name__ + "."):
            sys.modules[NAME + name.removeprefix(package.__name__)] = module
