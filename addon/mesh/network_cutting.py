# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts networks whose contours run across faces into the mesh, so that they are networks along edges again."""

from contextlib import contextmanager
from dataclasses import replace

import bmesh
import bpy
import numpy as np

from ..core import networks
from ..core.region_check import RegionCheck
from ..core.topology import make_topology
from . import attributes, custom_normals, cutting, matrix_attributes
from .arrays import read_edge_arrays, read_labels, synchronize

_ORIGIN = "minimum_ratio_contours_origin"


def check_when_cut(obj, plan, merge=0.0):
    """Return the plan with as many contours taken as leave every region in one piece once they are cut in.

    They are cut into copies of a synchronized mesh until all regions are intact: only the mesh with the cuts tells
    which faces a border divides, and whether they are still connected. The mesh itself does not change.
    """
    if plan.region_check is not None:
        return plan
    lost = {}
    while True:
        tried = _with_lost(plan, lost)
        found = _lost_when_cut(obj, tried, merge) if tried.moved() else {}
        if not found:
            return tried
        lost |= found


def cut(obj, plan, merge=0.0):
    """Cut the contours that a checked plan takes into a synchronized mesh. Return the plan for the mesh with the cuts.

    Custom normals are stored on the mesh, to be restored once the plan is written.
    """
    if not plan.across_faces:
        return plan
    with _editing(obj) as bm:
        custom_normals.store(obj, bm, cutting.faces_cut(_results(plan)))
        given, paths = _cut(obj, bm, plan, merge)
    synchronize(obj)
    return networks.check_cut(plan, _topology(obj), given, paths)


def restore_normals(context, obj):
    """Restore the stored custom normals, once the plan is written."""
    if custom_normals.are_stored(obj.data):
        custom_normals.restore(context) if attributes.is_edited(obj) else custom_normals.restore_mesh(obj.data)


def _with_lost(plan, lost):
    """Return the plan with all new paths taken except the lost ones."""
    unchanged = np.arange(plan.topology.face_count)
    taken = [path is not None and i not in lost for i, path in enumerate(plan.paths)]
    return replace(plan, region_check=RegionCheck(taken, dict(lost), unchanged, unchanged))


def _lost_when_cut(obj, plan, merge):
    """Return the contours of the plan that must stay after all, each with a face of the region it removes, or -1."""
    with _copy(obj) as bm:
        origin = bm.faces.layers.int.new(_ORIGIN)
        for i, face in enumerate(bm.faces):
            face[origin] = i
        try:
            given, paths = _cut(obj, bm, plan, merge)
        except cutting.Crossing as crossing:
            return {i: -1 for i in plan.moved() if crossing.face in plan.results[i].segment_faces}
        topology, origins = _read_copy(bm)
    lost = networks.check_cut(plan, topology, given, paths).region_check.lost
    return {i: int(origins[region]) if region >= 0 else -1 for i, region in lost.items()}


def _cut(obj, bm, plan, merge):
    """Cut the contours of a plan; return the vertices of all chains and of all new paths in the mesh with the cuts."""
    chains = [np.append(chain.vertices, chain.vertices[: chain.closed]).tolist() for chain in plan.chains]
    copy_edges = bool(matrix_attributes.on(obj.data, "EDGE"))
    ids, followed = cutting.cut_and_follow(bm, _results(plan), chains, merge, copy_edges)
    paths = dict(zip(plan.moved(), ids))
    given = [path[: len(path) - chain.closed] for path, chain in zip(followed, plan.chains)]
    return given, [paths.get(i) for i in range(len(given))]


def _results(plan):
    return [plan.results[i] for i in plan.moved()]


def _topology(obj):
    return make_topology(**vars(read_edge_arrays(obj)))


@contextmanager
def _copy(obj):
    """Yield a bmesh copy of the mesh, with elements in the same order."""
    bm = bmesh.from_edit_mesh(obj.data).copy() if attributes.is_edited(obj) else _loaded(obj.data)
    try:
        yield bm
    finally:
        bm.free()


@contextmanager
def _editing(obj):
    """Yield the mesh itself as a bmesh, and write its changes back at the end."""
    mesh = obj.data
    if attributes.is_edited(obj):
        bm = bmesh.from_edit_mesh(mesh)
        yield bm
        bm.select_flush_mode()
        bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=True)
        return
    bm = _loaded(mesh)
    try:
        yield bm
        bm.to_mesh(mesh)
    finally:
        bm.free()
    mesh.update()


def _loaded(mesh):
    bm = bmesh.new()
    bm.from_mesh(mesh)
    return bm


def _read_copy(bm):
    """Return the topology of a bmesh and the original face of each face, by way of a mesh, whose arrays are fast."""
    mesh = bpy.data.meshes.new(_ORIGIN)
    obj = bpy.data.objects.new(_ORIGIN, mesh)
    try:
        bm.to_mesh(mesh)
        return _topology(obj), read_labels(obj, _ORIGIN)
    finally:
        bpy.data.objects.remove(obj)
        bpy.data.meshes.remove(mesh)
