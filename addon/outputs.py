# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of the contours found, in the meshes in Edit Mode: flags, selection, cuts, rips, parts of their own."""

from contextlib import contextmanager
from dataclasses import dataclass

import bmesh
import bpy

from . import custom_normals, cutting, mesh_access, report, sides

FLAGS = {"SEAM": ("seam", True), "SHARP": ("smooth", False)}
PARTING = ("RIP", "SEPARATE")


@dataclass(frozen=True)
class Wish:
    """What the user asked for."""

    output: str
    keep_old: bool = False
    fill_holes: bool = False
    merge: float = 0.0
    face_mode: bool = False


def refuse(parts, wish):
    """Notes as problems the contours that the output cannot be made of; changes nothing.

    A result runs round the same things as the given contour, so that the mesh as it is can be asked.
    """
    if wish.output not in PARTING:
        return
    for part in parts:
        bm = bmesh.from_edit_mesh(part.obj.data)
        walls = {edge for outcome in part.done() for edge in sides.edges_along(bm, outcome.vertices, outcome.closed)}
        problems = [_parting_problem(bm, outcome, walls, wish) for outcome in part.done()]
        for outcome, problem in zip(part.done(), problems):
            outcome.problem = problem


def _parting_problem(bm, outcome, walls, wish):
    if wish.output == "RIP" and not outcome.closed:
        return ""  # a slit
    part = sides.part_cut_off(bm, outcome.vertices, outcome.closed, walls)
    if part is None:
        return report.inseparable(outcome)
    if wish.output == "SEPARATE":
        part = _wanted_part(bm, outcome.vertices, outcome.closed, walls, part, wish)
        if any(face.hide for face in part):
            return report.hidden_part(outcome)
    return ""


def changes_anything(parts, wish):
    """Whether the output differs from what is there: a contour that stays is selected already."""
    done = [outcome for part in parts for outcome in part.done()]
    return any(wish.output not in ("SELECT", "CUT") or outcome.result.status != "unchanged" for outcome in done)


def write(context, parts, wish):
    """Makes the output of all contours that have a result and no problem."""
    parts = [part for part in parts if part.done()]
    cut_parts = [_Cut(part, wish) for part in parts]
    for cut in cut_parts:
        cut.write()
    if wish.output == "SEAM" and context.tool_settings.use_edge_path_live_unwrap:
        unwrap_live([part.obj.data for part in parts])
    if wish.output == "SEPARATE":
        _separate(context, cut_parts)
    if any(cut.normals_kept for cut in cut_parts):
        custom_normals.restore(context)


class _Cut:
    """The contours of one mesh, cut into its faces where they are refined, and what is made of them."""

    def __init__(self, part, wish):
        self.mesh, self.wish = part.obj.data, wish
        self.bm = bmesh.from_edit_mesh(self.mesh)
        done = part.done()
        results = [outcome.result for outcome in done]
        self.changes_faces = wish.output in PARTING or cutting.cuts_faces(self.bm, results)
        self.normals_kept = self.changes_faces and custom_normals.keep(part.obj, self.bm, cutting.faces_cut(results))
        self._forget_old(part.old_edges())
        ids = cutting.cut_contours(self.bm, results, wish.merge)
        self.contours = [(vertices, result.closed) for vertices, result in zip(ids, results)]
        self.edges = self._edges_along(self.contours)
        self.seeds = []  # a face of each part to separate

    def write(self):
        if self.wish.output in FLAGS:
            _set_flag(self.edges, self.wish.output, True)
        moved = self._move_selected_faces() if self.wish.face_mode else set()
        if self.wish.output == "SEPARATE":
            self.seeds = self._part_seeds()
        if self.wish.output in PARTING:
            self._rip()
        if self.wish.face_mode:
            _tidy_selection(
                moved | {face for edge in self.edges for vertex in edge.verts for face in vertex.link_faces}
            )
        else:
            for edge in self.edges:
                edge.select_set(True)
        self.bm.select_flush_mode()
        self.bm.select_history.validate()
        bmesh.update_edit_mesh(self.mesh, loop_triangles=self.changes_faces, destructive=self.changes_faces)

    def _edges_along(self, chains):
        return [edge for chain in chains for edge in sides.edges_along(self.bm, *chain)]

    def _forget_old(self, old_edges):
        """Before the cut: afterwards the given edges may be in pieces."""
        edges = mesh_access.find_edges(self.bm, old_edges)
        if self.wish.output in FLAGS and not self.wish.keep_old:
            _set_flag(edges, self.wish.output, False)
        if not self.wish.face_mode:
            for edge in edges:
                edge.select_set(False)

    def _move_selected_faces(self):
        """The selected part lies to the left of its contours: what they passed over changes sides, and is returned."""
        walls = set(self.edges)
        left, right = zip(*(sides.beside(self.bm, *contour) for contour in self.contours))
        gained = sides.reach(sum(left, []), walls, lambda face: not (face.select or face.hide))
        lost = sides.reach(sum(right, []), walls, lambda face: face.select)
        for faces, value in ((lost, False), (gained, True)):
            for face in faces:
                face.select_set(value)
        return gained | lost

    def _part_seeds(self):
        """One face of each part that is cut off; contours round one part share it."""
        walls, seeds, known = set(self.edges), [], set()
        for contour in self.contours:
            part = sides.part_cut_off(self.bm, *contour, walls)
            part = _wanted_part(self.bm, *contour, walls, part, self.wish)
            if part.isdisjoint(known):
                seeds.append(next(iter(part)))
                known |= part
        return seeds

    def _rip(self):
        """The edges of both rims are the contours' from now on. A slit has no hole to fill."""
        loops = self._edges_along(contour for contour in self.contours if contour[1])
        slits = self._edges_along(contour for contour in self.contours if not contour[1])
        rims = bmesh.ops.split_edges(self.bm, edges=loops)["edges"]
        if self.wish.fill_holes:
            bmesh.ops.holes_fill(self.bm, edges=rims, sides=0)
        self.edges = rims + bmesh.ops.split_edges(self.bm, edges=slits)["edges"]


def _tidy_selection(faces):
    """In face mode edges and vertices are selected where a face of theirs is; cuts and rips leave others behind."""
    for element in {element for face in faces for element in (*face.edges, *face.verts)}:
        if not any(face.select for face in element.link_faces):
            element.select_set(False)
    for face in faces:
        if face.select:
            face.select_set(True)


def _wanted_part(bm, ids, closed, walls, smaller, wish):
    """In face mode the part of the selected faces, else the smaller of the two."""
    if not wish.face_mode:
        return smaller
    return sides.reach(sides.beside(bm, ids, closed)[0], walls, lambda face: True)


def _separate(context, cut_parts):
    """Makes each part an object of its own; the rest keeps its selection."""
    with _nothing_selected([obj.data for obj in context.objects_in_mode_unique_data]):
        for cut in cut_parts:
            for seed in cut.seeds:
                for face in sides.reach([seed], (), lambda face: True):
                    face.select_set(True)
                cut.bm.select_flush_mode()
                bpy.ops.mesh.separate(type="SELECTED")


@contextmanager
def _nothing_selected(meshes):
    """Deselects everything for Blender's own operators; afterwards what is left of it is selected again."""
    bms = [bmesh.from_edit_mesh(mesh) for mesh in meshes]
    selected = [
        [element for kind in (bm.verts, bm.edges, bm.faces) for element in kind if element.select] for bm in bms
    ]
    _select_each(selected, False)
    yield
    _select_each(selected, True)
    for mesh, bm in zip(meshes, bms):
        bm.select_flush_mode()
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def _select_each(element_lists, value):
    for elements in element_lists:
        for element in elements:
            if element.is_valid:
                element.select_set(value)


def _set_flag(edges, output, value):
    name, meaning = FLAGS[output]
    for edge in edges:
        setattr(edge, name, meaning if value else not meaning)


def unwrap_live(meshes):
    """Blender's own seam tool unwraps again where Live Unwrap is on; with nothing selected that is all that it does."""
    with _nothing_selected(meshes):
        bpy.ops.mesh.mark_seam(clear=False)
