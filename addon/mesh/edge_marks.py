# SPDX-License-Identifier: GPL-3.0-or-later
"""Seam and sharp marks, which move with a contour or stay, the selection, and Live Unwrap for new seams."""

from contextlib import contextmanager

import bmesh
import bpy

from .arrays import find_edges

MARKS = {"SEAM": ("seam", True), "SHARP": ("smooth", False)}


def move_mark(mesh, output, old_edges, new_edges, selection=False):
    """Move a mark, and with `selection` the selection too, from edges to others, both given as vertex pairs."""
    bm = bmesh.from_edit_mesh(mesh)
    for pairs, value in ((old_edges, False), (new_edges, True)):
        edges = find_edges(bm, pairs)
        set_mark(edges, output, value)
        if selection:
            select_each([edges], value)
    if selection:
        flush_selection(bm)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def clear_given(edges, output, keep_old):
    """Clear the mark along a given contour, so that it moves with the contour, unless it is to be kept."""
    if output in MARKS and not keep_old:
        set_mark(edges, output, False)


def mark_found(edges, output):
    """Set the output's mark along a contour that was found; other outputs leave marks alone."""
    if output in MARKS:
        set_mark(edges, output, True)


def unwrap_live(context, meshes):
    """Unwrap again if Live Unwrap is on. Blender's seam operator does that, and nothing else if nothing is selected."""
    if not context.tool_settings.use_edge_path_live_unwrap:
        return
    with nothing_selected(meshes):
        bpy.ops.mesh.mark_seam(clear=False)


def set_mark(edges, output, value):
    name, meaning = MARKS[output]
    for edge in edges:
        setattr(edge, name, meaning if value else not meaning)


def select_each(element_lists, value):
    for elements in element_lists:
        for element in elements:
            if element.is_valid:
                element.select_set(value)


def flush_selection(bm):
    """Update all that depends on the selection, according to the select mode."""
    bm.select_flush_mode()
    bm.select_history.validate()


@contextmanager
def nothing_selected(meshes):
    """Deselect everything for Blender's own operators, and select what is left of it again afterwards."""
    bms = [bmesh.from_edit_mesh(mesh) for mesh in meshes]
    selected = [
        [element for kind in (bm.verts, bm.edges, bm.faces) for element in kind if element.select] for bm in bms
    ]
    select_each(selected, False)
    yield
    select_each(selected, True)
    for mesh, bm in zip(meshes, bms):
        bm.select_flush_mode()
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
