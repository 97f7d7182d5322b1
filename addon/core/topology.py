# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh as edges between faces, and the regions into which some of the edges divide it. Needs no Blender."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import edge_paths


@dataclass(frozen=True)
class Topology:
    """The edges of a mesh, and the shown faces beside each: seen from its first vertex to its second."""

    edges: np.ndarray  # (n, 2) vertices
    left: np.ndarray  # (n,) faces; -1 where there is none
    right: np.ndarray
    inner: np.ndarray  # (n,) whether the edge lies between two shown faces of the same winding; a border else
    hidden: np.ndarray  # (n,) whether one of the edge's faces is hidden
    face_count: int

    @cached_property
    def border_vertices(self):
        """The vertices at which shown faces end."""
        return set(np.unique(self.edges[~self.inner & ((self.left >= 0) | (self.right >= 0))]).tolist())

    @cached_property
    def hidden_vertices(self):
        """The vertices of hidden faces: what ends there may go on where nobody sees it."""
        return set(np.unique(self.edges[self.hidden]).tolist())

    def find(self, pairs):
        """The edges that join pairs of vertices, and whether each pair begins at its edge's first vertex.

        One call for many pairs: each looks once at all edges.
        """
        pairs = np.asarray(pairs)
        near, keys = self._edges_among(pairs)
        order = np.argsort(keys)
        edges = near[order[np.searchsorted(keys, _keys(pairs), sorter=order)]]
        return edges, self.edges[edges, 0] == pairs[:, 0]

    def has(self, pairs):
        """Whether edges join all these pairs of vertices."""
        pairs = np.asarray(pairs)
        return bool(np.isin(_keys(pairs), self._edges_among(pairs)[1]).all())

    def _edges_among(self, pairs):
        """The edges between vertices of pairs, and their keys."""
        near = np.zeros(max(self.edges.max(initial=-1), pairs.max(initial=-1)) + 1, dtype=bool)
        near[pairs] = True
        edges = np.flatnonzero(near[self.edges[:, 0]] & near[self.edges[:, 1]])
        return edges, _keys(self.edges[edges])


def _keys(pairs):
    """A number for each pair of vertices, whichever comes first."""
    pairs = pairs.astype(np.int64)
    return (np.minimum(*pairs.T) << 32) + np.maximum(*pairs.T)


def make_topology(edges, face_offsets, corner_vertices, corner_edges, hidden_faces):
    """From a mesh's arrays; corner i of a face runs along its edge to the next corner."""
    face_count = len(face_offsets) - 1
    hidden = np.zeros(face_count, dtype=bool)
    hidden[hidden_faces] = True
    faces = np.repeat(np.arange(face_count, dtype=np.int32), np.diff(face_offsets))
    shown, forward = ~hidden[faces], corner_vertices == edges[corner_edges, 0]
    left, right = (_face_beside(len(edges), corner_edges, faces, shown & way) for way in (forward, ~forward))
    uses = [np.bincount(corner_edges[way], minlength=len(edges)) for way in (forward, ~forward)]
    inner = (uses[0] == 1) & (uses[1] == 1) & (left >= 0) & (right >= 0)
    beside_hidden = np.bincount(corner_edges[~shown], minlength=len(edges)) > 0
    return Topology(edges, left, right, inner, beside_hidden, face_count)


def _face_beside(edge_count, corner_edges, faces, corners):
    beside = np.full(edge_count, -1, dtype=np.int32)
    beside[corner_edges[corners]] = faces[corners]
    return beside


def regions(topology, walls):
    """For each face the lowest one that can be reached from it without crossing a wall; hidden faces reach none."""
    passable = topology.inner & ~walls
    return edge_paths.component_labels(
        np.column_stack([topology.left[passable], topology.right[passable]]), topology.face_count
    )


def joined(topology, pieces, edges):
    """The same where some edges are no walls any more; far quicker than from the beginning."""
    edges = edges[topology.inner[edges]]
    ends = np.column_stack([pieces[topology.left[edges]], pieces[topology.right[edges]]])
    return edge_paths.component_labels(ends, topology.face_count)[pieces]


def label_borders(topology, labels):
    """The edges between two shown faces of different labels."""
    borders = topology.inner.copy()
    borders[borders] = labels[topology.left[borders]] != labels[topology.right[borders]]
    return borders
