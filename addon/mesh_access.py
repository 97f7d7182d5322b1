# SPDX-License-Identifier: GPL-3.0-or-later
"""Moves whole arrays from Blender's meshes, and contours back into them. No other module does either."""

from dataclasses import dataclass

import bmesh
import numpy as np

from . import contours


@dataclass(frozen=True)
class MeshArrays:
    """What mrcontour.Surface is made from, in its order and types, in object space."""

    positions: np.ndarray
    face_offsets: np.ndarray
    face_vertices: np.ndarray
    triangles: np.ndarray
    hidden_faces: np.ndarray

    def equal(self, other):
        return all(map(np.array_equal, vars(self).values(), vars(other).values()))


def synchronize(obj):
    """Brings the mesh up to date with what was done in Edit Mode; until then its arrays are those of before."""
    if obj.mode == "EDIT":
        obj.update_from_editmode()


def read_arrays(obj):
    """The arrays of a synchronized mesh object."""
    mesh = obj.data
    mesh.calc_loop_triangles()
    return MeshArrays(
        positions=_read(_shown_points(obj), "co", np.float32, 3).astype(np.float64),
        face_offsets=_face_offsets(mesh),
        face_vertices=_read(mesh.loops, "vertex_index", np.int32),
        triangles=_read(mesh.loop_triangles, "vertices", np.int32, 3),
        hidden_faces=np.flatnonzero(_read(mesh.polygons, "hide", bool)).astype(np.int32),
    )


@dataclass(frozen=True)
class EdgeSelection:
    """The edges that the user means, as vertex pairs, and those of them that no face uses."""

    edges: np.ndarray
    loose: np.ndarray


def read_selection(obj, face_mode):
    """The selected edges of a synchronized mesh; in face mode the borders of the selected faces.

    Edit Mode never has anything hidden selected.
    """
    mesh = obj.data
    corner_edges = _read(mesh.loops, "edge_index", np.int32)
    if face_mode:
        selected, hidden = (_read(mesh.polygons, name, bool) for name in ("select", "hide"))
        chosen = contours.region_border(_face_offsets(mesh), corner_edges, selected, hidden, len(mesh.edges))
    else:
        chosen = np.flatnonzero(_read(mesh.edges, "select", bool))
    used = np.zeros(len(mesh.edges), dtype=bool)
    used[corner_edges] = True
    vertices = _read(mesh.edges, "vertices", np.int32, 2)
    return EdgeSelection(vertices[chosen], vertices[chosen[~used[chosen]]])


@dataclass(frozen=True)
class EdgeArrays:
    """What networks.make_topology is made from, in its order."""

    edges: np.ndarray
    face_offsets: np.ndarray
    corner_vertices: np.ndarray
    corner_edges: np.ndarray
    hidden_faces: np.ndarray


def read_edge_arrays(mesh):
    """The arrays of a synchronized mesh."""
    return EdgeArrays(
        edges=_read(mesh.edges, "vertices", np.int32, 2),
        face_offsets=_face_offsets(mesh),
        corner_vertices=_read(mesh.loops, "vertex_index", np.int32),
        corner_edges=_read(mesh.loops, "edge_index", np.int32),
        hidden_faces=np.flatnonzero(_read(mesh.polygons, "hide", bool)),
    )


def read_seams(mesh):
    """Of a synchronized mesh, which edges are seams, and which are selected."""
    return _read(mesh.edges, "use_seam", bool), _read(mesh.edges, "select", bool)


def write_seams(mesh, old_edges, new_edges):
    """Takes the seam from the old edges, given by their numbers, and sets it on the new ones, outside Edit Mode."""
    for edges, value in ((old_edges, False), (new_edges, True)):
        for edge in edges.tolist():
            mesh.edges[edge].use_seam = value
    mesh.update()


def read_labels(mesh, attribute):
    """The labels of a synchronized mesh's faces: of an integer face attribute, or of the material slots (None).

    None where there is no such attribute. In Edit Mode only the bmesh shows what is in one.
    """
    if attribute is None:
        return _read(mesh.polygons, "material_index", np.int32)
    layer = mesh.attributes.get(attribute)
    if layer is None or (layer.domain, layer.data_type) != ("FACE", "INT"):
        return None
    if not mesh.is_editmode:
        return _read(layer.data, "value", np.int32)
    bm = bmesh.from_edit_mesh(mesh)
    layer = bm.faces.layers.int[attribute]
    return np.fromiter((face[layer] for face in bm.faces), np.int32, len(bm.faces))


def write_labels(mesh, attribute, faces, labels):
    """Gives faces their labels, where read_labels reads them."""
    if not mesh.is_editmode:
        for face, label in zip(faces.tolist(), labels.tolist()):
            if attribute is None:
                mesh.polygons[face].material_index = label
            else:
                mesh.attributes[attribute].data[face].value = label
        mesh.update()
        return
    bm = bmesh.from_edit_mesh(mesh)
    bm.faces.ensure_lookup_table()
    layer = bm.faces.layers.int.get(attribute) if attribute is not None else None
    for face, label in zip(faces.tolist(), labels.tolist()):
        if attribute is None:
            bm.faces[face].material_index = label
        else:
            bm.faces[face][layer] = label
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


@dataclass(frozen=True)
class SelectedElements:
    """Ids of what is selected in a mesh."""

    vertices: np.ndarray
    edges: np.ndarray
    faces: np.ndarray


def clear_selection(mesh):
    """Deselects everything in a synchronized mesh; gives what was selected, for restore_selection."""
    kinds = (mesh.vertices, mesh.edges, mesh.polygons)
    selected = SelectedElements(*(np.flatnonzero(_read(kind, "select", bool)) for kind in kinds))
    _select(mesh, selected, False)
    return selected


def restore_selection(mesh, selected):
    """Selects again what clear_selection took."""
    _select(mesh, selected, True)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def write_flags(mesh, flag, old_edges, new_edges):
    """Takes a flag ("seam" or "sharp") from the old edges and sets it on the new ones."""
    edge_of = _edge_finder(mesh)
    for edges, value in ((old_edges, False), (new_edges, True)):
        for pair in edges:
            if flag == "seam":
                edge_of(pair).seam = value
            else:
                edge_of(pair).smooth = not value
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def write_selection(mesh, old_edges, new_edges):
    """Deselects the old edges, then selects the new ones, and what follows from them in the mesh's select mode."""
    bm = bmesh.from_edit_mesh(mesh)
    edge_of = _edge_finder(mesh)
    for edges, value in ((old_edges, False), (new_edges, True)):
        for pair in edges:
            edge_of(pair).select_set(value)
    bm.select_flush_mode()
    bm.select_history.validate()
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def set_edge_mode(mesh):
    """Has this mesh select edges; the tool settings reach only the active object's."""
    bmesh.from_edit_mesh(mesh).select_mode = {"EDGE"}


def _edge_finder(mesh):
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    return lambda pair: bm.edges.get((bm.verts[pair[0]], bm.verts[pair[1]]))


def _select(mesh, elements, value):
    bm = bmesh.from_edit_mesh(mesh)
    for sequence, ids in ((bm.faces, elements.faces), (bm.edges, elements.edges), (bm.verts, elements.vertices)):
        sequence.ensure_lookup_table()
        for index in ids:
            sequence[index].select_set(value)


def _shown_points(obj):
    """Edit Mode shows the active shape key; the mesh's own vertices stay those of the reference key."""
    if obj.mode == "EDIT" and obj.data.shape_keys and obj.active_shape_key_index > 0:
        return obj.active_shape_key.data
    return obj.data.vertices


def _face_offsets(mesh):
    return np.append(_read(mesh.polygons, "loop_start", np.int32), np.int32(len(mesh.loops)))


def _read(collection, attribute, dtype, width=1):
    values = np.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width) if width > 1 else values
