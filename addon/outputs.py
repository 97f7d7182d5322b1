# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of the contours found, in the meshes in Edit Mode: flags, selection, cuts, rips, parts of their own."""

from dataclasses import dataclass

import bmesh
import bpy

from . import custom_normals, cutting, flags, mesh_access, report, sides

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
        done = part.done()
        chains = [(outcome.vertices, outcome.closed) for outcome in done]
        bm = bmesh.from_edit_mesh(part.obj.data)  # faces live no longer than this
        pieces = sides.pieces_between(bm, chains)
        leaving = _leaving(pieces, wish)
        for outcome, beside in zip(done, pieces):
            outcome.problem = _parting_problem(outcome, beside, leaving, wish)


def _leaving(pieces, wish):
    """The pieces that become objects of their own: in face mode those to the left, else all but the largest."""
    if wish.output != "SEPARATE":
        return []
    parted = [(left, right) for left, right in pieces if left is not right]
    if wish.face_mode:
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


def _parting_problem(outcome, beside, leaving, wish):
    if wish.output == "RIP" and not outcome.closed:
        return ""  # a slit
    if beside[0] is beside[1]:
        return report.inseparable(outcome)
    parts = [(piece, piece is beside[0]) for piece in beside if piece in leaving]
    for piece, _ in parts:
        piece.finish()
    outcome.leaving = tuple(on_left for piece, on_left in parts if not piece.any_hidden)
    return report.hidden_part(outcome) if parts and not outcome.leaving else ""


def is_possible(parts, wish):
    """Whether anything can be output: a contour round which nothing could be searched is selected already, as given."""
    done = [(outcome, part.mirrored or outcome.closing) for part in parts for outcome in part.done()]
    flags_or_topology = wish.output not in ("SELECT", "CUT")
    return any(flags_or_topology or added or outcome.result.reason_code != "no_room" for outcome, added in done)


def write(context, parts, wish):
    """Makes the output of all contours that have a result and no problem."""
    parts = [part for part in parts if part.done()]
    cut_parts = [_Cut(part, wish) for part in parts]
    for cut in cut_parts:
        cut.write()
    if wish.output == "SEAM":
        flags.unwrap_live(context, [part.obj.data for part in parts])
    if wish.output == "SEPARATE":
        _separate(context, cut_parts)
    if any(cut.normals_kept for cut in cut_parts):
        custom_normals.restore(context)


def select_vertices(vertices_of):
    """Shows some vertices of objects: in vertex mode, they alone selected there; other objects keep their selection."""
    bpy.ops.mesh.select_mode(type="VERT")
    for obj, vertices in vertices_of.items():
        bm = bmesh.from_edit_mesh(obj.data)
        bm.verts.ensure_lookup_table()
        shown = [bm.verts[vertex] for vertex in vertices if not bm.verts[vertex].hide]
        flags.select_each([bm.verts], False)
        flags.select_each([shown], True)
        flags.flush_selection(bm)
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


class _Cut:
    """The contours of one mesh, cut into its faces where they are refined, and what is made of them."""

    def __init__(self, part, wish):
        self.mesh, self.wish = part.obj.data, wish
        self.bm = bmesh.from_edit_mesh(self.mesh)
        self.done = part.done()
        results = [outcome.result for outcome in self.done]
        self.changes_faces = wish.output in PARTING or cutting.cuts_faces(self.bm, results)
        self.normals_kept = self.changes_faces and custom_normals.keep(part.obj, self.bm, cutting.faces_cut(results))
        self._forget_old(part.old_edges())
        ids = cutting.cut_contours(self.bm, results, wish.merge)
        self.contours = [(vertices, result.closed) for vertices, result in zip(ids, results)]
        self.edges = self._edges_along(self.contours)
        self.seeds = []  # a face of each part that is cut off

    def write(self):
        if self.wish.output in flags.FLAGS:
            flags.set_flag(self.edges, self.wish.output, True)
        moved = self._move_selected_faces() if self.wish.face_mode else set()
        self.seeds = [
            sides.face_beside(self.bm, *contour, on_left)
            for contour, outcome in zip(self.contours, self.done)
            for on_left in outcome.leaving
        ]
        if self.wish.output in PARTING:
            self._rip()
        if self.wish.face_mode:
            _tidy_selection(
                moved | {face for edge in self.edges for vertex in edge.verts for face in vertex.link_faces}
            )
        else:
            flags.select_each([self.edges], True)
        flags.flush_selection(self.bm)
        bmesh.update_edit_mesh(self.mesh, loop_triangles=self.changes_faces, destructive=self.changes_faces)

    def _edges_along(self, chains):
        return [edge for chain in chains for edge in sides.edges_along(self.bm, *chain)]

    def _forget_old(self, old_edges):
        """Before the cut: afterwards the given edges may be in pieces."""
        edges = mesh_access.find_edges(self.bm, old_edges)
        if self.wish.output in flags.FLAGS and not self.wish.keep_old:
            flags.set_flag(edges, self.wish.output, False)
        if not self.wish.face_mode:
            flags.select_each([edges], False)

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

    def _rip(self):
        """The edges of both rims are the contours' from now on. A slit has no hole to fill."""
        loops = self._edges_along(contour for contour in self.contours if contour[1])
        slits = self._edges_along(contour for contour in self.contours if not contour[1])
        rims = bmesh.ops.split_edges(self.bm, edges=loops)["edges"]
        if self.wish.fill_holes:
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


def _separate(context, cut_parts):
    """Makes each part an object of its own; the rest keeps its selection."""
    with flags.nothing_selected([obj.data for obj in context.objects_in_mode_unique_data]):
        for cut in cut_parts:
            for seed in cut.seeds:
                if seed.is_valid:  # else another contour of the same part came first
                    seed.select_set(True)
                    bpy.ops.mesh.select_linked(delimit=set())
                    bpy.ops.mesh.separate(type="SELECTED")
