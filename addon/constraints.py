# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads from a mesh's layers what constrains its contours."""

from contextlib import contextmanager

import bmesh
import numpy as np

from . import mesh_access, report
from .constraint_arrays import Constraints, face_means
from .parameters import CONSTRAINTS


def read(obj, **settings):
    """The Constraints that settings of the table ask for, of a synchronized mesh; None where they ask for none.

    Raises a ValueError where a layer is missing.
    """
    wanted = {name: row["default"] for name, row in CONSTRAINTS.items()} | settings
    named = any(wanted[name] for name in ("required_group", "barrier_marks", "attractor_group", "attractor_marks"))
    if not named and wanted["region_source"] == "NONE":
        return None
    arrays = mesh_access.read_arrays(obj)
    with _bmesh_of(obj) as bm:
        required = _group(obj, bm, wanted["required_group"])
        density = _density(obj, bm, arrays.face_offsets, wanted["region_source"], wanted["region_layer"])
        return Constraints(
            points=arrays.positions,
            face_offsets=arrays.face_offsets,
            face_vertices=arrays.face_vertices,
            required=np.flatnonzero(required > 0).astype(np.int32),
            barriers=_marked(bm, wanted["barrier_marks"]),
            pulls=_group(obj, bm, wanted["attractor_group"]),
            attracting=_marked(bm, wanted["attractor_marks"]),
            strength=wanted["attractor_strength"],
            radius=wanted["attractor_radius"],
            density=density,
            region_strength=wanted["region_strength"],
        )


@contextmanager
def _bmesh_of(obj):
    """In Edit Mode only the bmesh shows what is in a layer; in Object Mode one is made for the time being."""
    if obj.mode == "EDIT":
        yield bmesh.from_edit_mesh(obj.data)
        return
    bm = bmesh.new()
    try:
        bm.from_mesh(obj.data)
        yield bm
    finally:
        bm.free()


def _group(obj, bm, name):
    """The weights of all vertices in a vertex group; empty where none is named."""
    if not name:
        return np.empty(0)
    group = obj.vertex_groups.get(name)
    if group is None:
        raise ValueError(report.no_layer("vertex group", name))
    layer = bm.verts.layers.deform.active
    if layer is None:
        return np.zeros(len(bm.verts))
    return np.fromiter((vertex[layer].get(group.index, 0.0) for vertex in bm.verts), float, len(bm.verts))


def _marked(bm, marks):
    """The edges with one of the marks, as vertex pairs."""
    tests = {"SEAM": lambda edge: edge.seam, "SHARP": lambda edge: not edge.smooth, "CREASE": _is_creased(bm)}
    chosen = [tests[mark] for mark in sorted(marks)]
    pairs = [[v.index for v in edge.verts] for edge in bm.edges if any(test(edge) for test in chosen)]
    return np.array(pairs, dtype=np.int32).reshape(-1, 2)


def _is_creased(bm):
    layers = bm.edges.layers
    layer = layers.crease.active if hasattr(layers, "crease") else layers.float.get("crease_edge")
    return lambda edge: layer is not None and edge[layer] > 0


def _density(obj, bm, face_offsets, source, name):
    """A value for each face; None where no region is asked for."""
    if source == "NONE":
        return None
    if source == "GROUP":
        if not name:
            raise ValueError(report.no_layer("vertex group", name))
        return face_means(face_offsets, _at_corners(bm, _group(obj, bm, name)))
    if source == "ATTRIBUTE":
        return _face_attribute(bm, name)
    return _brightness(bm, name, face_offsets)


def _at_corners(bm, values):
    indices = (vertex.index for face in bm.faces for vertex in face.verts)
    return values[np.fromiter(indices, np.int32)]


def _face_attribute(bm, name):
    for kind in ("float", "int", "bool"):
        layer = getattr(bm.faces.layers, kind).get(name) if hasattr(bm.faces.layers, kind) else None
        if layer is not None:
            return np.fromiter((face[layer] for face in bm.faces), float, len(bm.faces))
    raise ValueError(report.no_layer("face attribute", name))


def _brightness(bm, name, face_offsets):
    """The mean of red, green and blue, of a colour attribute on vertices or corners, in bytes or floats."""
    for layers, elements in (
        (bm.verts.layers, lambda face: face.verts),
        (bm.loops.layers, lambda face: face.loops),
    ):
        layer = layers.color.get(name) or layers.float_color.get(name)
        if layer is not None:
            values = (sum(tuple(element[layer])[:3]) / 3 for face in bm.faces for element in elements(face))
            return face_means(face_offsets, np.fromiter(values, float))
    raise ValueError(report.no_layer("colour attribute", name))
