# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts contours into the faces that they cross, by bmesh alone; nothing is marked or selected here."""

from collections import defaultdict
from itertools import pairwise

import bmesh
import numpy as np
from mathutils import Vector
from mathutils.geometry import intersect_point_line

from ..core.contour_points import contour_points, merge_points, without_points_along_edges

_FLAT = 1e-6  # of the perimeter squared: a piece of a face with less area than this has none
_STRAIGHT = 1e-5  # of a segment: a bend smaller than this is none


class Crossing(ValueError):
    """Two contours cross each other, which cannot be cut at once."""

    def __init__(self, face):
        self.face = face  # its id before the cut
        super().__init__(f"contours cross each other in face {face}: cut them one after the other")


def cut_contours(bm, contours, merge=0.0):
    """Cuts native results, or contours like them, into a mesh; gives for each the ids of its vertices in order.

    From one vertex of that list to the next there is an edge: a cut contour is what a contour along edges was before.
    The ids are those after the cut, when bmesh may have renumbered what was there. All contours are of the mesh as it
    is, and do not cross each other.
    Points closer to a vertex than `merge` of their edge are moved onto it, so that the contour gives way by as much and
    leaves no slivers.
    """
    return cut_and_follow(bm, contours, [], merge)[0]


def cut_and_follow(bm, contours, edge_paths, merge=0.0):
    """The same; and for paths along edges, as lists of vertex ids, the ids of all vertices along them after the cut."""
    closed = [contour.closed for contour in contours]
    paths = [without_points_along_edges(contour_points(contour), contour.closed) for contour in contours]
    paths = merge_points(paths, closed, merge, _edges_of_hidden_faces(bm, paths), _border_vertices(bm, paths))
    if not _leaves_edges(bm, paths, closed):
        return [np.array([point.a for point in path]) for path in paths], [np.array(path) for path in edge_paths]
    knife = _Knife(bm, paths, {vertex for path in edge_paths for vertex in path})
    followed = [knife.follow(path) for path in edge_paths]
    cut = [knife.cut(path, is_closed) for path, is_closed in zip(paths, closed)]
    knife.finish()
    return [_ids(vertices) for vertices in cut], [_ids(vertices) for vertices in followed]


def cuts_faces(bm, contours):
    """Whether one of the contours leaves the edges of the mesh."""
    return _leaves_edges(
        bm, [contour_points(contour) for contour in contours], [contour.closed for contour in contours]
    )


def faces_cut(contours):
    """The ids of the faces that hold a segment of one of the contours."""
    return np.unique(np.concatenate([np.asarray(contour.segment_faces) for contour in contours]))


def _ids(vertices):
    return np.array([vertex.index for vertex in vertices], dtype=np.int32)


class _Knife:
    """What the mesh was before the first cut, and what its elements have become."""

    def __init__(self, bm, paths, followed=frozenset()):
        self.bm = bm
        for sequence in (bm.verts, bm.edges, bm.faces):
            sequence.index_update()
            sequence.ensure_lookup_table()
        all_points = [point for path in paths for point in path]
        ids = {point.face for point in all_points}
        known = {vertex for point in all_points for vertex in (point.a, point.b)} | followed
        self.given = {vertex: bm.verts[vertex] for vertex in known}
        self.pieces = {face: [bm.faces[face]] for face in ids}  # of each face
        self.sides = {face: {_pair(edge.verts) for edge in bm.faces[face].edges} for face in ids}
        self.vertices = {}  # by the place of their point
        self.inner = {point.place: self._position(point) for point in all_points if self._is_inner(point)}
        self._split_edges(all_points)

    def cut(self, path, closed):
        """The vertices along a path, whose faces are split where it crosses them."""
        first = next(i for i, point in enumerate(path) if point.place not in self.inner)
        path = path[first:] + path[: first + 1] if closed else path
        vertices, bends = [self._vertex(path[0])], []
        for point, following in pairwise(path):
            if following.place in self.inner:
                bends.append(following)
                continue
            vertices += self._connect(vertices[-1], self._vertex(following), bends, point.face)
            bends = []
        return vertices[:-1] if closed else vertices

    def follow(self, path):
        """The vertices along a path of old edges: those that it had, and those that were put between them."""
        between = defaultdict(list)
        for a, b, t in sorted(self.vertices):
            between[a, b].append(self.vertices[a, b, t])
            between[b, a].insert(0, self.vertices[a, b, t])
        return [self.given[path[0]]] + [v for a, b in pairwise(path) for v in (*between.get((a, b), ()), self.given[b])]

    def finish(self):
        """Ids and normals of what is new."""
        self.bm.verts.index_update()
        self.bm.edges.index_update()
        self.bm.faces.index_update()
        faces = [face for pieces in self.pieces.values() for face in pieces]
        for face in faces:
            face.normal_update()
        for vertex in {vertex for face in faces for vertex in face.verts}:
            vertex.normal_update()

    def _is_inner(self, point):
        """Points on a diagonal lie inside a polygon, of which no side is their edge."""
        return not point.is_vertex and (point.a, point.b) not in self.sides[point.face]

    def _position(self, point):
        return self.given[point.a].co.lerp(self.given[point.b].co, point.t)

    def _vertex(self, point):
        return self.given[point.a] if point.is_vertex else self.vertices[point.place]

    def _split_edges(self, all_points):
        """Puts a vertex wherever a contour crosses an edge, from the far end on: each fraction is of what is left."""
        parameters = defaultdict(set)
        for point in all_points:
            if not point.is_vertex and point.place not in self.inner:
                parameters[point.a, point.b].add(point.t)
        for a, b in sorted(parameters):
            near, left = self.given[a], 1.0
            edge = self.bm.edges.get((near, self.given[b]))
            for t in sorted(parameters[a, b], reverse=True):
                edge, self.vertices[a, b, t] = bmesh.utils.edge_split(edge, near, t / left)
                left = t

    def _connect(self, start, end, bends, face_id):
        """The vertices after `start` up to `end`, along edges that are there or are cut now."""
        bends = self._real_bends(start.co, bends, end.co)
        points = [self.inner[bend.place] for bend in bends]
        if not bends and self.bm.edges.get((start, end)):
            return [end]
        face = self._piece(face_id, start, end)
        sides = _sides(face, start, end)
        for side in sides:
            if len(side) == 2 or _is_flat([vertex.co for vertex in side] + points[::-1]):
                return side[1:]  # a cut would leave a piece without area: walk along the face's side instead
        new, corner = bmesh.utils.face_split(face, start, end, coords=points)
        new.select_set(face.select)  # a cut selected face stays selected whole
        self.pieces[face_id].append(new)
        vertices = _along(corner, start, end)
        for vertex, bend in zip(vertices, bends):  # a diagonal knows better than the whole polygon, which may be bent
            vertex.copy_from_vert_interp((self.given[bend.a], self.given[bend.b]), bend.t)
        return vertices

    def _real_bends(self, start, bends, end):
        """Without those that lie on the straight line between their neighbors."""
        points = [self.inner[bend.place] for bend in bends]
        kept, last = [], start
        for bend, point, following in zip(bends, points, [*points[1:], end]):
            on_line = intersect_point_line(point, last, following)[0]
            if (point - on_line).length > _STRAIGHT * (following - last).length:
                kept.append(bend)
                last = point
        return kept

    def _piece(self, face_id, start, end):
        """The piece of a face that has both vertices."""
        found = [piece for piece in self.pieces[face_id] if start in piece.verts and end in piece.verts]
        if not found:
            raise Crossing(face_id)
        return found[0]


def _pair(vertices):
    return tuple(sorted(vertex.index for vertex in vertices))


def _edges_of_hidden_faces(bm, paths):
    """The edges crossed or touched that a hidden face shares, which must stay as it is."""
    bm.verts.ensure_lookup_table()
    touched = {(point.a, point.b) for path in paths for point in path if not point.is_vertex}
    edges = {pair: bm.edges.get((bm.verts[pair[0]], bm.verts[pair[1]])) for pair in touched}
    return {pair for pair, edge in edges.items() if edge and any(face.hide for face in edge.link_faces)}


def _border_vertices(bm, paths):
    """The ends of edges crossed that lie on the border of the mesh, where a contour would have no side any more."""
    ends = {vertex for path in paths for point in path for vertex in (point.a, point.b)}
    return {vertex for vertex in ends if bm.verts[vertex].is_boundary}


def _leaves_edges(bm, paths, closed):
    """Whether one of the paths crosses a face."""
    if not all(point.is_vertex for path in paths for point in path):
        return True
    bm.verts.ensure_lookup_table()
    ids = [[point.a for point in path + path[:1] * is_closed] for path, is_closed in zip(paths, closed)]
    return any(bm.edges.get((bm.verts[a], bm.verts[b])) is None for path in ids for a, b in pairwise(path))


def _sides(face, start, end):
    """The two ways from one vertex of a face to another along its border."""
    vertices = list(face.verts)
    first = vertices.index(start)
    vertices = vertices[first:] + vertices[:first]
    last = vertices.index(end)
    return vertices[: last + 1], [start, *vertices[: last - 1 : -1]]


def _is_flat(points):
    """Whether a polygon has no area to speak of (Newell)."""
    area = sum(((p - points[0]).cross(q - points[0]) for p, q in pairwise(points[1:])), Vector())
    perimeter = sum((q - p).length for p, q in pairwise([*points, points[0]]))
    return 0.5 * area.length <= _FLAT * perimeter**2


def _along(corner, start, end):
    """The vertices after `start` up to `end` along a new cut, of which `corner` is the loop at its start."""
    step = "link_loop_next" if corner.vert == start else "link_loop_prev"
    vertices = []
    while not vertices or vertices[-1] != end:
        corner = getattr(corner, step)
        vertices.append(corner.vert)
    return vertices
