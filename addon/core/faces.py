# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces of a mesh as arrays over all corners: neighbors, areas and regions. Does not need Blender."""

from functools import cached_property

import numpy as np

from . import edge_paths


class Faces:
    """The faces of a mesh, given by its points and by the arguments of topology.make_topology."""

    def __init__(self, points, edges, face_offsets, corner_vertices, corner_edges, hidden_faces):
        self.points, self.edges = points, edges
        self.offsets, self.corner_vertices, self.corner_edges = face_offsets, corner_vertices, corner_edges
        self.count = len(face_offsets) - 1
        self.corner_faces = np.repeat(np.arange(self.count), np.diff(face_offsets))
        self.hidden = np.zeros(self.count, dtype=bool)
        self.hidden[hidden_faces] = True

    @cached_property
    def uses(self):
        """How many corners each edge has."""
        return np.bincount(self.corner_edges, minlength=len(self.edges))

    @cached_property
    def edge_corners(self):
        """The first and the last corner of each edge, as two arrays; -1 where it has none."""
        count, edges = len(self.corner_edges), self.corner_edges
        first, last = np.full((2, len(self.edges)), -1)
        last[edges] = np.arange(count)
        first[edges[::-1]] = np.arange(count)[::-1]
        return first, last

    @cached_property
    def edge_faces(self):
        """The visible faces on the two sides of each edge, as (n, 2) faces; -1 where there is none."""
        sides = np.column_stack(
            [np.where(corners >= 0, self.corner_faces[corners], -1) for corners in self.edge_corners]
        )
        sides[self.uses == 1, 1] = -1
        sides[(sides >= 0) & self.hidden[sides]] = -1
        return sides

    @cached_property
    def areas(self):
        """The area of each face: half the length of the sum of its corners' cross products."""
        here = self.points[self.corner_vertices]
        origin = np.repeat(here[self.offsets[:-1]], np.diff(self.offsets), axis=0)
        after = self.points[self.corner_vertices[self.next_corners(np.arange(len(here)))]]
        crosses = np.cross(here - origin, after - origin)
        sums = np.column_stack([np.bincount(self.corner_faces, axis, self.count) for axis in crosses.T])
        return 0.5 * np.linalg.norm(sums, axis=1)

    def next_corners(self, corners):
        """Return the corner after each one in its face."""
        ends = self.offsets[self.corner_faces[corners] + 1]
        return np.where(corners + 1 < ends, corners + 1, self.offsets[self.corner_faces[corners]])

    def find_edges(self, pairs):
        """Return the numbers of the edges that join (n, 2) pairs of vertices, all of which there are."""
        keys = edge_keys(pairs)
        near = np.zeros(len(self.points), dtype=bool)
        near[pairs] = True
        some = np.flatnonzero(near[self.edges[:, 0]] & near[self.edges[:, 1]])
        known = edge_keys(self.edges[some])
        order = np.argsort(known)
        return some[order[np.searchsorted(known, keys, sorter=order)]]

    def lengths(self, edges):
        """Return the lengths of edges, given by their numbers."""
        return np.linalg.norm(np.diff(self.points[self.edges[edges]], axis=1)[:, 0], axis=1)

    def regions(self, passable):
        """Return for each face the lowest one reachable across these edges between visible faces, given as a mask."""
        sides = self.edge_faces[passable & (self.edge_faces >= 0).all(axis=1)]
        return edge_paths.component_labels(sides, self.count)


def edge_keys(pairs):
    """Return a number for each pair of vertices, independent of their order."""
    pairs = np.asarray(pairs, dtype=np.int64)
    return (pairs.min(axis=1) << 32) + pairs.max(axis=1)
