# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and rough loops for the tests, and helpers to run operators and read the results."""

import bmesh
import bpy
import numpy as np

SEGMENTS, RINGS, GROOVE = 32, 21, 12


def ring(row):
    """Return the vertices of a ring of the cylinder."""
    return [row * SEGMENTS + column for column in range(SEGMENTS)]


def rough_loop(row, steps=2):
    """Return a closed loop along the cylinder's edges that climbs `steps` rings from this one and comes down again."""
    rows = [row + round(steps * (1 - np.cos(2 * np.pi * column / SEGMENTS)) / 2) for column in range(SEGMENTS)]
    loop = []
    for column in range(SEGMENTS):
        arrives, leaves = rows[column - 1], rows[column]
        step = 1 if leaves >= arrives else -1
        loop += [between * SEGMENTS + column for between in range(arrives, leaves + step, step)]
    return loop


def pairs(loop, closed=True):
    """Return the edges along a list of vertices."""
    return list(zip(loop, loop[1:] + loop[:1] if closed else loop[1:]))


def grooved_cylinder(name="Cylinder", depth=0.3, grooves=(GROOVE,)):
    """Make an open cylinder of quads with a groove around ring GROOVE, or around several rings."""
    rows = np.arange(RINGS)
    radii = 1 - depth * sum(np.exp(-((rows - groove) ** 2) / 2) for groove in grooves)
    angles = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    round_about = [(np.cos(angle), np.sin(angle)) for angle in angles]
    positions = [(radius * x, radius * y, 0.2 * row) for row, radius in zip(rows, radii) for x, y in round_about]
    faces = [
        (upper - SEGMENTS, following - SEGMENTS, following, upper)
        for row in range(1, RINGS)
        for upper, following in pairs(ring(row))
    ]
    return mesh_object(name, positions, faces=faces)


def dumbbell(offset=0.0):
    """Make a cylinder along x with two grooves, one on each side of its middle, which is at x = offset."""
    obj = grooved_cylinder(grooves=(5, 15))
    for vertex in obj.data.vertices:
        x, y, _ = vertex.co
        vertex.co = (vertex.index // SEGMENTS - 10) * 0.2 + offset, x, y
    return obj


def torus(major=24, minor=12):
    """Make a closed torus of quads."""
    angles = [(2 * np.pi * i / major, 2 * np.pi * j / minor) for i in range(major) for j in range(minor)]
    points = [((2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)) for a, b in angles]
    corners = [(i, j) for i in range(major) for j in range(minor)]

    def at(i, j):
        return i % major * minor + j % minor

    return mesh_object(
        "Torus", points, faces=[(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i, j in corners]
    )


def torus_ring(i, minor=12):
    """Return the vertices of a ring around the tube of the torus."""
    return [i * minor + j for j in range(minor)]


def mesh_object(name, positions, edges=(), faces=()):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(positions, list(edges), list(faces))
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    return obj


def edit(*objects, mode="EDGE"):
    """Enter Edit Mode with these objects and nothing selected."""
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0]
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="VERT" if mode == "VERTEX" else mode)
    bpy.ops.mesh.select_all(action="DESELECT")


def select(obj, edges):
    """Add edges, given as vertex pairs, to the selection."""
    bm = bmesh.from_edit_mesh(obj.data)
    for edge in find_edges(bm, edges):
        edge.select_set(True)
    bm.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)


def select_faces_below(obj, loop):
    """Select the faces between the cylinder's ring 2 and a loop above it."""
    wall = {frozenset(pair) for pair in pairs(loop) + pairs(ring(2))}
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    pending = [bm.faces[2 * SEGMENTS]]
    while pending:
        face = pending.pop()
        face.select_set(True)
        for edge in face.edges:
            if frozenset(vertex.index for vertex in edge.verts) not in wall:
                pending += [other for other in edge.link_faces if not other.select]
    bmesh.update_edit_mesh(obj.data)


def find_edges(bm, edges):
    bm.verts.ensure_lookup_table()
    return [bm.edges.get((bm.verts[a], bm.verts[b])) for a, b in edges]


def mark_edges(obj, edges, mark):
    """Mark edges, given as vertex pairs, as "seam" or "sharp"."""
    bm = bmesh.from_edit_mesh(obj.data)
    for edge in find_edges(bm, edges):
        if mark == "seam":
            edge.seam = True
        else:
            edge.smooth = False
    bmesh.update_edit_mesh(obj.data)


def marked_edges(obj, mark):
    """Return the edges of an object in Edit Mode that are "select", "seam" or "sharp", as a set of vertex pairs."""
    attribute, value = {"select": ("select", True), "seam": ("seam", True), "sharp": ("smooth", False)}[mark]
    edges = [edge for edge in bmesh.from_edit_mesh(obj.data).edges if getattr(edge, attribute) == value]
    return {frozenset(vertex.index for vertex in edge.verts) for edge in edges}


def edge_set(loop):
    return {frozenset(pair) for pair in pairs(loop)}


def mesh_state(obj):
    """Return all data of a mesh in Edit Mode as plain values that can be compared."""
    bm = bmesh.from_edit_mesh(obj.data)
    return {
        "vertices": [(tuple(vertex.co), vertex.select, vertex.hide) for vertex in bm.verts],
        "edges": [(*ids(edge), edge.select, edge.hide, edge.seam, edge.smooth) for edge in bm.edges],
        "faces": [(*ids(face), face.select, face.hide, face.smooth, face.material_index) for face in bm.faces],
        "layers": layers(bm),
    }


def but_selection(state):
    """Return a mesh's state without what is selected."""
    places = {"vertices": 1, "edges": 2, "faces": -4}
    rows = {kind: [(*row[:at], *row[at:][1:]) for row in state[kind]] for kind, at in places.items()}
    return rows | {"layers": state["layers"]}


OUTPUTS = ("SELECT", "SEAM", "SHARP", "CUT", "RIP", "SEPARATE")
GROOVE_EDGES = edge_set(ring(GROOVE))
START = rough_loop(GROOVE - 3)  # near enough to find the groove


def run(**properties):
    return bpy.ops.mesh.optimize_contour(**properties)


LAYER_TYPES = ("bool", "float", "float_color", "float_vector", "int", "bevel_weight", "crease", "deform", "shape", "uv")


def ids(element):
    return [vertex.index for vertex in element.verts]


def layers(bm):
    """Return the contents of every layer, by element kind, layer kind and name; UV and color as tuples."""
    found = {}
    corners = [corner for face in bm.faces for corner in face.loops]
    for kind, layer_sets, elements in (
        ("vertex", bm.verts.layers, bm.verts),
        ("edge", bm.edges.layers, bm.edges),
        ("face", bm.faces.layers, bm.faces),
        ("corner", bm.loops.layers, corners),
    ):
        for type_name in LAYER_TYPES:
            for layer in getattr(layer_sets, type_name, {}).values():
                found[kind, type_name, layer.name] = [_plain(element[layer]) for element in elements]
    return found


def _plain(value):
    if hasattr(value, "uv"):
        return tuple(value.uv)
    if hasattr(value, "items"):
        return tuple(value.items())
    return tuple(value) if hasattr(value, "__len__") else value
