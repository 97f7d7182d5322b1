# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of all settings that users see, and their conversion to native options. Does not need Blender.

The defaults are those whose contours come closest to where people draw part boundaries.
"""

import math
from typing import Any

# Each row has the arguments of a property of bpy.props, so that operators and documents share the wording and defaults.
# Lengths are measured in the mesh's own space; weights have no unit.
SETTINGS: dict[str, dict[str, Any]] = {
    "width": {
        "name": "Width",
        "description": "Largest number of rings of faces that are searched on each side of the loop",
        "default": 8,
        "min": 1,
        "max": 64,
    },
    "whole_surface": {
        "name": "Whole Surface",
        "description": "Search as far as the surface extends, instead of a number of rings",
        "default": False,
    },
    "reach": {
        "name": "Reach",
        "description": "From the third ring on, search no farther from the loop than this fraction of the part's "
        "average radius, so that fine and coarse meshes behave alike; 0: no limit",
        "default": 0.16,
        "min": 0.0,
        "soft_max": 2.0,
    },
    "refinement": {
        "name": "Refinement",
        "description": "Number of points on each edge, besides its ends, that the contour may pass through, so that it "
        "runs across faces, which are then cut; 0: along edges only, and no face changes",
        "default": 0,
        "min": 0,
        "soft_max": 5,
        "max": 16,
    },
    "regular_iterations": {
        "name": "Along Edges First",
        "description": "With Refinement: how many times to search along edges before searching across faces",
        "default": 2,
        "min": 0,
        "max": 64,
    },
    "iterations": {
        "name": "Iterations",
        "description": "How many times to search, each time from the contour found last; ends early if nothing moves",
        "default": 2,
        "min": 1,
        "max": 64,
    },
    "length_bias": {
        "name": "Short",
        "description": "How strongly a short contour is preferred to a deep one; 0: only depth counts",
        "default": 2.0,
        "min": 0.0,
        "soft_max": 10.0,
    },
    "length_floor": {
        "name": "Shortest",
        "description": "Below this fraction of the given loop's length, being shorter gains nothing, "
        "so that no contour slides onto a tip",
        "default": 0.5,
        "min": 0.0,
        "max": 1.0,
    },
    "anchor": {
        "name": "Stay Near",
        "description": "How strongly the contour is held near the given loop, so that it moves far only for a "
        "clearly better boundary",
        "default": 0.5,
        "min": 0.0,
        "soft_max": 10.0,
    },
    "crease": {
        "name": "Creases",
        "description": "How strongly sharp concave edges attract the contour, and convex ones repel it",
        "default": 0.5,
        "min": 0.0,
        "soft_max": 10.0,
    },
    "feature_clamp": {
        "name": "Even Depth",
        "description": "Cut off concavity at this quantile near the loop, so that one deep crease does not outweigh a "
        "whole boundary; 1: cut off nothing",
        "default": 0.9,
        "min": 0.01,
        "max": 1.0,
    },
    "min_salience": {
        "name": "Least Salience",
        "description": "Leave the loop where it is if the best contour is less salient than this, since there is "
        "nothing concave to find; 0: move it anyway",
        "default": 0.25,
        "min": 0.0,
        "soft_max": 3.0,
    },
    "max_turn": {
        "name": "Sharpest Turn",
        "description": "Largest turn of a contour within the surface. Slightly above a right angle lets contours climb "
        "quads in stairs",
        "default": math.radians(100.0),
        "min": math.radians(10.0),
        "max": math.pi,
        "subtype": "ANGLE",
    },
    "flow": {
        "name": "Flow",
        "description": "How the search measures progress along the loop",
        "items": (
            ("HARMONIC", "Harmonic", "As heat flows around the band; independent of where the loop starts"),
            ("GATES", "Gates", "Short segments across the band keep the curves along it in step"),
            ("ARC_LENGTH", "Arc Length", "Along each curve of the band by its own length"),
        ),
        "default": "HARMONIC",
    },
    "ends": {
        "name": "Ends",
        "description": "What is held at the ends of an open chain",
        "items": (
            ("AUTO", "Automatic", "The first and last edges, but ends on the mesh border slide along it"),
            ("EDGES", "Edges", "The first and last edges, so that the chain keeps its direction at the ends"),
            ("VERTICES", "Vertices", "Only the end vertices"),
            ("BORDER", "Slide on Border", "The end vertices, but those on the mesh border slide along it"),
        ),
        "default": "AUTO",
    },
}

# A network has no choice of ends: junctions stay, and ends on the mesh border slide along it.
NETWORK = tuple(name for name in SETTINGS if name != "ends")

_MARKS = (
    ("SEAM", "Seam", "Edges marked as UV seams"),
    ("SHARP", "Sharp", "Edges marked as sharp"),
    ("CREASE", "Crease", "Edges with a subdivision crease"),
)

# The constraints that layers of the mesh put on contours; rows as above. Names are those of the layers.
CONSTRAINTS: dict[str, dict[str, Any]] = {
    "required_group": {
        "name": "Required",
        "description": "Vertex group; the contour passes every vertex with a weight above 0",
        "default": "",
    },
    "barrier_marks": {
        "name": "Barrier Edges",
        "description": "Marked edges that no contour crosses. Marks along the given contour are ignored: they move",
        "items": _MARKS,
        "default": set(),
        "options": {"ENUM_FLAG"},
    },
    "attractor_group": {
        "name": "Attractors",
        "description": "Vertex group that attracts the contour to its vertices, in proportion to their weights",
        "default": "",
    },
    "attractor_marks": {
        "name": "Attracting Edges",
        "description": "Marked edges that attract the contour. Marks along the given contour are ignored: they move",
        "items": _MARKS,
        "default": set(),
        "options": {"ENUM_FLAG"},
    },
    "attractor_strength": {
        "name": "Strength",
        "description": "How strongly attractors of weight 1 attract, in average curvatures near the contour; a part "
        "boundary attracts about as strongly as 2. Below 0: repel",
        "default": 5.0,
        "soft_min": -20.0,
        "soft_max": 20.0,
    },
    "attractor_radius": {
        "name": "Radius",
        "description": "How far along the surface an attractor acts, in average edge lengths of the given contour",
        "default": 3.0,
        "min": 0.1,
        "soft_max": 20.0,
    },
    "region_source": {
        "name": "Region",
        "description": "Painted region whose border attracts a closed contour",
        "items": (
            ("NONE", "None", "No region"),
            ("GROUP", "Vertex Group", "The weights of a vertex group"),
            ("ATTRIBUTE", "Face Attribute", "The values of a float, integer or boolean face attribute"),
            ("COLOR", "Color", "The brightness of a color attribute"),
        ),
        "default": "NONE",
    },
    "region_layer": {
        "name": "Layer",
        "description": "Name of the vertex group, face attribute or color attribute",
        "default": "",
    },
    "region_strength": {
        "name": "Strength",
        "description": "How strongly the contour takes painted faces to the side that has more of them, or in face "
        "mode to the side of the selected faces. Below 0: leaves them out",
        "default": 10.0,
        "soft_min": -100.0,
        "soft_max": 100.0,
    },
}

# Named settings for kinds of work; settings that a preset does not name take the user's defaults.
PRESETS: dict[str, tuple[str, str, dict[str, Any]]] = {
    "DEFAULT": ("Default", "The settings that come closest to where people draw part boundaries", {}),
    "NEAR": ("Tidy Up", "Only straighten the contour within a few rings of where it is", {"width": 3, "anchor": 2.0}),
    "FAR": (
        "Look Far",
        "Search far from a very rough contour, several times",
        {"width": 24, "reach": 0.5, "iterations": 4, "anchor": 0.1},
    ),
    "HARD": ("Hard Surface", "Follow the sharp concave edges of a mechanical part", {"crease": 3.0, "anchor": 0.2}),
    "SMOOTH": (
        "Across Faces",
        "A smooth contour that runs across faces, which are then cut",
        {"refinement": 2, "regular_iterations": 2},
    ),
    "ALWAYS": (
        "Always Move",
        "Move the contour even where hardly anything is concave",
        {"min_salience": 0.0, "length_bias": 4.0},
    ),
}

# The settings always shown, besides width and reach, and those under More Settings.
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
    """Split settings into those of CONSTRAINTS, returned second, and all others, returned first."""
    constraints = {name: value for name, value in settings.items() if name in CONSTRAINTS}
    return {name: value for name, value in settings.items() if name not in CONSTRAINTS}, constraints


def preset_values(identifier, defaults=()):
    """Return all settings as a preset has them; `defaults` are the user's own."""
    values = {name: row["default"] for name, row in SETTINGS.items()}
    own = {name: value for name, value in dict(defaults).items() if name in SETTINGS}
    return values | own | PRESETS[identifier][2]


def native_options(**settings):
    """Return the keyword arguments of mrcontour.Options for some of the SETTINGS; the others take their defaults.

    Raises TypeError for unknown settings.
    """
    _refuse_unknown(settings, SETTINGS)
    values = {name: row["default"] for name, row in SETTINGS.items()} | settings
    plain = ("refinement", "iterations", "length_bias", "length_floor", "anchor", "crease", "max_turn")
    return {name: values[name] for name in plain} | {
        "width": None if values["whole_surface"] else values["width"],
        "band_distance": values["reach"] if values["reach"] > 0 and not values["whole_surface"] else None,
        "feature_clamp": values["feature_clamp"] if values["feature_clamp"] < 1 else None,
        "min_salience": values["min_salience"] if values["min_salience"] > 0 else None,
        "flow": values["flow"].lower(),
        "ends": "edges_or_border" if values["ends"] == "AUTO" else values["ends"].lower(),
        "regular_iterations": values["regular_iterations"] if values["refinement"] > 0 else 0,
    }


def network_options(**settings):
    """Return the keyword arguments of mrcontour.Options for networks, given some of the settings in NETWORK."""
    _refuse_unknown(settings, NETWORK)
    return native_options(ends="BORDER", **settings)


def _refuse_unknown(settings, known):
    unknown = sorted(settings.keys() - set(known))
    if unknown:
        raise TypeError(f"unknown settings: {', '.join(unknown)}; there are {', '.join(known)}")
