# SPDX-License-Identifier: GPL-3.0-or-later
"""Moves whole arrays from Blender's meshes."""

from dataclasses import dataclass

import bmesh
import numpy as np

from . import contours

_EVEN = 1e-3  # scales that differ by less than this share are the same


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

    edges: np.ndarray  # in face mode directed: the selected face is to the left
    loose: np.ndarray


def read_selection(obj, face_mode):
    """The selected edges of a synchronized mesh; in face mode the borders of the selected faces.

    Edit Mode never has anything hidden selected.
    """
    mesh = obj.data
    corner_edges = _read(mesh.loops, "edge_index", np.int32)
    vertices = _read(mesh.edges, "vertices", np.int32, 2)
    if face_mode:
        selected, hidden = (_read(mesh.polygons, name, bool) for name in ("select", "hide"))
        chosen = contours.region_border(_face_offsets(mesh), corner_edges, selected, hidden, len(mesh.edges))
        return EdgeSelection(_with_face_left(mesh, vertices, corner_edges, chosen, selected), vertices[:0])
    chosen = np.flatnonzero(_read(mesh.edges, "select", bool))
    used = np.zeros(len(mesh.edges), dtype=bool)
    used[corner_edges] = True
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


def with_mirror_images(obj, edges):
    """The edges with their mirror images, or None; see contours.with_mirror_images."""
    mesh = obj.data
    visible = _read(mesh.edges, "vertices", np.int32, 2)[~_read(mesh.edges, "hide", bool)]
    points = _read(_shown_points(obj), "co", np.float32, 3).astype(np.float64)
    return contours.with_mirror_images(edges, points, visible)


def is_unevenly_scaled(obj):
    """Whether an object looks different in the scene than in its own space, mirrored included."""
    scale = np.abs(obj.matrix_world.to_scale())
    return bool(obj.matrix_world.is_negative or np.ptp(scale) > _EVEN * scale.max())


def is_inside_out(obj):
    """Whether a closed mesh encloses a negative volume."""
    mesh = obj.data
    uses = np.bincount(_read(mesh.loops, "edge_index", np.int32), minlength=len(mesh.edges))
    if len(mesh.polygons) == 0 or np.any(uses != 2):
        return False
    mesh.calc_loop_triangles()
    points = _read(_shown_points(obj), "co", np.float32, 3).astype(np.float64)
    first, second, third = (points - points.mean(axis=0))[_read(mesh.loop_triangles, "vertices", np.int32, 3).T]
    return np.einsum("ij,ij->", np.cross(first, second), third) < 0


def find_edges(bm, pairs):
    """The edges between pairs of vertex ids."""
    bm.verts.ensure_lookup_table()
    return [bm.edges.get((bm.verts[a], bm.verts[b])) for a, b in pairs]


def _with_face_left(mesh, vertices, corner_edges, chosen, selected):
    """The chosen edges in the direction in which a selected face runs along them."""
    corner_faces = np.repeat(np.arange(len(selected)), np.diff(_face_offsets(mesh)))
    corners = np.flatnonzero(selected[corner_faces] & np.isin(corner_edges, chosen))
    tails = np.full(len(vertices), -1)
    tails[corner_edges[corners]] = _read(mesh.loops, "vertex_index", np.int32)[corners]
    backward = vertices[chosen, 0] != tails[chosen]
    return np.where(backward[:, None], vertices[chosen, ::-1], vertices[chosen])


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
