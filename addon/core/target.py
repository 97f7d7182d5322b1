# SPDX-License-Identifier: GPL-3.0-or-later
"""What a package is for, against the system and the Python that it runs in. Needs no Blender."""

import platform
import sys

_SYSTEMS = {"linux": "Linux", "windows": "Windows", "macos": "macOS"}
_NAMES = {"win32": "windows", "darwin": "macos"}  # where Python has another name for a system
_MACHINES = {"x86_64": "x64", "amd64": "x64", "aarch64": "arm64"}


def mismatch(target):
    """Why a package cannot work here, in words; empty where it can.

    target: what the package is for, as in the name of its file: linux-x64-cp310-cp311
    """
    made_for, *pythons = target.replace("-cp", " cp").split()
    here, python = _platform(), f"cp{sys.version_info.major}{sys.version_info.minor}"
    if made_for == here and python in pythons:
        return ""
    return (
        f"This package is for {_system(made_for)} and Python {' or '.join(map(_version, pythons))}, "
        f"this Blender runs on {_system(here)} with Python {_version(python)}: "
        f"install the package whose name has {here} and {python}"
    )


def _platform():
    """This platform as Blender and the packages name it, such as linux-x64."""
    machine = platform.machine().lower()
    return f"{_NAMES.get(sys.platform, sys.platform)}-{_MACHINES.get(machine, machine)}"


def _system(name):
    system, _, machine = name.partition("-")
    return f"{_SYSTEMS.get(system, system)} {machine}"


def _version(python):
    """3.11 of cp311."""
    return f"{python[2]}.{python[3:]}"
