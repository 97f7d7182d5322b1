# SPDX-License-Identifier: GPL-3.0-or-later
"""Decides which new paths of a network can be taken so that each region stays in one piece. Does not need Blender."""

from dataclasses import dataclass

import numpy as np

from . import edge_paths
from .topology import joined, regions


@dataclass(frozen=True)
class RegionCheck:
    """Which chains take their new paths, and the region of each face with these paths."""

    taken: list  # for each chain, whether it takes its new path
    lost: dict  # chain that stays -> the region that its new path would remove; -1 if it would join or split regions
    before: np.ndarray  # (faces,) region of each face, as returned by `regions`
    after: np.ndarray  # (faces,) region of each face with the new paths; the same region ids


@dataclass(frozen=True)
class _Line:
    """A chain's edges, and the faces on its two sides."""

    edges: np.ndarray
    left: np.ndarray
    right: np.ndarray

    def touches(self, labels, some):
        return bool(some) and bool(some & self.labels_along(labels))

    def labels_along(self, labels):
        return {*labels[self.left].tolist(), *labels[self.right].tolist()}

    def has_one_label_on_each_side(self, labels):
        return len(np.unique(labels[self.left])) == len(np.unique(labels[self.right])) == 1


def check_regions(topology, marked, chains, paths):
    """Take as many of the new paths (None: stays) as leave each region in one piece, on the same side of its chains.

    Chains around a region that would vanish, join another one or fall apart stay where they are. With all chains
    unmoved every region is intact, so the loop ends.
    """
    closed = [chain.closed for chain in chains]
    lines = _lines(topology, [chain.vertices for chain in chains] + list(paths), 2 * closed)
    given, new = lines[: len(chains)], lines[len(chains) :]
    partition = _Partition(topology, marked, lines)
    before = partition.pieces(marked)
    lost = {i: -1 for i, path in enumerate(paths) if path is not None and new[i] is None}
    while True:
        lines = [one if i in lost or new[i] is None else new[i] for i, one in enumerate(given)]
        moved = {i for i, line in enumerate(lines) if line is not given[i]}
        region_of, suspects = _assign_regions(partition, before, given, lines)
        if not moved or suspects is None:
            break
        rejected = next(found for found in (*suspects, dict.fromkeys(moved, -1)) if found.keys() & moved)
        lost |= {i: rejected[i] for i in rejected.keys() & moved}
    return RegionCheck([i in moved for i in range(len(chains))], lost, before, region_of)


def _lines(topology, paths, closed):
    """Return the line of each path; None where there is no path."""
    pairs = [
        np.empty((0, 2), dtype=np.int32) if path is None else edge_paths.contour_edges(path, is_closed)
        for path, is_closed in zip(paths, closed)
    ]
    ends = np.cumsum([len(some) for some in pairs])[:-1]
    edges, forward = topology.find(np.concatenate(pairs))
    return [_line(topology, *found) for found in zip(np.split(edges, ends), np.split(forward, ends))]


def _line(topology, edges, forward):
    """Return the line of a path without its edges on the mesh border, which bound nothing; None if no edge is left."""
    forward, edges = forward[topology.inner[edges]], edges[topology.inner[edges]]
    left, right = topology.left[edges], topology.right[edges]
    return _Line(edges, np.where(forward, left, right), np.where(forward, right, left)) if len(edges) else None


class _Partition:
    """The pieces into which marked edges and lines divide a surface, if all or some of them are walls."""

    def __init__(self, topology, marked, lines):
        self._topology = topology
        self._all = marked | self.walls(line for line in lines if line)
        self._smallest = regions(topology, self._all)

    def walls(self, lines):
        walls = np.zeros(len(self._topology.edges), dtype=bool)
        for line in lines:
            walls[line.edges] = True
        return walls

    def pieces(self, walls):
        """Return the piece of each face between these walls."""
        return joined(self._topology, self._smallest, np.flatnonzero(self._all & ~walls))


def _assign_regions(partition, before, given, lines):
    """Return the region of each face, judged by the sides of the lines; and the suspects, None if all regions survive.

    Suspects are dictionaries from lines to the region that they would remove, or -1: first the lines that share edges,
    then those that split what lies along them, then those around split or joined regions. Use each only if the ones
    before it are empty.
    """
    pieces = partition.pieces(partition.walls(lines))
    rows = _piece_regions(before, pieces, given, lines)
    region_of = np.full(len(pieces), -1)
    region_of[rows[:, 0]] = rows[:, 1]
    joined_pieces = _duplicates(rows[:, 0])
    split_regions = _duplicates(rows[:, 1])
    overlapping = _overlapping(before, given, lines)
    if not (joined_pieces or split_regions or overlapping):
        return region_of[pieces], None
    splitting = [i for i, line in enumerate(lines) if not line.has_one_label_on_each_side(pieces)]
    around = [
        i
        for i, (line, old) in enumerate(zip(lines, given))
        if line.touches(pieces, joined_pieces) or old.touches(before, split_regions)
    ]
    return region_of[pieces], (overlapping, dict.fromkeys(splitting, -1), dict.fromkeys(around, -1))


def _piece_regions(before, pieces, given, lines):
    """Return all (piece, region) pairs on the same side of the same line; a piece without lines has its old region."""
    rows = [
        np.column_stack([pieces[new], before[old] if new is old else np.full(len(new), before[old[0]])])
        for one, other in zip(given, lines)
        for old, new in ((one.left, other.left), (one.right, other.right))
    ]
    unbounded = np.setdiff1d(pieces, np.concatenate([row[:, 0] for row in rows]))
    return np.unique(np.concatenate([*rows, np.column_stack([unbounded, before[unbounded]])]), axis=0)


def _overlapping(before, given, lines):
    """Return the lines that share an edge with another line, each with the region that lay between them."""
    edges = np.concatenate([line.edges for line in lines])
    owners = np.repeat(np.arange(len(lines)), [len(line.edges) for line in lines])
    order = np.argsort(edges, kind="stable")
    edges, owners = edges[order], owners[order]
    same = edges[1:] == edges[:-1]
    overlapping = {}
    for one, other in zip(owners[:-1][same].tolist(), owners[1:][same].tolist()):
        shared = given[one].labels_along(before) & given[other].labels_along(before)
        overlapping[one] = overlapping[other] = min(shared, default=-1)
    return overlapping


def _duplicates(values):
    values, counts = np.unique(values, return_counts=True)
    return set(values[counts > 1].tolist())
