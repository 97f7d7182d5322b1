# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the output of contours in meshes in Edit Mode: marks, selection, cuts, rips and separate objects."""

from collections import defaultdict
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np

from ..core import edge_paths, messages
from . import attributes, culprits, custom_normals, cutting, edge_marks, edit_mode, matrix_attributes, separation
from .arrays import find_edges

SPLITTING = ("RIP", "SEPARATE")


@dataclass(frozen=True)
class OutputOptions:
    """The user's choice of output."""

    output: str
    keep_old: bool = False
    fill_holes: bool = False
    merge: float = 0.0


def refuse(tasks, options):
    """Give each contour a problem that the output cannot be made from; change nothing in the meshes.

    Only separating needs parts; a result separates the same things as the given contour, so this can be decided before
    the mesh changes.
    """
    if options.output != "SEPARATE":
        return
    for task in tasks:
        done = task.done()
        chains = [(outcome.vertices, outcome.closed) for outcome in done]
        bm = bmesh.from_edit_mesh(task.obj.data)  # its faces are valid only as long as this reference lives
        pieces = separation.pieces_between(bm, chains)
        leaving = _leaving(pieces, task.from_faces)
        for outcome, sides in zip(done, pieces):
            outcome.problem = _separating_problem(outcome, sides, leaving)


def _leaving(pieces, from_faces):
    """Return the pieces that become separate objects: in face mode those to the left, else all but the largest."""
    separated = [(left, right) for left, right in pieces if left is not right]
    if from_faces:
        return [left for left, _ in separated]
    leaving = []
    for group in _connected_groups(separated):
        stays = max(group, key=lambda piece: piece.size)
        leaving += [piece for piece in group if piece is not stays]
    return leaving


def _connected_groups(pairs):
    """Return lists of the items that pairs connect, in the order of the pairs."""
    groups = []
    for pair in pairs:
        touched = [group for group in groups if any(item in group for item in pair)]
        rest = [group for group in groups if group not in touched]
        groups = [*rest, list(dict.fromkeys([item for group in touched for item in group] + list(pair)))]
    return groups


def _separating_problem(outcome, sides, leaving):
    if sides[0] is sides[1]:
        return messages.inseparable(outcome)
    parts = [(piece, piece is sides[0]) for piece in sides if piece in leaving]
    for piece, _ in parts:
        piece.grow_fully()
    outcome.leaving = tuple(on_left for piece, on_left in parts if not piece.any_hidden)
    return messages.hidden_part(outcome) if parts and not outcome.leaving else ""


def write(context, tasks, options):
    """Make the output of all contours that have a result and no problem; select required vertices outside the bands.

    Return whether anything was written or selected. A contour around which nothing could be searched, or that a fault
    of the mesh holds, does not count: it is selected already.
    """
    outside = {task.obj: [("vertex", vertex) for vertex in task.outside] for task in tasks if len(task.outside)}
    possible = any(_is_possible(outcome, task, options) for task in tasks for outcome in task.done())
    if possible:
        _write(context, [task for task in tasks if task.done()], options)
    if outside:
        culprits.select(outside)
    return possible or bool(outside)


def _is_possible(outcome, task, options):
    changes_mesh = options.output not in ("SELECT", "CUT")
    stuck = outcome.result.status == "unchanged" and (outcome.result.reason_code == "no_room" or outcome.fault)
    completed = task.mirrored or outcome.closing or not outcome.as_selected
    return changes_mesh or completed or not stuck


def _write(context, tasks, options):
    meshes = [task.obj.data for task in tasks if options.fill_holes and options.output in SPLITTING]
    with matrix_attributes.as_colors(context, meshes):
        _write_all(context, tasks, options)


def _write_all(context, tasks, options):
    cuts = [_Cut(task, options) for task in tasks]
    for cut in cuts:
        cut.write()
    if options.output == "SEAM":
        edge_marks.unwrap_live(context, [task.obj.data for task in tasks])
    if options.output == "SEPARATE":
        _separate(context, cuts)
    if any(cut.normals_stored for cut in cuts):
        custom_normals.restore(context)


class _Cut:
    """Cuts the refined contours of one mesh into its faces and makes their output."""

    def __init__(self, task, options):
        self.mesh, self.options, self.from_faces = task.obj.data, options, task.from_faces
        self.bm = bmesh.from_edit_mesh(self.mesh)
        self.done = task.done()
        results = [outcome.result for outcome in self.done]
        self.changes_faces = options.output in SPLITTING or cutting.cuts_faces(self.bm, results)
        self.normals_stored = self.changes_faces and custom_normals.store(task.obj, self.bm, cutting.faces_cut(results))
        self._clear_old(task.old_edges(), task.edges_beside())
        self.strays = self._tidy_strays(*task.strays)
        copy_edges = bool(matrix_attributes.on(self.mesh, "EDGE"))
        ids = cutting.cut_contours(self.bm, results, options.merge, copy_edges)
        self.contours = [(vertices, result.closed) for vertices, result in zip(ids, results)]
        self.edges = self._edges_along(self.contours)
        self.seeds = []  # one face of each part to be separated

    def write(self):
        edge_marks.mark_found(self.edges, self.options.output)
        moved = self._move_selected_faces() if self.from_faces else set()
        self.seeds = [
            separation.adjacent_face(self.bm, *contour, on_left)
            for contour, outcome in zip(self.contours, self.done)
            for on_left in outcome.leaving
        ]
        if self.options.output in SPLITTING:
            self._rip()
        if self.from_faces:
            beside = {face for edge in self.edges for vertex in edge.verts for face in vertex.link_faces}
            _tidy_selection(moved | beside | {face for face in self.strays if face.is_valid})
        else:
            edge_marks.select_each([self.edges], True)
        edge_marks.flush_selection(self.bm)
        bmesh.update_edit_mesh(self.mesh, loop_triangles=self.changes_faces, destructive=self.changes_faces)

    def _edges_along(self, chains):
        return [edge for chain in chains for edge in separation.edges_along(self.bm, *chain)]

    def _clear_old(self, old_edges, beside):
        """Clear the marks and selection of the given edges, before the cut may split these edges.

        Edges that are left out beside them keep their marks.
        """
        edges = find_edges(self.bm, old_edges)
        edge_marks.clear_given(edges, self.options.output, self.options.keep_old)
        if not self.from_faces:
            edge_marks.select_each([edges, find_edges(self.bm, beside)], False)

    def _tidy_strays(self, islands=(), pinholes=()):
        """Deselect stray islands and select pinholes, by their faces, before the cut may split them; return all."""
        self.bm.faces.ensure_lookup_table()
        off, on = ([self.bm.faces[face] for face in faces] for faces in (islands, pinholes))
        edge_marks.select_each([off], False)
        edge_marks.select_each([on], True)
        return {*off, *on}

    def _move_selected_faces(self):
        """Select the faces to the left of the contours, deselect those to the right, and return what has changed."""
        walls = set(self.edges)
        left, right = zip(*(separation.adjacent_faces(self.bm, *contour) for contour in self.contours))
        gained = separation.connected_faces(sum(left, []), walls, lambda face: not (face.select or face.hide))
        lost = separation.connected_faces(sum(right, []), walls, lambda face: face.select)
        for faces, value in ((lost, False), (gained, True)):
            for face in faces:
                face.select_set(value)
        return gained | lost

    def _rip(self):
        """Rip the mesh along the contours, whose edges are those of both rims from now on. A slit leaves no hole."""
        loops = self._edges_along(contour for contour in self.contours if contour[1])
        slits = self._edges_along(contour for contour in self.contours if not contour[1])
        rims = self._split_edges(loops)
        if self.options.fill_holes:
            for face in bmesh.ops.holes_fill(self.bm, edges=rims, sides=0)["faces"]:
                face.hide_set(False)  # a new face may inherit this from a hidden neighbor
        self.edges = rims + self._split_edges(slits)
        for elements in (self.bm.verts, self.bm.edges):
            elements.index_update()

    def _split_edges(self, edges):
        """Split edges, and the vertices where they meet or the mesh ends. Return the edges of both rims.

        The operator of bmesh does the same, but goes through the whole mesh.
        """
        sides = [corner for edge in edges for corner in edge.link_loops]
        meeting = defaultdict(list)
        for edge in edges:
            for vertex in edge.verts:
                meeting[vertex].append(edge)
        for vertex, around in meeting.items():
            if len(around) > 1 or vertex.is_boundary:
                bmesh.utils.vert_separate(vertex, around)
        return list(dict.fromkeys(corner.edge for corner in sides))


def _tidy_selection(faces):
    """Select exactly the edges and vertices of selected faces, as face mode requires; cuts and rips leave others."""
    for element in {element for face in faces for element in (*face.edges, *face.verts)}:
        if not any(face.select for face in element.link_faces):
            element.select_set(False)
    for face in faces:
        if face.select:
            face.select_set(True)


def _separate(context, cuts):
    """Make each part a separate object; the rest keeps its selection.

    All parts of a mesh leave it at once, since each of Blender's operators goes through the whole mesh. Only then they
    are divided.
    """
    known = set(bpy.data.objects)
    seeds = [seed for cut in cuts for seed in cut.seeds]
    if not seeds:
        return
    with edge_marks.nothing_selected([obj.data for obj in context.objects_in_mode_unique_data]):
        edge_marks.select_each([seeds], True)
        bpy.ops.mesh.select_linked(delimit=set())
        bpy.ops.mesh.separate(type="SELECTED")
    if any(len(cut.seeds) > 1 for cut in cuts):
        _divide(context, [obj for obj in bpy.data.objects if obj not in known])


def _divide(context, objects):
    """Divide objects outside Edit Mode into their loose parts, which are halved until each has its object.

    Blender's own operator for loose parts is faster, but loses shape keys and custom normals.
    """
    known = {obj for obj in bpy.data.objects if obj not in objects}
    active, selected = context.view_layer.objects.active, objects[0].select_get()
    with edit_mode.left(context):
        while objects:
            objects = [part for obj in objects for part in _halves(context, obj)]
        context.view_layer.objects.active = active
    for obj in bpy.data.objects:
        if obj not in known:
            obj.select_set(selected)


def _halves(context, obj):
    """Divide an object so that each half has half of its loose parts. Return the halves; none if it has one part."""
    edges = attributes.values(obj.data.edges, "vertices", np.int32, 2)
    parts = np.unique(edge_paths.component_labels(edges, len(obj.data.vertices)))  # the first vertex of each
    if len(parts) == 1:
        return []
    known = set(bpy.data.objects)
    for other in context.selected_objects:
        other.select_set(False)
    context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    for vertex in parts[len(parts) // 2 :].tolist():
        bm.verts[vertex].link_faces[0].select_set(True)
    bpy.ops.mesh.select_linked(delimit=set())
    bpy.ops.mesh.separate(type="SELECTED")
    bpy.ops.object.mode_set(mode="OBJECT")
    return [obj, *(other for other in bpy.data.objects if other not in known)]
