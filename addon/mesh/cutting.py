# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts contours into the faces that they cross, with bmesh alone. Marks and selects nothing."""

from collections import defaultdict
from itertools import pairwise

import bmesh
import bpy
import numpy as np
from mathutils import Vector
from mathutils.geometry import intersect_point_line

from ..core.contour_points import contour_points, merge_points, without_points_along_edges

_FLAT = 1e-6  # fraction of the squared perimeter; a piece of a face with less area than this counts as flat
_STRAIGHT = 1e-5  # fraction of a segment's length; a smaller bend counts as straight
_COPIED = "source" if bpy.app.version >= (5, 1) else "example"  # face_split's name for the edge that new ones copy
_DEFAULTS = {"bool": False, "int": 0, "float": 0.0, "float_vector": (0.0,) * 3, "float_color": (1.0,) * 4}


class Crossing(ValueError):
    """Two contours cross each other, so they cannot be cut together."""

    def __init__(self, face):
        self.face = face  # its index before the cut
        super().__init__(f"contours cross each other in face {face}: cut them one after the other")


def cut_contours(bm, contours, merge=0.0, copy_edges=False):
    """Cut native results, or similar contours, into a mesh. Return for each contour its vertex ids in order.

    An edge joins each vertex of that list to the next: a contour that was cut is a contour along edges. The ids are
    those after the cut, since bmesh may renumber the old elements. All contours must be contours of the mesh before the
    cut and must not cross each other.
    Points closer to a vertex than the fraction `merge` of their edge are moved onto it, so that the contour moves by as
    much and the cut leaves no slivers.
    With `copy_edges`, needed where edges carry matrices, new edges are made from old ones, since Blender would crash.
    """
    return cut_and_follow(bm, contours, [], merge, copy_edges)[0]


def cut_and_follow(bm, contours, edge_paths, merge=0.0, copy_edges=False):
    """Cut contours like cut_contours, and follow paths along edges, given as lists of vertex ids.

    Return the vertex ids of each contour, and for each path the ids of all vertices along it after the cut.
    """
    closed = [contour.closed for contour in contours]
    paths = [without_points_along_edges(contour_points(contour), contour.closed) for contour in contours]
    paths = merge_points(paths, closed, merge, _edges_of_hidden_faces(bm, paths), _border_vertices(bm, paths))
    if not _leaves_edges(bm, paths, closed):
        return [np.array([point.a for point in path]) for path in paths], [np.array(path) for path in edge_paths]
    knife = _Knife(bm, paths, {vertex for path in edge_paths for vertex in path}, copy_edges)
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
    """Return the ids of the faces that contain a segment of one of the contours."""
    return np.unique(np.concatenate([np.asarray(contour.segment_faces) for contour in contours]))


def _ids(vertices):
    return np.array([vertex.index for vertex in vertices], dtype=np.int32)


class _Knife:
    """Cuts paths into a bmesh. Knows the elements from before the first cut and the pieces they are in now."""

    def __init__(self, bm, paths, followed=frozenset(), copy_edges=False):
        self.bm, self.copy_edges = bm, copy_edges
        for sequence in (bm.verts, bm.edges, bm.faces):
            sequence.index_update()
            sequence.ensure_lookup_table()
        all_points = [point for path in paths for point in path]
        ids = {point.face for point in all_points}
        known = {vertex for point in all_points for vertex in (point.a, point.b)} | followed
        self.given = {vertex: bm.verts[vertex] for vertex in known}
        self.pieces = {face: [bm.faces[face]] for face in ids}  # the pieces of each face
        self.sides = {face: {_pair(edge.verts) for edge in bm.faces[face].edges} for face in ids}
        self.vertices = {}  # the new vertices, by the places of their points
        self.inner = {point.place: self._position(point) for point in all_points if self._is_inner(point)}
        self._split_edges(all_points)
        self.copies = []  # of faces, until the last cut
        self.halves = self._halves([point for point in all_points if point.place in self.inner])

    def cut(self, path, closed):
        """Split the faces that a path crosses, and return the vertices along it."""
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
        """Return the vertices along a path of old edges: its own vertices and the new ones between them."""
        between = defaultdict(list)
        for a, b, t in sorted(self.vertices):
            between[a, b].append(self.vertices[a, b, t])
            between[b, a].insert(0, self.vertices[a, b, t])
        return [self.given[path[0]]] + [v for a, b in pairwise(path) for v in (*between.get((a, b), ()), self.given[b])]

    def finish(self):
        """Remove the copies and update the ids and normals after the last cut."""
        for vertex in dict.fromkeys(vertex for copy in self.copies for vertex in copy.verts):
            self.bm.verts.remove(vertex)
        self.bm.verts.index_update()
        self.bm.edges.index_update()
        self.bm.faces.index_update()
        faces = [face for pieces in self.pieces.values() for face in pieces]
        for face in faces:
            face.normal_update()
        for vertex in {vertex for face in faces for vertex in face.verts}:
            vertex.normal_update()

    def _is_inner(self, point):
        """Whether a point lies inside its polygon, on a diagonal and not on a side."""
        return not point.is_vertex and (point.a, point.b) not in self.sides[point.face]

    def _position(self, point):
        return self.given[point.a].co.lerp(self.given[point.b].co, point.t)

    def _vertex(self, point):
        return self.given[point.a] if point.is_vertex else self.vertices[point.place]

    def _split_edges(self, all_points):
        """Insert a vertex wherever a contour crosses an edge.

        Each edge is split from its far end on, and each fraction is relative to the length that is left.
        """
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

    def _halves(self, points):
        """Return for each diagonal that a contour crosses a part of its face to one side, cut from a copy.

        Inside a polygon Blender interpolates corners by the polygon's shape, but on its border linearly, as they and
        the vertices should be along a diagonal.
        """
        diagonals = defaultdict(set)
        for point in points:
            diagonals[point.face].add((point.a, point.b))
        halves = {}
        for face_id in sorted(diagonals):
            face = self.pieces[face_id][0]
            parts = [face.copy()]
            vertices = dict(zip(face.verts, parts[0].verts))
            for a, b in sorted(diagonals[face_id]):
                ends = vertices[self.given[a]], vertices[self.given[b]]
                part = next(part for part in parts if set(ends) <= set(part.verts))
                parts.append(self._split_face(part, *ends, ())[0])
            for a, b in diagonals[face_id]:  # only now, since later diagonals may have divided the parts again
                edge = self.bm.edges.get((vertices[self.given[a]], vertices[self.given[b]]))
                halves[a, b] = edge.link_faces[0]
            self.copies += parts
        return halves

    def _connect(self, start, end, bends, face_id):
        """Connect two vertices, along existing edges or by a cut. Return the vertices after `start` up to `end`."""
        bends = self._real_bends(start.co, bends, end.co)
        points = [self.inner[bend.place] for bend in bends]
        if not bends and self.bm.edges.get((start, end)):
            return [end]
        face = self._piece(face_id, start, end)
        sides = _sides(face, start, end)
        for side in sides:
            if len(side) == 2 or _is_flat([vertex.co for vertex in side] + points[::-1]):
                return side[1:]  # a cut would leave a piece without area, so follow the face's side instead
        new, corner = self._split_face(face, start, end, points)
        new.select_set(face.select)  # all pieces of a selected face stay selected
        self.pieces[face_id].append(new)
        vertices = _along(corner, start, end)
        for vertex, bend in zip(vertices, bends):  # more exact than from the whole polygon, which may not be planar
            vertex.copy_from_vert_interp((self.given[bend.a], self.given[bend.b]), bend.t)
            for corner in vertex.link_loops:
                _interpolate(corner, self.halves[bend.a, bend.b])
        return vertices

    def _split_face(self, face, start, end, points):
        """Split a face along a path through new points. Return the new face and the first corner of the cut."""
        if not self.copy_edges:
            return bmesh.utils.face_split(face, start, end, coords=points)
        found = bmesh.utils.face_split(face, start, end, coords=points, **{_COPIED: face.edges[0]})
        for vertex, following in pairwise([start, *_along(found[1], start, end)]):
            self._reset(self.bm.edges.get((vertex, following)))
        return found

    def _reset(self, edge):
        """Give an edge that was made from another one the values of a new edge, as far as bmesh has access to them."""
        edge.seam, edge.smooth = False, True
        for kind, value in _DEFAULTS.items():
            for layer in getattr(self.bm.edges.layers, kind, {}).values():
                edge[layer] = value

    def _real_bends(self, start, bends, end):
        """Return the bends that do not lie on the straight line between their neighbors."""
        points = [self.inner[bend.place] for bend in bends]
        real, last = [], start
        for bend, point, following in zip(bends, points, [*points[1:], end]):
            on_line = intersect_point_line(point, last, following)[0]
            if (point - on_line).length > _STRAIGHT * (following - last).length:
                real.append(bend)
                last = point
        return real

    def _piece(self, face_id, start, end):
        """Return the piece of a face that has both vertices."""
        found = [piece for piece in self.pieces[face_id] if start in piece.verts and end in piece.verts]
        if not found:
            raise Crossing(face_id)
        return found[0]


def _interpolate(corner, face):
    """Give a corner the values that a face has at its place, apart from grids of multiresolution."""
    try:
        corner.copy_from_face_interp(face, False, False)
    except TypeError:  # earlier releases of Blender want the arguments in one tuple
        corner.copy_from_face_interp((face, False, False))


def _pair(vertices):
    return tuple(sorted(vertex.index for vertex in vertices))


def _edges_of_hidden_faces(bm, paths):
    """Return the edges that the paths cross or touch and that belong to a hidden face, which must not change."""
    bm.verts.ensure_lookup_table()
    touched = {(point.a, point.b) for path in paths for point in path if not point.is_vertex}
    edges = {pair: bm.edges.get((bm.verts[pair[0]], bm.verts[pair[1]])) for pair in touched}
    return {pair for pair, edge in edges.items() if edge and any(face.hide for face in edge.link_faces)}


def _border_vertices(bm, paths):
    """Return the ends of crossed edges that lie on the mesh border, where a contour would have only one side."""
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
    """Return the two paths from one vertex of a face to another along its border."""
    vertices = list(face.verts)
    first = vertices.index(start)
    vertices = vertices[first:] + vertices[:first]
    last = vertices.index(end)
    return vertices[: last + 1], [start, *vertices[: last - 1 : -1]]


def _is_flat(points):
    """Whether the area of a polygon is negligible (by Newell's method)."""
    area = sum(((p - points[0]).cross(q - points[0]) for p, q in pairwise(points[1:])), Vector())
    perimeter = sum((q - p).length for p, q in pairwise([*points, points[0]]))
    return 0.5 * area.length <= _FLAT * perimeter**2


def _along(corner, start, end):
    """Return the vertices after `start` up to `end` along a new cut; `corner` is the cut's first loop."""
    step = "link_loop_next" if corner.vert == start else "link_loop_prev"
    vertices = []
    while not vertices or vertices[-1] != end:
        corner = getattr(corner, step)
        vertices.append(corner.vert)
    return vertices
