# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that users see, as one table, and what they mean to the native module. Needs no Blender.

The defaults are those that land closest to where people draw part boundaries.
"""

import math
from typing import Any

# Each row is what a property of bpy.props takes, so that operators and documents share one wording and one default.
# Lengths are measured in the mesh's own space; weights have no unit.
SETTINGS: dict[str, dict[str, Any]] = {
    "width": {
        "name": "Width",
        "description": "How many rings of faces to each side of the loop are searched at most",
        "default": 8,
        "min": 1,
        "max": 64,
    },
    "whole_surface": {
        "name": "Whole Surface",
        "description": "Search as far as the surface goes, instead of a number of rings",
        "default": False,
    },
    "reach": {
        "name": "Reach",
        "description": "From the third ring on, search no farther from the loop than this share of the part's average "
        "radius, so that fine and coarse meshes behave alike; 0: as far as the rings go",
        "default": 0.16,
        "min": 0.0,
        "soft_max": 2.0,
    },
    "refinement": {
        "name": "Refinement",
        "description": "How many points on each edge the contour may pass through besides its ends, so that it runs "
        "across faces; 0: along edges only, so that no face is ever cut",
        "default": 0,
        "min": 0,
        "soft_max": 5,
        "max": 16,
    },
    "regular_iterations": {
        "name": "Along Edges First",
        "description": "With refinement: how often to search along edges before searching across faces",
        "default": 2,
        "min": 0,
        "max": 64,
    },
    "iterations": {
        "name": "Iterations",
        "description": "How often to search again from the contour found; ends early where nothing moves",
        "default": 2,
        "min": 1,
        "max": 64,
    },
    "length_bias": {
        "name": "Short",
        "description": "How much a short contour is preferred to a deep one; 0: depth alone counts",
        "default": 2.0,
        "min": 0.0,
        "soft_max": 10.0,
    },
    "length_floor": {
        "name": "Shortest",
        "description": "Below this share of the given loop's length nothing is gained by being shorter, "
        "so that no contour slides onto a tip",
        "default": 0.5,
        "min": 0.0,
        "max": 1.0,
    },
    "anchor": {
        "name": "Stay Near",
        "description": "How strongly the contour is held near the given loop: a far crease must be worth the way",
        "default": 0.5,
        "min": 0.0,
        "soft_max": 10.0,
    },
    "crease": {
        "name": "Creases",
        "description": "How strongly crisp concave edges pull the contour onto themselves, and convex ones push it off",
        "default": 0.5,
        "min": 0.0,
        "soft_max": 10.0,
    },
    "feature_clamp": {
        "name": "Even Depth",
        "description": "Depth counts up to this quantile of what is found near the loop, so that one deep crease does "
        "not outweigh a whole boundary; 1: all of it",
        "default": 0.9,
        "min": 0.01,
        "max": 1.0,
    },
    "min_salience": {
        "name": "Least Salience",
        "description": "Leave the loop as it is where the best contour found is less salient than this: "
        "there is nothing concave to find; 0: always move it",
        "default": 0.25,
        "min": 0.0,
        "soft_max": 3.0,
    },
    "max_turn": {
        "name": "Sharpest Turn",
        "description": "Contours do not turn more than this within the surface. A little above a right angle lets them "
        "climb quads in stairs",
        "default": math.radians(100.0),
        "min": math.radians(10.0),
        "max": math.pi,
        "subtype": "ANGLE",
    },
    "flow": {
        "name": "Flow",
        "description": "What tells the search which way is forward along the loop",
        "items": (
            ("HARMONIC", "Harmonic", "As heat would flow round the band; does not depend on where the loop starts"),
            ("GATES", "Gates", "Short segments across the band keep the curves along it in step"),
            ("ARC_LENGTH", "Arc Length", "Each curve along the band advances by its own length"),
        ),
        "default": "HARMONIC",
    },
    "ends": {
        "name": "Ends",
        "description": "What stays where it is at the ends of an open chain",
        "items": (
            ("EDGES", "Edges", "The first and the last edge, so that the chain leaves its ends as it was drawn"),
            ("VERTICES", "Vertices", "The end vertices alone"),
            ("BORDER", "Slide on Border", "The end vertices; but those on the border of the mesh slide along it"),
        ),
        "default": "EDGES",
    },
}

# Where the ends of a network's chains may go is fixed: junctions stay, ends on the border slide along it.
NETWORK = tuple(name for name in SETTINGS if name != "ends")

_MARKS = (
    ("SEAM", "Seam", "Edges marked as UV seams"),
    ("SHARP", "Sharp", "Edges marked as sharp"),
    ("CREASE", "Crease", "Edges with a subdivision crease"),
)

# What contours keep to besides being good; rows as above. Names are those of the mesh's own layers.
CONSTRAINTS: dict[str, dict[str, Any]] = {
    "required_group": {
        "name": "Required",
        "description": "Vertex group with the vertices that the contour must pass: those with a weight above 0",
        "default": "",
    },
    "barrier_marks": {
        "name": "Barrier Edges",
        "description": "Marked edges that no contour crosses. Marks along the given contour do not count: they move",
        "items": _MARKS,
        "default": set(),
        "options": {"ENUM_FLAG"},
    },
    "attractor_group": {
        "name": "Attractors",
        "description": "Vertex group that draws the contour onto its vertices, by their weights",
        "default": "",
    },
    "attractor_marks": {
        "name": "Attracting Edges",
        "description": "Marked edges that draw the contour onto themselves. Marks along the given contour do not count",
        "items": _MARKS,
        "default": set(),
        "options": {"ENUM_FLAG"},
    },
    "attractor_strength": {
        "name": "Strength",
        "description": "How strongly attractors of weight 1 pull, in average curvatures near the contour: a boundary "
        "is about as strong as 2; below 0: push off",
        "default": 5.0,
        "soft_min": -20.0,
        "soft_max": 20.0,
    },
    "attractor_radius": {
        "name": "Radius",
        "description": "How far along the surface an attractor is felt, in average edge lengths of the given contour",
        "default": 3.0,
        "min": 0.1,
        "soft_max": 20.0,
    },
    "region_source": {
        "name": "Region",
        "description": "A painted region whose border draws a closed contour",
        "items": (
            ("NONE", "None", "No region"),
            ("GROUP", "Vertex Group", "The weights of a vertex group"),
            ("ATTRIBUTE", "Face Attribute", "The values of a face attribute of floats, integers or booleans"),
            ("COLOR", "Color", "The brightness of a color attribute"),
        ),
        "default": "NONE",
    },
    "region_layer": {
        "name": "Layer",
        "description": "The name of the vertex group, face attribute or color attribute",
        "default": "",
    },
    "region_strength": {
        "name": "Strength",
        "description": "How strongly the contour takes painted faces to the side that has more of them, in face mode "
        "to that of the selected faces; below 0: leaves them to the other side",
        "default": 10.0,
        "soft_min": -100.0,
        "soft_max": 100.0,
    },
}

# Named settings that suit a kind of work; what a preset does not name takes the user's default.
PRESETS: dict[str, tuple[str, str, dict[str, Any]]] = {
    "DEFAULT": ("Default", "What lands closest to where people draw part boundaries", {}),
    "NEAR": ("Tidy Up", "Only straighten the contour within a few rings of where it is", {"width": 3, "anchor": 2.0}),
    "FAR": (
        "Look Far",
        "Search far from a very rough contour, and search again",
        {"width": 24, "reach": 0.5, "iterations": 4, "anchor": 0.1},
    ),
    "HARD": ("Hard Surface", "Keep to the crisp concave edges of a mechanical part", {"crease": 3.0, "anchor": 0.2}),
    "SMOOTH": (
        "Across Faces",
        "A smooth contour that runs across faces, which are then cut",
        {"refinement": 2, "regular_iterations": 2},
    ),
    "ALWAYS": (
        "Always Move",
        "Also move where there is hardly anything concave",
        {"min_salience": 0.0, "length_bias": 4.0},
    ),
}

# Besides width and reach; the others are for those who look for them.
MAIN = (
    "refinement",
    "iterations",
    "length_bias",
    "anchor",
)
MORE = (
    "length_floor",
    "crease",
    "feature_clamp",
    "min_salience",
    "max_turn",
    "flow",
    "ends",
    "regular_iterations",
)


def split(settings):
    """Settings of both tables as two: those of SETTINGS and whatever else there is, and those of CONSTRAINTS."""
    constraints = {name: value for name, value in settings.items() if name in CONSTRAINTS}
    return {name: value for name, value in settings.items() if name not in CONSTRAINTS}, constraints


def preset_values(identifier, defaults=()):
    """All settings of the table as a preset has them, with the user's own defaults where given."""
    values = {name: row["default"] for name, row in SETTINGS.items()}
    own = {name: value for name, value in dict(defaults).items() if name in SETTINGS}
    return values | own | PRESETS[identifier][2]


def native_options(**settings):
    """The keyword arguments of mrcontour.Options for settings of the table; the others take the table's defaults."""
    _refuse_unknown(settings, SETTINGS)
    values = {name: row["default"] for name, row in SETTINGS.items()} | settings
    plain = ("refinement", "iterations", "length_bias", "length_floor", "anchor", "crease", "max_turn")
    return {name: values[name] for name in plain} | {
        "width": None if values["whole_surface"] else values["width"],
        "band_distance": values["reach"] if values["reach"] > 0 and not values["whole_surface"] else None,
        "feature_clamp": values["feature_clamp"] if values["feature_clamp"] < 1 else None,
        "min_salience": values["min_salience"] if values["min_salience"] > 0 else None,
        "flow": values["flow"].lower(),
        "ends": values["ends"].lower(),
        "regular_iterations": values["regular_iterations"] if values["refinement"] > 0 else 0,
    }


def network_options(**settings):
    """The same for networks, which take the settings of NETWORK."""
    _refuse_unknown(settings, NETWORK)
    return native_options(ends="BORDER", **settings)


def _refuse_unknown(settings, known):
    unknown = sorted(settings.keys() - set(known))
    if unknown:
        raise TypeError(f"unknown settings: {', '.join(unknown)}; there are {', '.join(known)}")
