# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of a network's new chains can be taken, so that every region stays in one piece. Needs no Blender."""

from dataclasses import dataclass

import numpy as np

from . import edge_paths
from .topology import joined, regions


@dataclass(frozen=True)
class RegionCheck:
    """Which new chains are taken, and the region of each face with them."""

    taken: list  # for each chain, whether it takes its new path
    lost: (
        dict  # chain that stays -> the region that would have vanished with it, or -1 where regions would join or split
    )
    before: np.ndarray  # (faces,) regions, as `regions` has them
    after: np.ndarray  # the same names, where the faces now belong


@dataclass(frozen=True)
class _Line:
    """A chain's edges, and the faces on its two sides."""

    edges: np.ndarray
    left: np.ndarray
    right: np.ndarray

    def touches(self, names, bad):
        return bool(bad) and bool(bad & self.names(names))

    def names(self, names):
        return {*names[self.left].tolist(), *names[self.right].tolist()}

    def one_on_each_side(self, names):
        return len(np.unique(names[self.left])) == len(np.unique(names[self.right])) == 1


def check_regions(topology, marked, chains, paths):
    """Takes as many of the new paths (None: stays) as leave every region in one piece, on the side where it was.

    What is left of a chain before is left of it after. Chains round a region that would vanish, join another one or
    fall apart stay where they are; with all chains as they were nothing is wrong, so this ends.
    """
    closed = [chain.closed for chain in chains]
    lines = _lines(topology, [chain.vertices for chain in chains] + list(paths), 2 * closed)
    given, new = lines[: len(chains)], lines[len(chains) :]
    cuts = _Cuts(topology, marked, lines)
    before = cuts.pieces(marked)
    lost = {i: -1 for i, path in enumerate(paths) if path is not None and new[i] is None}
    while True:
        lines = [one if i in lost or new[i] is None else new[i] for i, one in enumerate(given)]
        moved = {i for i, line in enumerate(lines) if line is not given[i]}
        region_of, suspects = _claims(cuts, before, given, lines)
        if not moved or suspects is None:
            break
        named = next(found for found in (*suspects, dict.fromkeys(moved, -1)) if found.keys() & moved)
        lost |= {i: named[i] for i in named.keys() & moved}
    return RegionCheck([i in moved for i in range(len(chains))], lost, before, region_of)


def _lines(topology, paths, closed):
    """The line of each path; None where there is no path."""
    pairs = [
        np.empty((0, 2), dtype=np.int32) if path is None else edge_paths.contour_edges(path, is_closed)
        for path, is_closed in zip(paths, closed)
    ]
    ends = np.cumsum([len(some) for some in pairs])[:-1]
    edges, forward = topology.find(np.concatenate(pairs))
    return [_line(topology, *found) for found in zip(np.split(edges, ends), np.split(forward, ends))]


def _line(topology, edges, forward):
    """Of a path along a border that part bounds nothing; None where nothing else is left of it."""
    forward, edges = forward[topology.inner[edges]], edges[topology.inner[edges]]
    left, right = topology.left[edges], topology.right[edges]
    return _Line(edges, np.where(forward, left, right), np.where(forward, right, left)) if len(edges) else None


class _Cuts:
    """The pieces into which marked edges and lines cut a surface, with some of them as walls or all."""

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
        """The regions between these walls."""
        return joined(self._topology, self._smallest, np.flatnonzero(self._all & ~walls))


def _claims(cuts, before, given, lines):
    """The region of each face by what lies beside the lines; and the suspects, None where all regions are as they were.

    Suspects are lines with the region that has no room left beside them, or -1: those that share edges, those that tear
    what lies along them, and those round what is torn or joined. Each list is for where the one before is empty.
    """
    pieces = cuts.pieces(cuts.walls(lines))
    rows = _claimed(before, pieces, given, lines)
    region_of = np.full(len(pieces), -1)
    region_of[rows[:, 0]] = rows[:, 1]
    bad_pieces = _repeated(rows[:, 0])
    bad_regions = _repeated(rows[:, 1])
    squeezed = _squeezed(before, given, lines)
    if not (bad_pieces or bad_regions or squeezed):
        return region_of[pieces], None
    tearing = [i for i, line in enumerate(lines) if not line.one_on_each_side(pieces)]
    around = [
        i
        for i, (line, old) in enumerate(zip(lines, given))
        if line.touches(pieces, bad_pieces) or old.touches(before, bad_regions)
    ]
    return region_of[pieces], (squeezed, dict.fromkeys(tearing, -1), dict.fromkeys(around, -1))


def _claimed(before, pieces, given, lines):
    """All pairs of a piece and a region on the same side of the same line; a piece without lines is what it was."""
    rows = [
        np.column_stack([pieces[new], before[old] if new is old else np.full(len(new), before[old[0]])])
        for one, other in zip(given, lines)
        for old, new in ((one.left, other.left), (one.right, other.right))
    ]
    unseen = np.setdiff1d(pieces, np.concatenate([row[:, 0] for row in rows]))
    return np.unique(np.concatenate([*rows, np.column_stack([unseen, before[unseen]])]), axis=0)


def _squeezed(before, given, lines):
    """The lines that share an edge with another one, and the region that lay between them."""
    edges = np.concatenate([line.edges for line in lines])
    owners = np.repeat(np.arange(len(lines)), [len(line.edges) for line in lines])
    order = np.argsort(edges, kind="stable")
    edges, owners = edges[order], owners[order]
    alike = edges[1:] == edges[:-1]
    squeezed = {}
    for one, other in zip(owners[:-1][alike].tolist(), owners[1:][alike].tolist()):
        shared = given[one].names(before) & given[other].names(before)
        squeezed[one] = squeezed[other] = min(shared, default=-1)
    return squeezed


def _repeated(values):
    values, counts = np.unique(values, return_counts=True)
    return set(values[counts > 1].tolist())
