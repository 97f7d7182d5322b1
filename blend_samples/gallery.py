# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery: complete jobs, done with the operators in Edit Mode as a modeler does them, each with a picture.

A job checks its results, raises a RuntimeError if they are wrong, and returns its rows of the table. README.md in this
folder shows the pictures.
"""

import blender_meshes
import bpy
import gallery_pictures as drawing
import numpy as np
import report
import shapes

ORANGE, BLUE, BLACK = (0.85, 0.25, 0.0), (0.0, 0.10, 0.75), (0.02, 0.02, 0.02)
SKIN, SHIRT, SLEEVES = (1.0, 0.70, 0.48), (0.86, 0.16, 0.13), (1.0, 0.55, 0.08)
JEANS, SHOES = (0.16, 0.30, 0.66), (0.20, 0.50, 0.22)
ISLANDS = [SKIN, SHIRT, JEANS, JEANS, SHOES, SHOES, SLEEVES, SLEEVES, SKIN, SKIN]  # in the order of `_place`
PARTS_MOVED = 0.16  # how far the printed parts are moved apart, as a fraction of their distance from the trunk


def character_seams(path, folder, api):
    """Improve the rough seams of a character, all at once, with Optimize Seams."""
    ob = _opened(path)
    rough, given = ob.data.copy(), _curves(ob.data, _seams(ob.data))
    results = api.optimize_seams(ob)
    _operate(bpy.ops.mesh.optimize_seams)
    for result in results:
        _check(result.objective <= result.initial_objective, "a seam got worse")
        _check(_seams(ob.data)[_edges(ob.data, result.vertices)].all(), "the seams are not those found")
    found = _curves(ob.data, _seams(ob.data))
    islands = [_islands(mesh, _seams(mesh)) for mesh in (rough, ob.data)]
    _check(all(count == len(ISLANDS) for count in map(np.max, [part + 1 for part in islands])), "islands were lost")
    before = _panel(["Character: ten islands", ("rough seams", ORANGE)], rough, islands[0], given)
    after = _panel([f"Optimize Seams: {_ratios(results)}", ("seams found", BLUE)], ob.data, islands[1], found)
    drawing.draw_if_changed(folder / "character_seams.png", ISLANDS, [before, after], (0.35, -1.0, 0.2))
    return _rows("character_seams", "seam", ob.data, {}, results)


def character_printed(path, folder, api):
    """Cut the same character for printing, into separate objects with smooth, closed rims."""
    ob = _opened(path)
    whole, given = ob.data.copy(), _curves(ob.data, _seams(ob.data))
    settings = {"refinement": 2}
    loops = blender_meshes.stored_loops(ob.data, blender_meshes.ROUGH).values()
    results = [api.optimize_contour(ob, loop, **settings) for loop in loops]
    blender_meshes.select_edges(ob.data, _seams(ob.data))
    _operate(bpy.ops.mesh.optimize_contour, output="SEPARATE", fill_holes=True, merge=0.1, **settings)
    parts = sorted((part for part in bpy.data.objects if part.type == "MESH"), key=_order)
    _check(len(parts) == len(ISLANDS), f"there are {len(parts)} parts")
    _check(all(_is_closed(part.data) for part in parts), "a part is open")
    trunk = _center(max(parts, key=lambda part: len(part.data.polygons)).data)
    pieces = [
        drawing.Piece(part.data, np.full(len(part.data.polygons), i), PARTS_MOVED * (_center(part.data) - trunk))
        for i, part in enumerate(parts)
    ]
    one = np.zeros(len(whole.polygons), np.int32)
    before = _panel(["Character: nine rough loops", ("selected", ORANGE)], whole, one, given)
    words = [("Separate, Refinement 2, Fill Holes", BLACK), (f"{len(parts)} closed parts to print", BLUE)]
    panels = [before, drawing.Panel(words, pieces)]
    drawing.draw_if_changed(folder / "character_printed.png", ISLANDS, panels, (0.35, -1.0, 0.2))
    return _rows("character_printed", "cut", whole, settings, results)


def hand_segmentation(path, folder, api):
    """Clean a ragged segmentation by materials with Optimize Segmentation."""
    ob = _opened(path)
    settings = {"width": 12, "reach": 0.3}
    rough, colors = ob.data.copy(), list(shapes.PART_COLORS.values())
    results = api.optimize_segmentation(ob, source="MATERIAL", **settings)
    _operate(bpy.ops.mesh.optimize_segmentation, source="MATERIAL", **settings)
    meshes = [rough, ob.data]
    labels = [blender_meshes.read(mesh.polygons, "material_index", 1, np.int32) for mesh in meshes]
    true = shapes.parts_of_hand(blender_meshes.polygons(rough).centers())
    right = [np.mean(np.array(list(shapes.PART_COLORS))[part] == true) for part in labels]
    _check(right[1] > right[0], f"of the faces {right[0]:.1%} were right before and {right[1]:.1%} after")
    borders = [_curves(mesh, _borders(mesh, part)) for mesh, part in zip(meshes, labels)]
    before = _panel(["Six materials, ragged", (f"{right[0]:.1%} of faces right", ORANGE)], rough, labels[0], borders[0])
    after = _panel(["Optimize Segmentation", (f"{right[1]:.1%} of faces right", BLUE)], ob.data, labels[1], borders[1])
    drawing.draw_if_changed(folder / "hand_segmentation.png", colors, [before, after], (0.2, -1.0, 0.15))
    return _rows("hand_segmentation", "border", ob.data, settings, results)


JOBS = {"character_seams": "character", "character_printed": "character", "hand_segmentation": "hand_parts"}


def _opened(path):
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return bpy.context.view_layer.objects.active


def _operate(operator, **settings):
    """Run an operator in Edit Mode, in edge select mode."""
    bpy.context.scene.tool_settings.mesh_select_mode = (False, True, False)
    bpy.ops.object.mode_set(mode="EDIT")
    done = operator(**settings)
    bpy.ops.object.mode_set(mode="OBJECT")
    _check(done == {"FINISHED"}, f"the operator returned {done}")


def _check(right, message):
    if not right:
        raise RuntimeError(message)


def _rows(job, noun, mesh, settings, results):
    numbered = enumerate(results, 1)
    return [report.row(job, f"{noun} {i}", len(mesh.polygons), settings, result, None) for i, result in numbered]


def _ratios(results):
    moved = sum(result.status == "improved" for result in results)
    return f"{moved} of {len(results)} moved"


def _panel(words, mesh, colors, curves):
    lines = [word if isinstance(word, tuple) else (word, BLACK) for word in words]
    return drawing.Panel(lines, [drawing.Piece(mesh, colors)], curves)


def _seams(mesh):
    return blender_meshes.read(mesh.edges, "use_seam", 1, bool)


def _edges(mesh, loop):
    return np.flatnonzero(blender_meshes.edge_mask(mesh, loop))


def _curves(mesh, mask):
    """Return the closed loops of the marked edges; no two of them may meet."""
    pairs, curves = blender_meshes.edge_pairs(mesh), []
    while mask.any():
        piece = _connected(pairs, mask)
        curves.append(blender_meshes.curve(mesh, blender_meshes.ordered_loop(mesh, piece)))
        mask = mask & ~piece
    return curves


def _connected(pairs, mask):
    """Return the marked edges that are connected to the first of them."""
    reached, piece = set(pairs[np.flatnonzero(mask)[0]].tolist()), np.zeros(len(mask), bool)
    while True:
        met = mask & ~piece & np.isin(pairs, list(reached)).any(axis=1)
        if not met.any():
            return piece
        piece |= met
        reached.update(pairs[met].ravel().tolist())


def _faces_at_edges(mesh):
    """Return the two faces of each edge of a closed mesh."""
    edges = blender_meshes.read(mesh.loops, "edge_index", 1, np.int32)
    faces = np.repeat(np.arange(len(mesh.polygons)), blender_meshes.read(mesh.polygons, "loop_total", 1, np.int32))
    return faces[np.argsort(edges, kind="stable")].reshape(-1, 2)


def _borders(mesh, labels):
    """Return a mask of the edges between faces with different labels."""
    first, second = labels[_faces_at_edges(mesh)].T
    return first != second


def _islands(mesh, seams):
    """Return the number of each face's UV island, in the order of `_place`."""
    joined, island = _faces_at_edges(mesh)[~seams], np.arange(len(mesh.polygons))
    while True:
        least = island.copy()
        np.minimum.at(least, joined[:, 0], island[joined[:, 1]])
        np.minimum.at(least, joined[:, 1], island[joined[:, 0]])
        least = least[least]
        if np.array_equal(least, island):
            break
        island = least
    names, number = np.unique(island, return_inverse=True)
    centers = blender_meshes.polygons(mesh).centers()
    places = [_place(centers[number == i].mean(axis=0)) for i in range(len(names))]
    return np.argsort(sorted(range(len(names)), key=places.__getitem__))[number]


def _place(center):
    """Return the sort key of a part: outward from the middle in steps, so that twins stay together, then downward."""
    return round(4 * abs(center[0])), -round(center[2]), center[0]


def _order(part):
    return _place(_center(part.data))


def _center(mesh):
    return blender_meshes.polygons(mesh).centers().mean(axis=0)


def _is_closed(mesh):
    """Whether each edge has two faces."""
    edges = blender_meshes.read(mesh.loops, "edge_index", 1, np.int32)
    return bool((np.bincount(edges, minlength=len(mesh.edges)) == 2).all())
