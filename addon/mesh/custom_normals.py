# SPDX-License-Identifier: GPL-3.0-or-later
"""Carries custom normals over a change of topology: Blender stores them as angles that mean nothing afterwards."""

import bpy
import numpy as np

_NAME = "minimum_ratio_contours_normals"


def keep(obj, bm, faces):
    """Notes the normals round these faces, given by their ids, before they are cut; whether there were any to keep.

    The mesh must be synchronized. References to elements from before are dead afterwards.
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


def are_noted(mesh):
    """Whether there are normals on a mesh that were noted and not yet set again."""
    return _NAME in mesh.attributes


def restore(context):
    """Sets the normals that were noted, on all meshes that have some; leaves Edit Mode for it and comes back."""
    editing = context.objects_in_mode[:]
    selected = context.selected_objects[:]
    held = [obj for obj in editing if obj.hide_select]  # which could not be selected
    for obj in held:
        obj.hide_select = False
    for obj in selected:
        obj.select_set(obj in editing)
    bpy.ops.object.mode_set(mode="OBJECT")
    for mesh in bpy.data.meshes:
        if are_noted(mesh):
            set_noted(mesh)
    for obj in editing:
        obj.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    for obj in {*selected, *editing}:
        obj.select_set(obj in selected)
    for obj in held:
        obj.hide_select = True


def set_noted(mesh):
    """Sets those of a mesh outside Edit Mode."""
    noted = np.empty((len(mesh.loops), 3), dtype=np.float32)
    mesh.attributes[_NAME].data.foreach_get("vector", noted.reshape(-1))
    mesh.attributes.remove(mesh.attributes[_NAME])
    lengths = np.linalg.norm(noted, axis=1)
    normals = _read(mesh)
    normals[lengths > 0] = noted[lengths > 0] / lengths[lengths > 0, None]
    mesh.normals_split_custom_set(normals)


def _read(mesh):
    """The normal of every corner, (n, 3)."""
    normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
    if hasattr(mesh, "corner_normals"):
        mesh.corner_normals.foreach_get("vector", normals)
        return normals.reshape(-1, 3)
    smooth = mesh.use_auto_smooth  # up to Blender 4.0 custom normals count only with this
    mesh.use_auto_smooth = True
    mesh.calc_normals_split()
    mesh.loops.foreach_get("normal", normals)
    mesh.use_auto_smooth = smooth
    return normals.reshape(-1, 3)


def _are_angles(mesh):
    """Since Blender 4.5 custom normals may also be plain vectors, which are cut like any other attribute."""
    vectors = mesh.attributes.get("custom_normal")
    return mesh.has_custom_normals and not (vectors and vectors.data_type == "FLOAT_VECTOR")
