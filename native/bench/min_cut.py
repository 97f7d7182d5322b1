# SPDX-License-Identifier: GPL-3.0-or-later
"""The best competitor, for comparison only: the minimum cut of a band, by PyMaxflow with the capacities
length * exp(7 sin(dihedral angle))."""

from dataclasses import dataclass

import maxflow
import mrcontour as mrc
import numpy as np

UNCUT = 1e9


@dataclass(frozen=True)
class CutBand:
    """The input of a cut: the triangles of the band, and which of them are on its left and on its right boundary."""

    triangles: np.ndarray
    left: np.ndarray
    right: np.ndarray


def cut_band(body, vertices, options):
    """The band that a call searches, or None if one of its sides is empty."""
    space = mrc.search_space(body.surface, vertices, options=options)
    side, entered = np.zeros((2, len(body.positions)), int)
    side[space["vertices"]], entered[space["vertices"]] = space["side"], space["round"]
    triangles = body.triangles[space["faces"]]
    last, left, right = (
        entered[triangles].max(axis=1),
        side[triangles].max(axis=1) == 1,
        side[triangles].min(axis=1) == -1,
    )
    left, right = (np.flatnonzero(on & (last == last[on].max(initial=0))) for on in (left, right))
    return CutBand(triangles, left, right) if len(left) and len(right) else None


def minimum_cut(positions, band):
    """Builds the graph from arrays and solves it: the side of each triangle."""
    first, second, ends = inner_edges(band.triangles, len(positions))
    graph = maxflow.GraphFloat(len(band.triangles), len(first))
    graph.add_nodes(len(band.triangles))
    capacity = capacities(positions, band.triangles, first, second, ends)
    graph.add_edges(first, second, capacity, capacity)
    sure, none = np.full(len(band.triangles), UNCUT), np.zeros(len(band.triangles))
    graph.add_grid_tedges(band.left, sure[: len(band.left)], none[: len(band.left)])
    graph.add_grid_tedges(band.right, none[: len(band.right)], sure[: len(band.right)])
    graph.maxflow()
    return graph.get_grid_segments(np.arange(len(band.triangles)))


def inner_edges(triangles, vertex_count):
    """The two triangles at each inner edge of the band, and the ends of the edge in the direction of the first."""
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    key = ends.min(axis=1).astype(np.int64) * vertex_count + ends.max(axis=1)
    order = np.argsort(key, kind="stable")
    pairs = np.flatnonzero(key[order][1:] == key[order][:-1])
    first, second = order[pairs], order[pairs + 1]
    return first % len(triangles), second % len(triangles), ends[first]


def capacities(positions, triangles, first, second, ends):
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    along = positions[ends[:, 1]] - positions[ends[:, 0]]
    length = np.linalg.norm(along, axis=1)
    sine = np.einsum("ij,ij->i", np.cross(normals[first], normals[second]), along) / np.maximum(length, 1e-300)
    return length * np.exp(7 * sine)
