# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole columns of a synchronized mesh as numpy arrays: one value, or row of values, for each element.

Since Blender 4 most properties of elements are kept in attributes, whose arrays are handed over in a hundredth of the
time. In Edit Mode a mesh does not show its attributes; but a copy of it does, and costs nothing where it shares them.
"""

from contextlib import contextmanager

import bpy
import numpy as np

_FEW = 1 / 16  # of a collection: so many elements are read one by one sooner than all at once
_BEHIND = {
    ("loops", "vertex_index"): ".corner_vert",
    ("loops", "edge_index"): ".corner_edge",
    ("edges", "vertices"): ".edge_verts",
    ("edges", "select"): ".select_edge",
    ("edges", "hide"): ".hide_edge",
    ("edges", "use_seam"): "uv_seam",
    ("edges", "use_edge_sharp"): "sharp_edge",
    ("polygons", "select"): ".select_poly",
    ("polygons", "hide"): ".hide_poly",
    ("polygons", "material_index"): "material_index",
}  # the attribute behind a property, which is missing where every element has the default, 0
if bpy.app.version < (5, 0, 0):
    del _BEHIND["edges", "use_seam"]  # it has had several names
if bpy.app.version < (4, 1, 0):
    _BEHIND.clear()  # copies are copied


@contextmanager
def with_attributes(obj):
    """The object's mesh, or for the time being a copy of it, that shows its attributes."""
    if not obj.data.is_editmode:
        yield obj.data
        return
    try:
        yield obj.to_mesh()
    finally:
        obj.to_mesh_clear()


def read(obj, collection, name, dtype, width=1):
    """A property of all vertices, edges, loops or polygons."""
    if (collection, name) not in _BEHIND:
        return values(getattr(obj.data, collection), name, dtype, width)
    with with_attributes(obj) as mesh:
        attribute = mesh.attributes.get(_BEHIND[collection, name])
        if attribute is None:
            return np.zeros(len(getattr(mesh, collection)), dtype=dtype)
        return values(attribute.data, "value", dtype, width)


def read_some(obj, collection, indices, name, dtype, width=1):
    """The same of some of the elements, given by their indices."""
    elements = getattr(obj.data, collection)
    if len(indices) > _FEW * len(elements):
        return read(obj, collection, name, dtype, width)[indices]
    rows = [getattr(elements[index], name) for index in indices.tolist()]
    return np.array([row[:] for row in rows] if width > 1 else rows, dtype=dtype).reshape(_shape(len(rows), width))


def values(elements, name, dtype, width=1):
    """A property of all elements of a collection."""
    column = np.empty(len(elements) * width, dtype=dtype)
    elements.foreach_get(name, column)
    return column.reshape(_shape(len(elements), width))


def face_offsets(obj):
    """Where each face's corners begin, and where the last one's end."""
    faces, corners = len(obj.data.polygons), len(obj.data.loops)
    if corners == 3 * faces:  # all are triangles
        return np.arange(0, corners + 1, 3, dtype=np.int32)
    return np.append(values(obj.data.polygons, "loop_start", np.int32), np.int32(corners))


def triangles(obj, corner_vertices):
    """The (n, 3) vertices of the triangles into which Blender divides the faces, in face order."""
    if len(corner_vertices) == 3 * len(obj.data.polygons):
        return corner_vertices.reshape(-1, 3)
    obj.data.calc_loop_triangles()
    return values(obj.data.loop_triangles, "vertices", np.int32, 3)


def _shape(count, width):
    return (count, width) if width > 1 else (count,)
