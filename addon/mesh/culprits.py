# SPDX-License-Identifier: GPL-3.0-or-later
"""Selects the elements at which a problem lies, in meshes in Edit Mode."""

import bmesh
import bpy

from . import edge_marks


def select(elements_of):
    """Select only these elements, (kind, id), of objects; other objects keep their selection.

    In face mode if all are faces, which may then be deleted as they are, otherwise in vertex mode. Where all of an
    object's elements are hidden, its selection stays. Return whether any are shown.
    """
    faces_only = all(kind == "face" for elements in elements_of.values() for kind, _ in elements)
    shown_of = _shown_faces if faces_only else _shown_vertices
    shown = {obj: shown_of(obj.data, elements) for obj, elements in elements_of.items()}
    shown = {obj: ids for obj, ids in shown.items() if ids}
    if shown:
        bpy.ops.mesh.select_mode(type="FACE" if faces_only else "VERT")
    for obj, ids in shown.items():
        bm = bmesh.from_edit_mesh(obj.data)
        found = bm.faces if faces_only else bm.verts
        found.ensure_lookup_table()
        edge_marks.select_each([bm.faces, bm.edges, bm.verts], False)
        edge_marks.select_each([[found[i] for i in ids]], True)
        edge_marks.flush_selection(bm)
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
    return bool(shown)


def _shown_faces(mesh, elements):
    """Return the faces of elements that are not hidden, in ascending order."""
    bm = bmesh.from_edit_mesh(mesh)
    bm.faces.ensure_lookup_table()
    return [face for face in sorted({face for _, face in elements}) if not bm.faces[face].hide]


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
