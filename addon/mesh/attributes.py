# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads whole attributes of a synchronized mesh as numpy arrays: one value, or row of values, for each element.

Blender fills an array of exactly its own type ten times as fast. Since Blender 4, many properties of elements are
stored as attributes, whose arrays are copied as they are. A mesh in Edit Mode does not show its attributes, but a copy
of it does, and the copy costs nothing where it shares the arrays.
"""

from contextlib import contextmanager

import bpy
import numpy as np

_UNSIGNED = ("vertices", "vertex_index", "edge_index", "loop_start")
_ATTRIBUTES = {
    ("loops", "vertex_index"): ".corner_vert",
    ("loops", "edge_index"): ".corner_edge",
    ("edges", "select"): ".select_edge",
    ("edges", "hide"): ".hide_edge",
    ("edges", "use_seam"): "uv_seam",
    ("edges", "use_edge_sharp"): "sharp_edge",
    ("polygons", "select"): ".select_poly",
    ("polygons", "hide"): ".hide_poly",
    ("polygons", "material_index"): "material_index",
}  # the attribute that stores a property; it is missing if every element has the default, 0
_TYPES = {bool: "BOOLEAN", np.int32: "INT"}
if bpy.app.version < (5, 0, 0):
    del _ATTRIBUTES["edges", "use_seam"]  # earlier releases named it differently
if bpy.app.version < (4, 1, 0):
    _ATTRIBUTES.clear()  # here a copy does not share its arrays


def is_edited(obj):
    """Whether the object's mesh is in Edit Mode, possibly through another object that shares it."""
    return obj.data.is_editmode


@contextmanager
def with_attributes(obj):
    """Yield the object's mesh, or in Edit Mode a temporary copy of it that shows its attributes."""
    if not is_edited(obj):
        yield obj.data
        return
    try:
        yield obj.to_mesh()
    finally:
        obj.to_mesh_clear()


def read(obj, collection, name, dtype, width=1):
    """Return a property of all edges, loops, polygons or triangles."""
    if (collection, name) not in _ATTRIBUTES:
        return values(getattr(obj.data, collection), name, dtype, width)
    with with_attributes(obj) as mesh:
        attribute = mesh.attributes.get(_ATTRIBUTES[collection, name])
        if attribute is None:
            return np.zeros(len(getattr(mesh, collection)), dtype=dtype)
        if attribute.data_type != _TYPES[dtype]:  # Blender 5.0 gives the selection a wrong type when it adds edges
            return values(getattr(mesh, collection), name, dtype)
        return values(attribute.data, "value", dtype)


def values(elements, name, dtype, width=1):
    """Return a property of all elements of a collection."""
    array = np.empty(len(elements) * width, dtype=np.uint32 if name in _UNSIGNED else dtype)
    elements.foreach_get(name, array)
    array = array.view(dtype) if name in _UNSIGNED else array
    return array.reshape(-1, width) if width > 1 else array


def face_offsets(obj):
    """Return where the corners of each face begin, and at the end the number of corners."""
    return np.append(read(obj, "polygons", "loop_start", np.int32), np.int32(len(obj.data.loops)))


def triangles(obj, corner_vertices):
    """Return the (n, 3) vertices of the triangles into which Blender divides the faces, in face order."""
    if len(corner_vertices) == 3 * len(obj.data.polygons):  # all are triangles
        return corner_vertices.reshape(-1, 3)
    obj.data.calc_loop_triangles()
    return read(obj, "loop_triangles", "vertices", np.int32, 3)
