# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the compiled module `mrcontour`, or says in plain words why it cannot be used. Needs no Blender."""

import importlib
import sys
from pathlib import Path

from .. import TARGET, VERSION  # of the add-on; the compiled module must be of the same version
from . import target

_UNPACKAGED = "0.0.0"  # what the source says: it goes with any module
_ADDON = __package__.rpartition(".")[0]  # the add-on's own package, in whose folder a legacy add-on has the module


class Unavailable(RuntimeError):
    """The compiled module cannot be used; the message is meant for the user."""


def module():
    """The compiled module. Raises Unavailable with a message for the user."""
    found = _import()
    version = getattr(found, "__version__", "unknown")
    if version != VERSION != _UNPACKAGED:
        # A running Blender keeps the compiled module that it has once loaded, also when the add-on is upgraded.
        raise Unavailable(
            f"The add-on is version {VERSION}, its compiled library version {version}: "
            "restart Blender to complete the upgrade"
        )
    return found


def problem():
    """Why the compiled module cannot be used, in words; empty where it can."""
    try:
        module()
    except Unavailable as error:
        return str(error)
    return ""


def contours(items):
    """The native contours of outcomes or of chains."""
    mrc = module()
    return [mrc.Contour(item.vertices, closed=item.closed) for item in items]


def _import():
    """A legacy add-on has the module in its own folder, an extension in the wheels that it brings."""
    names = ((".mrcontour", _ADDON), ("mrcontour", None))
    try:
        for name, package in names:
            try:
                return importlib.import_module(name, package)
            except ModuleNotFoundError as error:
                if error.name not in ("mrcontour", f"{_ADDON}.mrcontour"):
                    raise
    except ImportError as error:
        reason = error.msg.partition("\n")[0]  # macOS lists every folder that it has searched
        raise Unavailable(_mismatch() or f"The compiled library does not load: {reason}") from error
    raise Unavailable(_mismatch() or _missing())


def _mismatch():
    return target.mismatch(TARGET) if TARGET else ""


def _missing():
    python = f"Python {sys.version_info.major}.{sys.version_info.minor}"
    if TARGET:
        return "The compiled library is missing from this package: install it again"
    built = sorted(path.name for path in Path(__file__).parents[1].glob("mrcontour*") if path.suffix in (".so", ".pyd"))
    if built:
        return (
            f"The compiled library was built for another Python ({built[0]}; this Blender has {python}): build it again"
        )
    return (
        "This copy of the add-on is its source, without the compiled library mrcontour: "
        f"install the package made for your system and {python}"
    )
