# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the faces and pieces to the left and right of contours along a mesh's edges, with bmesh alone.

A contour is a list of vertices in order; left is as seen when walking along it on the outside of the surface.
"""

from itertools import pairwise


def edges_along(bm, ids, closed):
    """Return the edges of a contour, given by its vertex ids."""
    bm.verts.ensure_lookup_table()
    ids = [int(i) for i in ids]
    return [bm.edges.get((bm.verts[a], bm.verts[b])) for a, b in pairwise(ids + ids[:1] * closed)]


def adjacent_faces(bm, ids, closed):
    """Return the faces to the left and right along a contour, as two lists; None where there is no face."""
    bm.verts.ensure_lookup_table()
    left, right = [], []
    for edge, start in zip(edges_along(bm, ids, closed), ids):
        faces = {loop.vert == bm.verts[start]: loop.face for loop in edge.link_loops}
        left.append(faces.get(True))
        right.append(faces.get(False))
    return left, right


def pieces_between(bm, chains):
    """Return for each contour, given as (ids, closed), the pieces to its left and right if the mesh is cut along all.

    If both are the same piece, as for one ring around a torus, the contour separates nothing. All pieces grow in turn
    until all but one are complete. The last one only grows until it is the largest, so it costs no more than the next.
    """
    walls = {edge for chain in chains for edge in edges_along(bm, *chain)}
    owners = {}
    for chain in chains:
        for face in map(_first, adjacent_faces(bm, *chain)):
            owners.setdefault(face, Piece(face, owners, walls))
    seeded = list(owners.values())
    growing = seeded
    while len(growing) > 1:
        for piece in growing:
            piece.grow()
        growing = [piece for piece in growing if piece.front]
    for piece in growing:
        others = max((other.size for other in seeded if other is not piece), default=0)
        while piece.front and piece.size <= others:
            piece.grow()
    return [tuple(owners[_first(side)].whole() for side in adjacent_faces(bm, *chain)) for chain in chains]


def adjacent_face(bm, ids, closed, on_left):
    """Return a face on one side of a contour."""
    left, right = adjacent_faces(bm, ids, closed)
    return _first(left if on_left else right)


def connected_faces(seeds, walls, allowed):
    """Return the allowed faces that are connected to the seeds without crossing a wall; seeds may be None."""
    front = {face for face in seeds if face and allowed(face)}
    faces = set(front)
    while front:
        front = {
            other
            for face in front
            for edge in face.edges
            if edge not in walls
            for other in edge.link_faces
            if other not in faces and allowed(other)
        }
        faces |= front
    return faces


def _first(faces):
    return next((face for face in faces if face), None)


class Piece:
    """A connected set of faces that grows ring by ring and absorbs the pieces that it meets."""

    def __init__(self, face, owners, walls):
        self.front = {face} if face else set()
        self.size = len(self.front)
        self.any_hidden = bool(face and face.hide)
        self._previous = set()  # the previous front
        self._owners, self._walls = owners, walls  # shared by all pieces
        self._absorbed_by = None

    def whole(self):
        """Return the piece that this one has become part of."""
        piece = self
        while piece._absorbed_by:
            piece = piece._absorbed_by
        return piece

    def grow(self):
        """Add the faces next to those added last."""
        walls, last = self._walls, self.front
        neighbors = {other for face in last for edge in face.edges if edge not in walls for other in edge.link_faces}
        new = neighbors.difference(self._owners)
        met = neighbors.difference(new, last, self._previous)
        self._owners.update(dict.fromkeys(new, self))
        self.front, self._previous = new, last
        self.size += len(new)
        self.any_hidden = self.any_hidden or any(face.hide for face in new)
        for face in met:
            if self._owners[face].whole() is not self:
                self._absorb(self._owners[face].whole())

    def grow_fully(self):
        while self.front:
            self.grow()

    def _absorb(self, other):
        other._absorbed_by = self
        self.front |= other.front
        self.size += other.size
        self.any_hidden |= other.any_hidden
        other.front = set()
