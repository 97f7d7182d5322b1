# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of the contours found, in the meshes in Edit Mode: marks, selection, cuts, rips, parts of their own."""

from dataclasses import dataclass

import bmesh
import bpy

from ..core import messages
from . import custom_normals, cutting, edge_marks, separation
from .arrays import find_edges

PARTING = ("RIP", "SEPARATE")


@dataclass(frozen=True)
class OutputOptions:
    """What the user asked for."""

    output: str
    keep_old: bool = False
    fill_holes: bool = False
    merge: float = 0.0


def refuse(tasks, options):
    """Notes as problems the contours that the output cannot be made of; changes nothing.

    A result runs round the same things as the given contour, so that the mesh as it is can be asked.
    """
    if options.output not in PARTING:
        return
    for task in tasks:
        done = task.done()
        chains = [(outcome.vertices, outcome.closed) for outcome in done]
        bm = bmesh.from_edit_mesh(task.obj.data)  # faces live no longer than this
        pieces = separation.pieces_between(bm, chains)
        leaving = _leaving(pieces, task.from_faces) if options.output == "SEPARATE" else []
        for outcome, beside in zip(done, pieces):
            outcome.problem = _parting_problem(outcome, beside, leaving, options)


def _leaving(pieces, from_faces):
    """The pieces that become objects of their own: in face mode those to the left, else all but the largest."""
    parted = [(left, right) for left, right in pieces if left is not right]
    if from_faces:
        return [left for left, _ in parted]
    leaving = []
    for group in _joined_groups(parted):
        stays = max(group, key=lambda piece: piece.size)
        leaving += [piece for piece in group if piece is not stays]
    return leaving


def _joined_groups(pairs):
    """Lists of what is joined by pairs, in the order of the pairs."""
    groups = []
    for pair in pairs:
        touched = [group for group in groups if any(item in group for item in pair)]
        rest = [group for group in groups if group not in touched]
        groups = [*rest, list(dict.fromkeys([item for group in touched for item in group] + list(pair)))]
    return groups


def _parting_problem(outcome, beside, leaving, options):
    if options.output == "RIP" and not outcome.closed:
        return ""  # a slit
    if beside[0] is beside[1]:
        return messages.inseparable(outcome)
    parts = [(piece, piece is beside[0]) for piece in beside if piece in leaving]
    for piece, _ in parts:
        piece.finish()
    outcome.leaving = tuple(on_left for piece, on_left in parts if not piece.any_hidden)
    return messages.hidden_part(outcome) if parts and not outcome.leaving else ""


def write(context, tasks, options):
    """Makes the output of all contours that have a result and no problem, and shows what kept others from one.

    Whether anything was written or shown: a contour round which nothing could be searched is selected already, as
    given.
    """
    outside = {task.obj: task.outside for task in tasks if len(task.outside)}
    possible = any(_is_possible(outcome, task, options) for task in tasks for outcome in task.done())
    if possible:
        _write(context, [task for task in tasks if task.done()], options)
    if outside:
        select_vertices(outside)
    return possible or bool(outside)


def select_vertices(vertices_of):
    """Shows some vertices of objects: in vertex mode, they alone selected there; other objects keep their selection."""
    bpy.ops.mesh.select_mode(type="VERT")
    for obj, vertices in vertices_of.items():
        bm = bmesh.from_edit_mesh(obj.data)
        bm.verts.ensure_lookup_table()
        shown = [bm.verts[vertex] for vertex in vertices if not bm.verts[vertex].hide]
        edge_marks.select_each([bm.verts], False)
        edge_marks.select_each([shown], True)
        edge_marks.flush_selection(bm)
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


def _is_possible(outcome, task, options):
    changes_mesh = options.output not in ("SELECT", "CUT")
    return changes_mesh or task.mirrored or outcome.closing or outcome.result.reason_code != "no_room"


def _write(context, tasks, options):
    cuts = [_Cut(task, options) for task in tasks]
    for cut in cuts:
        cut.write()
    if options.output == "SEAM":
        edge_marks.unwrap_live(context, [task.obj.data for task in tasks])
    if options.output == "SEPARATE":
        _separate(context, cuts)
    if any(cut.normals_kept for cut in cuts):
        custom_normals.restore(context)


class _Cut:
    """The contours of one mesh, cut into its faces where they are refined, and what is made of them."""

    def __init__(self, task, options):
        self.mesh, self.options, self.from_faces = task.obj.data, options, task.from_faces
        self.bm = bmesh.from_edit_mesh(self.mesh)
        self.done = task.done()
        results = [outcome.result for outcome in self.done]
        self.changes_faces = options.output in PARTING or cutting.cuts_faces(self.bm, results)
        self.normals_kept = self.changes_faces and custom_normals.keep(task.obj, self.bm, cutting.faces_cut(results))
        self._forget_old(task.old_edges())
        ids = cutting.cut_contours(self.bm, results, options.merge)
        self.contours = [(vertices, result.closed) for vertices, result in zip(ids, results)]
        self.edges = self._edges_along(self.contours)
        self.seeds = []  # a face of each part that is cut off

    def write(self):
        if self.options.output in edge_marks.MARKS:
            edge_marks.set_mark(self.edges, self.options.output, True)
        moved = self._move_selected_faces() if self.from_faces else set()
        self.seeds = [
            separation.face_beside(self.bm, *contour, on_left)
            for contour, outcome in zip(self.contours, self.done)
            for on_left in outcome.leaving
        ]
        if self.options.output in PARTING:
            self._rip()
        if self.from_faces:
            _tidy_selection(
                moved | {face for edge in self.edges for vertex in edge.verts for face in vertex.link_faces}
            )
        else:
            edge_marks.select_each([self.edges], True)
        edge_marks.flush_selection(self.bm)
        bmesh.update_edit_mesh(self.mesh, loop_triangles=self.changes_faces, destructive=self.changes_faces)

    def _edges_along(self, chains):
        return [edge for chain in chains for edge in separation.edges_along(self.bm, *chain)]

    def _forget_old(self, old_edges):
        """Before the cut: afterwards the given edges may be in pieces."""
        edges = find_edges(self.bm, old_edges)
        if self.options.output in edge_marks.MARKS and not self.options.keep_old:
            edge_marks.set_mark(edges, self.options.output, False)
        if not self.from_faces:
            edge_marks.select_each([edges], False)

    def _move_selected_faces(self):
        """The selected part lies to the left of its contours: what they passed over changes sides, and is returned."""
        walls = set(self.edges)
        left, right = zip(*(separation.beside(self.bm, *contour) for contour in self.contours))
        gained = separation.reach(sum(left, []), walls, lambda face: not (face.select or face.hide))
        lost = separation.reach(sum(right, []), walls, lambda face: face.select)
        for faces, value in ((lost, False), (gained, True)):
            for face in faces:
                face.select_set(value)
        return gained | lost

    def _rip(self):
        """The edges of both rims are the contours' from now on. A slit has no hole to fill."""
        loops = self._edges_along(contour for contour in self.contours if contour[1])
        slits = self._edges_along(contour for contour in self.contours if not contour[1])
        rims = bmesh.ops.split_edges(self.bm, edges=loops)["edges"]
        if self.options.fill_holes:
            for face in bmesh.ops.holes_fill(self.bm, edges=rims, sides=0)["faces"]:
                face.hide_set(False)  # it takes after a neighbor
        self.edges = rims + bmesh.ops.split_edges(self.bm, edges=slits)["edges"]


def _tidy_selection(faces):
    """In face mode edges and vertices are selected where a face of theirs is; cuts and rips leave others behind."""
    for element in {element for face in faces for element in (*face.edges, *face.verts)}:
        if not any(face.select for face in element.link_faces):
            element.select_set(False)
    for face in faces:
        if face.select:
            face.select_set(True)


def _separate(context, cuts):
    """Makes each part an object of its own; the rest keeps its selection."""
    with edge_marks.nothing_selected([obj.data for obj in context.objects_in_mode_unique_data]):
        for cut in cuts:
            for seed in cut.seeds:
                if seed.is_valid:  # else another contour of the same part came first
                    seed.select_set(True)
                    bpy.ops.mesh.select_linked(delimit=set())
                    bpy.ops.mesh.separate(type="SELECTED")
