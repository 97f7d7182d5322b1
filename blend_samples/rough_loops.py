# SPDX-License-Identifier: GPL-3.0-or-later
"""The rule that defines the rough loops of all samples.

A plane (a point inside the limb and a normal, tilted as by a modeler in a hurry) divides the faces of a mesh by the
side of their center. The edges between faces on different sides form closed, jagged loops; the rough loop is the one
whose mean vertex is nearest to the plane's point. If it touches itself at a vertex, the longest part between two visits
is taken. Nothing is selected by hand. This module uses only NumPy.

Loops are optimized with the add-on's defaults, which assume that a loop was drawn near the intended boundary. The only
exception is a loop whose distance from the end of the part is about the default reach or more: its cut also names a
point where the part ends. Then the width is the distance to that point in mean edge lengths of the loop plus three
rings, as a modeler would choose it, with no limit of distance (reach 0) and no preference for near contours (anchor 0).
"""

from dataclasses import dataclass
from math import ceil

import numpy as np

RINGS_BEYOND = 3  # rings beyond the end of the part in a far search, as in figure 5.2


@dataclass(frozen=True)
class Cut:
    """A rough loop to be made: its plane and, if it is far from the end of the part, a point where the part ends."""

    name: str
    point: tuple
    normal: tuple
    end: tuple | None = None


@dataclass(frozen=True)
class Polygons:
    """A mesh as plain arrays: face i is vertices[offsets[i]:offsets[i + 1]]."""

    positions: np.ndarray
    offsets: np.ndarray
    vertices: np.ndarray

    def centers(self):
        counts = np.diff(self.offsets)
        return np.add.reduceat(self.positions[self.vertices], self.offsets[:-1]) / counts[:, None]

    def half_edges(self):
        """Return the start, end and face of every corner's half-edge."""
        face = np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))
        following = np.arange(1, len(self.vertices) + 1)
        following[self.offsets[1:] - 1] = self.offsets[:-1]
        return self.vertices, self.vertices[following], face


def rough_loop(mesh, cut):
    """Return the vertices, in order, of the closed loop along the cut's plane that is nearest to its point."""
    point, normal = np.asarray(cut.point, float), np.asarray(cut.normal, float)
    return border_loop(mesh, (mesh.centers() - point) @ normal > 0.0, point)


def settings(mesh, cut, loop):
    """Return the operator's settings that differ from its defaults by the rule above."""
    if cut.end is None:
        return {}
    points = mesh.positions[loop]
    edge_length = np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).mean()
    rings = ceil(np.linalg.norm(np.subtract(cut.end, cut.point)) / edge_length) + RINGS_BEYOND
    return {"width": rings, "reach": 0.0, "anchor": 0.0}


def border_loop(mesh, positive, point):
    """Return the closed loop between the marked faces and the others that is nearest to a point."""
    loops = [_longest_simple_part(loop) for loop in _boundary_loops(mesh, positive)]
    if not loops:
        raise ValueError("No closed edge loop separates these faces from the others.")
    return min(loops, key=lambda loop: np.linalg.norm(mesh.positions[loop].mean(axis=0) - point))


def _boundary_loops(mesh, positive):
    """Return the closed loops between the faces of both sides, with the positive faces on their left."""
    tail, head, face = (column.tolist() for column in _half_edges_near(mesh, positive))
    half_edge = dict(zip(zip(tail, head), face))
    following = _successors(mesh, set(face))
    boundary = {pair for pair, f in half_edge.items() if positive[f] and not positive[half_edge.get(pair[::-1], f)]}
    loops = []
    while boundary:
        start = min(boundary)
        loop = _walk(start, boundary, half_edge, following)
        boundary.difference_update(loop)
        if loop[0][0] == loop[-1][1]:
            loops.append([a for a, _ in loop])
    return loops


def _half_edges_near(mesh, positive):
    """Return only half-edges of faces at vertices where both sides meet, so that the work grows only with the loops."""
    tail, head, face = mesh.half_edges()
    seen = np.zeros((len(mesh.positions), 2), bool)
    seen[tail, positive[face].astype(int)] = True
    near = np.zeros(len(positive), bool)
    near[face[seen[tail].all(axis=1)]] = True
    selected = near[face]
    return tail[selected], head[selected], face[selected]


def _successors(mesh, faces):
    """Return a dictionary (face, vertex) -> the next vertex of the face."""
    following = {}
    for face in faces:
        corners = mesh.vertices[mesh.offsets[face] : mesh.offsets[face + 1]].tolist()
        following.update({(face, a): b for a, b in zip(corners, corners[1:] + corners[:1])})
    return following


def _walk(start, boundary, half_edge, following):
    """Follow a boundary, turning through positive faces, until it closes or meets the border of the mesh."""
    loop, pair = [start], start
    while True:
        face = half_edge[pair]
        pair = (pair[1], following[face, pair[1]])
        while pair not in boundary:
            twin = half_edge.get(pair[::-1])
            if twin is None:
                return loop
            pair = (pair[0], following[twin, pair[0]])
        if pair == start:
            return loop
        loop.append(pair)


def _longest_simple_part(loop):
    """Cut a loop at the vertices that it visits twice, and return the longest part."""
    parts, open_part = [], []
    for vertex in loop:
        if vertex in open_part:
            at = open_part.index(vertex)
            parts.append(open_part[at:])
            open_part = open_part[:at]
        open_part.append(vertex)
    return max(parts + [open_part], key=len)
