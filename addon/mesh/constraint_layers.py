# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the constraints of contours from a mesh's layers."""

import bmesh
import bpy
import numpy as np

from ..core import messages
from ..core.native_constraints import Constraints, face_means
from ..core.parameters import CONSTRAINTS
from . import attributes
from .arrays import read_arrays

_FACE_TYPES = {"FLOAT": np.float32, "INT": np.int32, "BOOLEAN": bool}


def read(obj, **settings):
    """Return the Constraints of a synchronized mesh for some of the CONSTRAINTS settings; None if they name no layer.

    Raises a ValueError if a layer is missing.
    """
    values = {name: row["default"] for name, row in CONSTRAINTS.items()} | settings
    named = any(values[name] for name in ("required_group", "barrier_marks", "attractor_group", "attractor_marks"))
    if not named and values["region_source"] == "NONE":
        return None
    arrays = read_arrays(obj)
    required = _group(obj, values["required_group"])
    return Constraints(
        points=arrays.positions,
        face_offsets=arrays.face_offsets,
        face_vertices=arrays.face_vertices,
        required=np.flatnonzero(required > 0).astype(np.int32),
        barriers=_marked(obj, values["barrier_marks"]),
        pulls=_group(obj, values["attractor_group"]),
        attracting=_marked(obj, values["attractor_marks"]),
        strength=values["attractor_strength"],
        radius=values["attractor_radius"],
        density=_density(obj, arrays, values["region_source"], values["region_layer"]),
        region_strength=values["region_strength"],
    )


def _group(obj, name):
    """Return the weights of all vertices in a vertex group; empty if no group is named."""
    if not name:
        return np.empty(0)
    group = obj.vertex_groups.get(name)
    if group is None:
        raise ValueError(messages.no_layer("vertex group", name))
    return (_weights_in_edit_mode if attributes.is_edited(obj) else _weights)(obj.data, group.index)


def _weights_in_edit_mode(mesh, index):
    """Read the weights from bmesh, which takes half as long as reading them from the mesh."""
    bm = bmesh.from_edit_mesh(mesh)
    layer = bm.verts.layers.deform.active
    if layer is None:
        return np.zeros(len(bm.verts))
    return np.fromiter((vertex[layer].get(index, 0.0) for vertex in bm.verts), float, len(bm.verts))


def _weights(mesh, index):
    weights = np.zeros(len(mesh.vertices))
    for i, vertex in enumerate(mesh.vertices):
        for element in vertex.groups:
            if element.group == index:
                weights[i] = element.weight
    return weights


def _marked(obj, marks):
    """Return the edges with any of the marks, as vertex pairs."""
    if not marks:
        return np.empty((0, 2), dtype=np.int32)
    readers = {
        "SEAM": lambda: attributes.read(obj, "edges", "use_seam", bool),
        "SHARP": lambda: attributes.read(obj, "edges", "use_edge_sharp", bool),
        "CREASE": lambda: _creases(obj) > 0,
    }
    marked = np.any([readers[mark]() for mark in sorted(marks)], axis=0)
    return attributes.read(obj, "edges", "vertices", np.int32, 2)[marked]


def _creases(obj):
    if bpy.app.version < (4, 0, 0):
        return attributes.read(obj, "edges", "crease", np.float32)
    with attributes.with_attributes(obj) as mesh:
        attribute = mesh.attributes.get("crease_edge")
        return attributes.values(attribute.data, "value", np.float32) if attribute else np.zeros(len(mesh.edges))


def _density(obj, arrays, source, name):
    """Return a value for each face; None if no region is wanted."""
    if source == "NONE":
        return None
    if source == "GROUP":
        if not name:
            raise ValueError(messages.no_layer("vertex group", name))
        return face_means(arrays.face_offsets, _group(obj, name)[arrays.face_vertices])
    return (_face_attribute if source == "ATTRIBUTE" else _brightness)(obj, arrays, name)


def _face_attribute(obj, _, name):
    with attributes.with_attributes(obj) as mesh:
        layer = mesh.attributes.get(name)
        if layer is None or layer.domain != "FACE" or layer.data_type not in _FACE_TYPES:
            raise ValueError(messages.no_layer("face attribute", name))
        return attributes.values(layer.data, "value", _FACE_TYPES[layer.data_type]).astype(float)


def _brightness(obj, arrays, name):
    """Return the mean of red, green and blue of a color attribute, on vertices or corners, in bytes or floats."""
    with attributes.with_attributes(obj) as mesh:
        layer = mesh.color_attributes.get(name)
        if layer is None:
            raise ValueError(messages.no_layer("color attribute", name))
        field = "color_srgb" if layer.data_type == "BYTE_COLOR" else "color"  # as it is stored
        values = attributes.values(layer.data, field, np.float32, 4)[:, :3].mean(axis=1, dtype=float)
        at_corners = values[arrays.face_vertices] if layer.domain == "POINT" else values
    return face_means(arrays.face_offsets, at_corners)
