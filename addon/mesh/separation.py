# SPDX-License-Identifier: GPL-3.0-or-later
"""What lies to the left and right of contours along a mesh's edges, by bmesh alone.

A contour is a list of vertices in order; the left is that of someone who walks along it on the outside.
"""

from itertools import pairwise


def edges_along(bm, ids, closed):
    """The edges of a contour, given by its vertex ids."""
    bm.verts.ensure_lookup_table()
    ids = [int(i) for i in ids]
    return [bm.edges.get((bm.verts[a], bm.verts[b])) for a, b in pairwise(ids + ids[:1] * closed)]


def beside(bm, ids, closed):
    """The faces to the left and right along a contour, as two lists; None where there is none."""
    bm.verts.ensure_lookup_table()
    left, right = [], []
    for edge, start in zip(edges_along(bm, ids, closed), ids):
        faces = {loop.vert == bm.verts[start]: loop.face for loop in edge.link_loops}
        left.append(faces.get(True))
        right.append(faces.get(False))
    return left, right


def pieces_between(bm, chains):
    """For each contour, as (ids, closed), the pieces to its left and right that the mesh falls into along all of them.

    One piece on both sides, as round the ring of a torus: this contour separates nothing. All pieces grow in turn until
    all but one are whole, and that one is the largest, so that it costs no more than the next.
    """
    walls = {edge for chain in chains for edge in edges_along(bm, *chain)}
    owners = {}
    for chain in chains:
        for face in map(_first, beside(bm, *chain)):
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
    return [tuple(owners[_first(side)].whole() for side in beside(bm, *chain)) for chain in chains]


def face_beside(bm, ids, closed, on_left):
    """A face on one side of a contour."""
    left, right = beside(bm, ids, closed)
    return _first(left if on_left else right)


def reach(seeds, walls, allowed):
    """The faces that hang together with the seeds without crossing a wall, of those allowed; a seed may be None."""
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
    """A set of faces that hang together, which grows round by round and swallows the pieces that it meets."""

    def __init__(self, face, owners, walls):
        self.front = {face} if face else set()
        self.size = len(self.front)
        self.any_hidden = bool(face and face.hide)
        self._behind = set()  # the front of before
        self._owners, self._walls = owners, walls  # of all pieces alike
        self._swallowed_by = None

    def whole(self):
        """The piece that this one has become part of."""
        piece = self
        while piece._swallowed_by:
            piece = piece._swallowed_by
        return piece

    def grow(self):
        """Adds the faces beside the last ones."""
        walls, last = self._walls, self.front
        beside = {other for face in last for edge in face.edges if edge not in walls for other in edge.link_faces}
        new = beside.difference(self._owners)
        met = beside.difference(new, last, self._behind)
        self._owners.update(dict.fromkeys(new, self))
        self.front, self._behind = new, last
        self.size += len(new)
        self.any_hidden = self.any_hidden or any(face.hide for face in new)
        for face in met:
            if self._owners[face].whole() is not self:
                self._swallow(self._owners[face].whole())

    def finish(self):
        while self.front:
            self.grow()

    def _swallow(self, other):
        other._swallowed_by = self
        self.front |= other.front
        self.size += other.size
        self.any_hidden |= other.any_hidden
        other.front = set()
