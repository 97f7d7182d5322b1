# SPDX-License-Identifier: GPL-3.0-or-later
"""Preserves custom normals when the topology changes: the angles that Blender stores would then be meaningless."""

import bpy
import numpy as np

from . import edit_mode

_NAME = "minimum_ratio_contours_normals"


def store(obj, bm, faces):
    """Store the normals around these faces, given by index, before they are cut. Return whether there were any.

    The mesh must be synchronized. Earlier references to elements of the bmesh become invalid.
    """
    if not _are_angles(obj.data):
        return False
    normals = _read(obj.data)
    layer = bm.loops.layers.float_vector.new(_NAME)
    bm.faces.ensure_lookup_table()
    starts = np.empty(len(obj.data.polygons), dtype=np.int32)
    obj.data.polygons.foreach_get("loop_start", starts)
    vertices = {vertex for face in faces for vertex in bm.faces[face].verts}
    for face in {face for vertex in vertices for face in vertex.link_faces}:
        for corner, loop in enumerate(face.loops, starts[face.index]):
            loop[layer] = normals[corner]
    return True


def are_stored(mesh):
    """Whether a mesh has stored normals that have not been restored yet."""
    return _NAME in mesh.attributes


def restore(context):
    """Restore the stored normals of all meshes that have some. Leaves Edit Mode and enters it again."""
    with edit_mode.left(context):
        for mesh in bpy.data.meshes:
            if are_stored(mesh):
                restore_mesh(mesh)


def restore_mesh(mesh):
    """Restore the stored normals of one mesh outside Edit Mode."""
    stored = np.empty((len(mesh.loops), 3), dtype=np.float32)
    mesh.attributes[_NAME].data.foreach_get("vector", stored.reshape(-1))
    mesh.attributes.remove(mesh.attributes[_NAME])
    lengths = np.linalg.norm(stored, axis=1)
    normals = _read(mesh)
    normals[lengths > 0] = stored[lengths > 0] / lengths[lengths > 0, None]
    mesh.normals_split_custom_set(normals)


def _read(mesh):
    """Return the normal of every corner, (n, 3)."""
    normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
    if hasattr(mesh, "corner_normals"):
        mesh.corner_normals.foreach_get("vector", normals)
        return normals.reshape(-1, 3)
    smooth = mesh.use_auto_smooth  # up to Blender 4.0, custom normals take effect only with this
    mesh.use_auto_smooth = True
    mesh.calc_normals_split()
    mesh.loops.foreach_get("normal", normals)
    mesh.use_auto_smooth = smooth
    return normals.reshape(-1, 3)


def _are_angles(mesh):
    """Whether custom normals are angles. Since Blender 4.5 they may be vectors, cut like any other attribute."""
    vectors = mesh.attributes.get("custom_normal")
    return mesh.has_custom_normals and not (vectors and vectors.data_type == "FLOAT_VECTOR")
