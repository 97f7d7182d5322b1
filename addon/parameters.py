# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that users see, as one table, and what they mean to the native module. Needs no Blender."""

# Each row is what a property of bpy.props takes, so that operators and documents share one wording and one default.
SETTINGS = {
    "width": {
        "name": "Width",
        "description": "How many rings of faces to each side of the loop are searched",
        "default": 4,
        "min": 1,
        "max": 64,
    },
    "whole_surface": {
        "name": "Whole Surface",
        "description": "Search as far as the surface goes, instead of a number of rings",
        "default": False,
    },
    "iterations": {
        "name": "Iterations",
        "description": "How often to search again from the contour found; ends early where nothing moves",
        "default": 1,
        "min": 1,
        "max": 64,
    },
    "flow": {
        "name": "Flow",
        "description": "What tells the search which way is forward along the loop",
        "items": (
            ("GATES", "Gates", "Short segments across the band keep the curves along it in step"),
            ("ARC_LENGTH", "Arc Length", "Each curve along the band advances by its own length"),
            ("HARMONIC", "Harmonic", "As heat would flow round the band; does not depend on where the loop starts"),
        ),
        "default": "GATES",
    },
}


def native_options(**settings):
    """The keyword arguments of mrcontour.Options for settings of the table; the others take the table's defaults."""
    unknown = sorted(settings.keys() - SETTINGS.keys())
    if unknown:
        raise TypeError(f"unknown settings: {', '.join(unknown)}; there are {', '.join(SETTINGS)}")
    values = {name: row["default"] for name, row in SETTINGS.items()} | settings
    return {
        "width": None if values["whole_surface"] else values["width"],
        "iterations": values["iterations"],
        "flow": values["flow"].lower(),
    }
