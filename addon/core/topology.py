# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh as edges between faces, and the regions into which some edges divide it. Does not need Blender."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import edge_paths


@dataclass(frozen=True)
class Topology:
    """The edges of a mesh, and the visible faces to the left and right of each, from its first vertex to its second."""

    edges: np.ndarray  # (n, 2) vertices
    left: np.ndarray  # (n,) faces; -1 where there is none
    right: np.ndarray
    inner: np.ndarray  # (n,) whether it lies between two visible faces of the same winding; else it is a border
    hidden: np.ndarray  # (n,) whether one of the edge's faces is hidden
    face_count: int

    @cached_property
    def border_vertices(self):
        """The vertices on the border of the visible faces."""
        return set(np.unique(self.edges[~self.inner & ((self.left >= 0) | (self.right >= 0))]).tolist())

    @cached_property
    def hidden_vertices(self):
        """The vertices of hidden faces: a chain that ends there may continue out of sight."""
        return set(np.unique(self.edges[self.hidden]).tolist())

    def find(self, pairs):
        """Return the edges that join pairs of vertices, and whether each pair starts at its edge's first vertex.

        Each call scans all edges, so pass many pairs at once.
        """
        pairs = np.asarray(pairs)
        near, keys = self._edges_among(pairs)
        order = np.argsort(keys)
        edges = near[order[np.searchsorted(keys, _keys(pairs), sorter=order)]]
        return edges, self.edges[edges, 0] == pairs[:, 0]

    def has(self, pairs):
        """Whether each of these pairs of vertices is joined by an edge."""
        pairs = np.asarray(pairs)
        return bool(np.isin(_keys(pairs), self._edges_among(pairs)[1]).all())

    def _edges_among(self, pairs):
        """Return the edges whose ends both occur in the pairs, and their keys."""
        near = np.zeros(max(self.edges.max(initial=-1), pairs.max(initial=-1)) + 1, dtype=bool)
        near[pairs] = True
        edges = np.flatnonzero(near[self.edges[:, 0]] & near[self.edges[:, 1]])
        return edges, _keys(self.edges[edges])


def _keys(pairs):
    """Return a number for each pair of vertices, independent of their order."""
    pairs = pairs.astype(np.int64)
    return (np.minimum(*pairs.T) << 32) + np.maximum(*pairs.T)


def make_topology(edges, face_offsets, corner_vertices, corner_edges, hidden_faces):
    """Make the topology from a mesh's arrays; `corner_edges` has the edge from each corner to the next one."""
    face_count = len(face_offsets) - 1
    hidden = np.zeros(face_count, dtype=bool)
    hidden[hidden_faces] = True
    faces = np.repeat(np.arange(face_count, dtype=np.int32), np.diff(face_offsets))
    shown, forward = ~hidden[faces], corner_vertices == edges[corner_edges, 0]
    left, right = (_face_of_edges(len(edges), corner_edges, faces, shown & side) for side in (forward, ~forward))
    uses = [np.bincount(corner_edges[side], minlength=len(edges)) for side in (forward, ~forward)]
    inner = (uses[0] == 1) & (uses[1] == 1) & (left >= 0) & (right >= 0)
    beside_hidden = np.bincount(corner_edges[~shown], minlength=len(edges)) > 0
    return Topology(edges, left, right, inner, beside_hidden, face_count)


def _face_of_edges(edge_count, corner_edges, faces, corners):
    adjacent = np.full(edge_count, -1, dtype=np.int32)
    adjacent[corner_edges[corners]] = faces[corners]
    return adjacent


def regions(topology, walls):
    """Return for each face the lowest face reachable without crossing a wall; a hidden face reaches only itself."""
    passable = topology.inner & ~walls
    return edge_paths.component_labels(
        np.column_stack([topology.left[passable], topology.right[passable]]), topology.face_count
    )


def joined(topology, pieces, edges):
    """Return these regions joined across some edges that are walls no longer; far faster than starting over."""
    edges = edges[topology.inner[edges]]
    ends = np.column_stack([pieces[topology.left[edges]], pieces[topology.right[edges]]])
    return edge_paths.component_labels(ends, topology.face_count)[pieces]


def label_borders(topology, labels):
    """Return for each edge whether it lies between two visible faces with different labels."""
    borders = topology.inner.copy()
    borders[borders] = labels[topology.left[borders]] != labels[topology.right[borders]]
    return borders
