# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts between Blender's meshes and plain arrays: polygons, and the edge attributes that store a sample's loops."""

import bpy
import numpy as np
from curves import Curve
from rough_loops import Polygons

ROUGH = "rough_loop."  # a boolean edge attribute for each rough loop: this, then the loop's name
SETTINGS = "settings."  # a custom property of the object for each rough loop that needs more than the defaults
SEAM = ".uv_seam"
TRUE = "true_loop."  # likewise for the correct loop, known by construction


def read(collection, name, width, dtype):
    flat = np.empty(len(collection) * width, dtype)
    collection.foreach_get(name, flat)
    return flat if width == 1 else flat.reshape(-1, width)


def polygons(mesh):
    """Return the mesh's faces as arrays."""
    starts = read(mesh.polygons, "loop_start", 1, np.int32)
    corners = read(mesh.loops, "vertex_index", 1, np.int32)
    return Polygons(read(mesh.vertices, "co", 3, np.float64), np.append(starts, len(corners)), corners)


def new_object(name, positions, faces):
    """Add a mesh object to the scene; each face is given by its vertices in order."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(positions.tolist(), [], faces)
    ob = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(ob)
    return ob


def edge_pairs(mesh):
    return np.sort(read(mesh.edges, "vertices", 2, np.int32), axis=1)


def curve(mesh, vertices, closed=True):
    """Return the polyline through vertices in order."""
    return surface_curve(mesh, np.stack([vertices, vertices], axis=1), np.zeros(len(vertices)), closed)


def surface_curve(mesh, edge_vertices, edge_parameters, closed):
    """Return the polyline through points on edges: (1 - t) a + t b on the edge ab."""
    positions, normals = (read(mesh.vertices, name, 3, np.float64) for name in ("co", "normal"))
    (a, b), t = np.transpose(edge_vertices), np.asarray(edge_parameters)[:, None]
    return Curve(*((1.0 - t) * array[a] + t * array[b] for array in (positions, normals)), closed)


def mean_edge_length(mesh):
    ends = read(mesh.vertices, "co", 3, np.float64)[edge_pairs(mesh)]
    return np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean()


def edge_mask(mesh, loop):
    """Return a mask of the mesh's edges that lie on a closed loop of vertices."""
    loop = np.asarray(loop, np.int64)
    sides = np.sort(np.stack([loop, np.roll(loop, -1)], axis=1), axis=1)
    pairs, count = edge_pairs(mesh).astype(np.int64), len(mesh.vertices)
    mask = np.isin(pairs @ (count, 1), sides @ (count, 1))
    if mask.sum() != len(loop):
        raise ValueError(f"{mesh.name}: {len(loop) - mask.sum()} sides of the loop are not edges of the mesh.")
    return mask


def store_loop(mesh, attribute, loop):
    """Store a loop in the mesh as a boolean edge attribute."""
    mesh.attributes.new(attribute, "BOOLEAN", "EDGE").data.foreach_set("value", edge_mask(mesh, loop))


def stored_loops(mesh, prefix):
    """Return the loops stored under a prefix: name -> vertices in order."""
    names = [a.name for a in mesh.attributes if a.name.startswith(prefix)]
    return {name[len(prefix) :]: ordered_loop(mesh, stored_mask(mesh, name)) for name in names}


def stored_mask(mesh, attribute):
    return read(mesh.attributes[attribute].data, "value", 1, bool)


def ordered_loop(mesh, mask):
    """Return the vertices of the closed loop of the marked edges, in the add-on's order for selected edges."""
    neighbors = {}
    for a, b in edge_pairs(mesh)[mask].tolist():
        neighbors.setdefault(a, []).append(b)
        neighbors.setdefault(b, []).append(a)
    start = min(neighbors)
    loop, last, here = [start], start, min(neighbors[start])
    while here != start:
        loop.append(here)
        last, here = here, next(v for v in neighbors[here] if v != last)
    return loop


def mark_seams(mesh, mask):
    """Mark only these edges as seams, in a form that survives in a file for any Blender.

    Blender 5.1 and 5.2 lose the seams of files from before 3.5, which are flags, but not an attribute of the name that
    came in between. Each of the releases that keep seams there takes it for its own.
    """
    mesh.edges.foreach_set("use_seam", np.ascontiguousarray(mask))
    if bpy.app.version < (3, 5, 0):
        if SEAM not in mesh.attributes:
            mesh.attributes.new(SEAM, "BOOLEAN", "EDGE")
        mesh.attributes[SEAM].data.foreach_set("value", np.ascontiguousarray(mask))


def select_edges(mesh, mask):
    """Select only the marked edges, as Edit Mode will show them."""
    vertices = np.zeros(len(mesh.vertices), bool)
    vertices[edge_pairs(mesh)[mask]] = True
    mesh.polygons.foreach_set("select", np.zeros(len(mesh.polygons), bool))
    mesh.edges.foreach_set("select", np.ascontiguousarray(mask))
    mesh.vertices.foreach_set("select", vertices)
