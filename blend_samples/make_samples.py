# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the small .blend files in this folder:

    blender -b --factory-startup --python-exit-code 1 --python blend_samples/make_samples.py -- [SAMPLE...]

Each file holds one mesh. Its rough loops are boolean edge attributes `rough_loop.NAME`, all of them selected: enter
Edit Mode and press Optimize Contour. If a loop needs other settings than the add-on's defaults, they are in the custom
property `settings.NAME` of the object; `rough_loops` has the rule. If the correct contour is known by construction, its
edges are in `true_loop.NAME`. The character's rough loops are also marked as seams; `hand_parts` has ragged materials
instead of loops.
"""

import sys
from math import radians
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import blender_meshes  # noqa: E402
import shapes  # noqa: E402
from rough_loops import Cut, border_loop, rough_loop, settings  # noqa: E402

# The fingers' planes: the axis and the angle in degrees by which they are tilted from perpendicular to the finger.
TILTS = {"index": ("Y", 14.0), "middle": ("X", 18.0), "ring": ("Y", -12.0), "little": ("X", 15.0), "thumb": ("Y", 20.0)}

CUTS = {
    "torso": [
        Cut("waist", (0.0, 0.0, 6.0), (0.25, 0.15, 1.0), end=(0.0, 0.0, 5.0)),
        Cut("neck", (0.0, 0.0, 13.9), (-0.2, 0.2, 1.0)),
        Cut("shoulder", (5.4, 0.0, 11.5), (1.0, 0.0, 0.3)),
    ],
    "head": [
        Cut("neck", (0.0, 0.4, -4.4), (0.15, 0.25, 1.0), end=(0.0, 0.5, -5.8)),
        Cut("nose", (0.0, -3.4, -0.6), (0.1, -1.0, 0.25)),
        Cut("ear", (3.1, 0.2, -0.5), (1.0, 0.2, 0.2), end=(2.5, 0.2, -0.5)),
    ],
    "suzanne": [
        Cut("ear", (-1.0, 0.25, 0.1), (-1.0, 0.2, 0.3)),
        Cut("muzzle", (0.0, -0.5, -0.55), (0.2, -0.35, -1.0)),
    ],
    "bottle": [
        Cut("neck", (0.0, 0.0, 13.9), (0.3, 0.1, 1.0)),
        Cut("lip", (0.0, 0.0, 15.7), (0.0, 0.25, 1.0)),
        Cut("body", (0.0, 0.0, 5.6), (0.12, 0.12, 1.0)),
    ],
    "groove_cylinder": [Cut("groove", (0.0, 0.0, 0.2), (-0.05, 0.15, 1.0))],
}

SAMPLES = ("hand", *CUTS, "character", "hand_parts")


def both_sides(name, point, normal):
    """Return a cut on the character's left side, and its mirror image."""
    return [
        Cut(f"{side}_{name}", (sign * point[0], *point[1:]), (sign * normal[0], *normal[1:]))
        for side, sign in (("left", 1), ("right", -1))
    ]


def character_cuts():
    """Return cuts where a modeler in a hurry would mark seams: near the joints, and tilted."""
    return [
        Cut("neck", (0.0, 0.0, 13.9), (0.2, 0.2, 1.0)),
        *both_sides("shoulder", (2.5, 0.0, 11.4), (1.0, 0.3, -0.45)),
        *both_sides("wrist", (5.6, -0.1, 9.1), (0.5, 0.5, -0.8)),
        *both_sides("hip", (1.4, 0.0, 6.1), (0.25, 0.2, -1.0)),
        *both_sides("ankle", (1.55, 0.1, 1.9), (0.2, 0.3, -1.0)),
    ]


def finger_cut(name):
    """Return a tilted cut halfway up a finger."""
    _, direction = shapes.finger_axis(name)
    middle = shapes.finger_point(name, 0.5)
    axis, degrees = TILTS[name]
    normal = Matrix.Rotation(radians(degrees), 3, axis) @ direction
    return Cut(name, tuple(middle), tuple(normal), end=tuple(shapes.finger_point(name, 0.0)))


def finger_bases(mesh):
    """Return where the fingers' cones leave the palm by construction: the borders of the faces nearest to each cone."""
    part = shapes.parts_of_hand(mesh.centers())
    return {name: border_loop(mesh, part == name, shapes.finger_point(name, 0.0)) for name in TILTS}


def groove_bottom():
    """Return the slanted plane of the groove."""
    slope, height = shapes.GROOVE["slope"], shapes.GROOVE["height"]
    return Cut("groove", (0.0, 0.0, height), (-slope, 0.0, 1.0))


def cuts(sample):
    if sample == "hand":
        return [finger_cut(name) for name in TILTS]
    return character_cuts() if sample == "character" else CUTS.get(sample, [])


def true_loops(sample, mesh):
    if sample == "hand":
        return finger_bases(mesh)
    return {"groove": rough_loop(mesh, groove_bottom())} if sample == "groove_cylinder" else {}


def store_loops(sample, ob):
    mesh = blender_meshes.polygons(ob.data)
    selected = np.zeros(len(ob.data.edges), bool)
    for cut in cuts(sample):
        loop = rough_loop(mesh, cut)
        selected |= blender_meshes.edge_mask(ob.data, loop)
        blender_meshes.store_loop(ob.data, blender_meshes.ROUGH + cut.name, loop)
        if cut.end:
            ob[blender_meshes.SETTINGS + cut.name] = settings(mesh, cut, loop)
    for name, loop in true_loops(sample, mesh).items():
        blender_meshes.store_loop(ob.data, blender_meshes.TRUE + name, loop)
    blender_meshes.select_edges(ob.data, selected)


def make(sample):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    ob = getattr(shapes, sample)()
    ob.data.polygons.foreach_set("use_smooth", np.ones(len(ob.data.polygons), bool))
    store_loops(sample, ob)
    if sample == "character":  # its rough loops are also seams
        blender_meshes.mark_seams(ob.data, blender_meshes.read(ob.data.edges, "select", 1, bool))
    ob.select_set(True)
    bpy.context.scene.tool_settings.mesh_select_mode = (False, True, False)
    path = HERE / f"{sample}.blend"
    bpy.context.preferences.filepaths.save_version = 0
    bpy.ops.outliner.orphans_purge(do_recursive=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)
    print(f"{path.name}: {len(ob.data.polygons)} faces, {path.stat().st_size // 1024} KiB")


if __name__ == "__main__":
    for each in sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else SAMPLES:
        make(each)
