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


def part_cut_off(bm, ids, closed, walls):
    """The smaller of the two pieces that a contour parts when all `walls` are cut, as a set of faces.

    None where both sides hang together elsewhere, as round the ring of a torus. Both pieces grow in turn, so that this
    costs no more than the smaller one.
    """
    left, right = (next(iter(filter(None, side)), None) for side in beside(bm, ids, closed))
    if left is None or right is None or left == right:
        return None
    pieces = [_Piece(left), _Piece(right)]
    while True:
        for piece, other in (pieces, pieces[::-1]):
            if not piece.grow(walls):
                return piece.faces
            if not piece.front.isdisjoint(other.faces):
                return None


def reach(seeds, walls, allowed):
    """The faces that hang together with the seeds without crossing a wall, of those allowed; a seed may be None."""
    piece = _Piece(*(face for face in seeds if face and allowed(face)))
    while piece.grow(walls, allowed):
        pass
    return piece.faces


class _Piece:
    """A set of faces that grows round by round."""

    def __init__(self, *seeds):
        self.faces = set(seeds)
        self.front = set(seeds)

    def grow(self, walls, allowed=lambda face: True):
        """Adds the faces beside the last ones; whether there were any."""
        beside_front = {
            face
            for last in self.front
            for edge in last.edges
            if edge not in walls
            for face in edge.link_faces
            if face not in self.faces and allowed(face)
        }
        self.faces |= beside_front
        self.front = beside_front
        return bool(beside_front)
