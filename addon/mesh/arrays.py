# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads whole arrays from Blender's meshes, and writes seams and labels back."""

from dataclasses import dataclass, fields
from functools import cached_property

import bmesh
import bpy
import numpy as np

from ..core import edge_paths, mirrored_quads
from ..core.face_borders import FaceSelection
from ..core.faces import Faces
from . import attributes

_SCALE_TOLERANCE = 1e-3  # scales that differ by less than this fraction are the same
_CHUNK = 1 << 14  # triangles; intermediate results of this many fit into the processor's cache


@dataclass(frozen=True)
class MeshArrays:
    """The arguments of mrcontour.Surface, in its order and types, in object space."""

    positions: np.ndarray
    face_offsets: np.ndarray
    face_vertices: np.ndarray
    triangles: np.ndarray
    hidden_faces: np.ndarray

    def keywords(self):
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def equal(self, other):
        return all(map(np.array_equal, self.keywords().values(), other.keywords().values()))

    @cached_property
    def signed_volume(self):
        """The volume inside a closed mesh: a sixth of the sum of the triangles' determinants about a center."""
        axes = (self.positions - self.positions.mean(axis=0)).T.copy()
        parts = np.split(self.triangles, range(_CHUNK, len(self.triangles), _CHUNK))
        return sum(_determinants(axes, part.T) for part in parts) / 6


def synchronize(obj):
    """Bring the mesh up to date with Edit Mode; until then its arrays are those from before the edit."""
    if attributes.is_edited(obj):
        obj.update_from_editmode()


def read_arrays(obj):
    """Return the arrays of a synchronized mesh object. With X Mirror, its quads are cut into mirror images."""
    face_offsets, corners = attributes.face_offsets(obj), attributes.read(obj, "loops", "vertex_index", np.int32)
    points, triangles = _read_points(obj), attributes.triangles(obj, corners)
    if obj.data.use_mirror_x:
        triangles = mirrored_quads.mirrored(points, face_offsets, corners, triangles)
    return MeshArrays(
        positions=points,
        face_offsets=face_offsets,
        face_vertices=corners,
        triangles=triangles,
        hidden_faces=np.flatnonzero(attributes.read(obj, "polygons", "hide", bool)).astype(np.int32),
    )


def read_selected_edges(obj):
    """Return the selected edges of a synchronized mesh as (n, 2) vertices, and those of them that no face uses.

    In Edit Mode, hidden elements are never selected.
    """
    chosen = np.flatnonzero(attributes.read(obj, "edges", "select", bool))
    edges = attributes.read(obj, "edges", "vertices", np.int32, 2)[chosen]
    used = np.zeros(len(obj.data.edges), dtype=bool)
    used[attributes.read(obj, "loops", "edge_index", np.int32)] = True
    return edges, edges[~used[chosen]]


def read_faces(obj):
    """Return the faces of a synchronized mesh."""
    return Faces(_read_points(obj), **vars(read_edge_arrays(obj)))


def read_selected_faces(obj):
    """Return the selected faces of a synchronized mesh as a FaceSelection."""
    selected = attributes.read(obj, "polygons", "select", bool)
    return FaceSelection(_read_points(obj), **vars(read_edge_arrays(obj)), selected=selected)


@dataclass(frozen=True)
class EdgeArrays:
    """The arguments of topology.make_topology, in its order."""

    edges: np.ndarray
    face_offsets: np.ndarray
    corner_vertices: np.ndarray
    corner_edges: np.ndarray
    hidden_faces: np.ndarray


def read_edge_arrays(obj):
    """Return the edge arrays of a synchronized mesh."""
    return EdgeArrays(
        edges=attributes.read(obj, "edges", "vertices", np.int32, 2),
        face_offsets=attributes.face_offsets(obj),
        corner_vertices=attributes.read(obj, "loops", "vertex_index", np.int32),
        corner_edges=attributes.read(obj, "loops", "edge_index", np.int32),
        hidden_faces=np.flatnonzero(attributes.read(obj, "polygons", "hide", bool)),
    )


def read_seams(obj):
    """Return which edges of a synchronized mesh are seams, and which are selected."""
    return tuple(attributes.read(obj, "edges", name, bool) for name in ("use_seam", "select"))


def write_seams(mesh, old_edges, new_edges):
    """Clear the seam of the old edges and set it on the new ones, both given by index; outside Edit Mode."""
    for edges, value in ((old_edges, False), (new_edges, True)):
        for edge in edges.tolist():
            mesh.edges[edge].use_seam = value
    mesh.update()


def read_labels(obj, attribute):
    """Return the labels of a synchronized mesh's faces: an integer face attribute, or the material slots (None).

    Return None if there is no such attribute.
    """
    if attribute is None:
        return attributes.read(obj, "polygons", "material_index", np.int32)
    with attributes.with_attributes(obj) as mesh:
        layer = mesh.attributes.get(attribute)
        if layer is None or (layer.domain, layer.data_type) != ("FACE", "INT"):
            return None
        return attributes.values(layer.data, "value", np.int32)


def write_labels(mesh, attribute, faces, labels):
    """Write the labels of faces to where read_labels reads them."""
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


def with_mirror_images(obj, edges, may_branch=False):
    """Return the edges with their mirror images, or None; see edge_paths.with_mirror_images and with_images."""
    edge_vertices, hidden = (
        attributes.read(obj, "edges", *attribute) for attribute in (("vertices", np.int32, 2), ("hide", bool))
    )
    find = edge_paths.with_images if may_branch else edge_paths.with_mirror_images
    return find(edges, _read_points(obj), edge_vertices[~hidden])


def is_unevenly_scaled(obj):
    """Whether an object looks different in the scene than in its own space, mirrored included."""
    scale = np.abs(obj.matrix_world.to_scale())
    return bool(obj.matrix_world.is_negative or np.ptp(scale) > _SCALE_TOLERANCE * scale.max())


def is_inside_out(obj, arrays):
    """Whether a synchronized mesh is closed and encloses a negative volume; `arrays` are its MeshArrays."""
    if not arrays.signed_volume < 0:  # the usual case, which costs little
        return False
    uses = np.bincount(attributes.read(obj, "loops", "edge_index", np.int32), minlength=len(obj.data.edges))
    return bool(np.all(uses == 2))


def find_edges(bm, pairs):
    """Return the edges between pairs of vertex ids."""
    bm.verts.ensure_lookup_table()
    return [bm.edges.get((bm.verts[a], bm.verts[b])) for a, b in pairs]


def _read_points(obj):
    return attributes.values(_shown_points(obj), "co", np.float32, 3).astype(np.float64)


def _shown_points(obj):
    """Return the points that Edit Mode shows: those of the active shape key, not of the reference key."""
    if attributes.is_edited(obj) and obj.data.shape_keys:
        editing = _editing_object(obj)
        if editing.active_shape_key_index > 0:
            return editing.active_shape_key.data
    return obj.data.vertices


def _editing_object(obj):
    """Return the object that is in Edit Mode: each of the objects that share a mesh has its own active shape key."""
    if obj.mode == "EDIT":
        return obj
    return next((other for other in bpy.data.objects if other.data == obj.data and other.mode == "EDIT"), obj)


def _determinants(axes, corners):
    """Return the sum of the triangles' determinants; numpy's cross products would take ten times as long."""
    (ax, bx, cx), (ay, by, cy), (az, bz, cz) = (axis[corners] for axis in axes)
    return float(np.sum(ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)))
