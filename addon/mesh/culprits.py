# SPDX-License-Identifier: GPL-3.0-or-later
"""Selects the elements at which a problem lies, in meshes in Edit Mode."""

import bmesh
import bpy

from . import edge_marks


def select(elements_of):
    """Select only these elements, (kind, id), of objects, in vertex mode; other objects keep their selection.

    Where all of an object's elements are hidden, its selection stays. Return whether any are shown.
    """
    shown = {obj: _shown_vertices(obj.data, elements) for obj, elements in elements_of.items()}
    shown = {obj: vertices for obj, vertices in shown.items() if vertices}
    if shown:
        bpy.ops.mesh.select_mode(type="VERT")
    for obj, vertices in shown.items():
        bm = bmesh.from_edit_mesh(obj.data)
        bm.verts.ensure_lookup_table()
        edge_marks.select_each([bm.verts], False)
        edge_marks.select_each([[bm.verts[vertex] for vertex in vertices]], True)
        edge_marks.flush_selection(bm)
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
    return bool(shown)


def _shown_vertices(mesh, elements):
    """Return the vertices of elements that are not hidden, in ascending order."""
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    bm.faces.ensure_lookup_table()
    vertices = set()
    for kind, index in elements:
        if kind == "face":
            vertices.update(vertex.index for vertex in bm.faces[index].verts)
        else:
            vertices.update(index if kind == "edge" else [index])
    return [vertex for vertex in sorted(vertices) if not bm.verts[vertex].hide]
