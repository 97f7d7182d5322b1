# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks of contours: seams, and the borders between the regions of a labelling. Needs no Blender.

A network falls into chains between its junctions, and closed loops. All of them move at once and keep apart; the faces
that they bound before and after tell whether every region is still there, in one piece.
"""

from collections import defaultdict
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from . import contours, native, parameters, report


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
    return contours.component_labels(
        np.column_stack([topology.left[passable], topology.right[passable]]), topology.face_count
    )


def joined(topology, pieces, edges):
    """The same where some edges are no walls any more; far quicker than from the beginning."""
    edges = edges[topology.inner[edges]]
    ends = np.column_stack([pieces[topology.left[edges]], pieces[topology.right[edges]]])
    return contours.component_labels(ends, topology.face_count)[pieces]


def label_borders(topology, labels):
    """The edges between two shown faces of different labels."""
    borders = topology.inner.copy()
    borders[borders] = labels[topology.left[borders]] != labels[topology.right[borders]]
    return borders


# ---- chains


@dataclass(frozen=True)
class Chain:
    """A piece of a network between two junctions, or a closed loop."""

    vertices: np.ndarray  # in order; a closed one does not repeat its first
    closed: bool
    chosen: bool  # may move
    required: tuple = ()  # vertices that it must keep, besides the ends that it shares with others

    @property
    def edge_count(self):
        return len(self.vertices) if self.closed else len(self.vertices) - 1

    @property
    def movable(self):
        """A single edge is the shortest way already, and says nothing about the surface around it."""
        return self.chosen and self.edge_count > 1


@dataclass(frozen=True)
class Network:
    """The marked edges of a mesh, and the chains into which they fall."""

    topology: Topology
    marked: np.ndarray  # (n,) edges
    chains: list

    @property
    def movable(self):
        return any(chain.movable for chain in self.chains)


def make_network(topology, marked, chosen=None):
    """Of the marked edges only the chosen ones move (None: all of them)."""
    return Network(topology, marked, find_chains(topology, marked, chosen))


def find_chains(topology, marked, chosen=None):
    """The chains of the marked edges between two shown faces: every one of these edges is in exactly one chain.

    They meet where other than two edges come together, on the border, and where chosen edges meet others.
    """
    chosen = marked if chosen is None else chosen
    edges = np.flatnonzero(marked & topology.inner)
    around = defaultdict(list)
    for edge, pair in zip(edges.tolist(), topology.edges[edges].tolist()):
        for vertex in pair:
            around[vertex].append(edge)
    free = {v for v, (one, *more) in around.items() if len(more) == 1 and chosen[one] == chosen[more[0]]}
    nodes = sorted((around.keys() - free) | (around.keys() & topology.border_vertices))
    walk = _Walk(topology, around, frozenset(nodes), chosen)
    starts = [(node, edge) for node in nodes for edge in around[node]]
    starts += [(vertex, around[vertex][0]) for vertex in sorted(free)]
    return [walk.follow(*start) for start in starts if start[1] not in walk.used]


class _Walk:
    """Follows the edges of a network from junction to junction, each once."""

    def __init__(self, topology, around, nodes, chosen):
        self._ends, self._held = topology.edges, topology.hidden_vertices
        self._around, self._nodes, self._chosen = around, nodes, chosen
        self.used = set()

    def follow(self, start, edge):
        vertices, chosen = [start], bool(self._chosen[edge])
        while True:
            self.used.add(edge)
            here = int(self._ends[edge].sum()) - vertices[-1]
            if here == start:
                break
            vertices.append(here)
            if here in self._nodes:
                break
            one, other = self._around[here]
            edge = one if other == edge else other
        closed = here == start
        required = [start] if closed and start in self._nodes else []
        required += [v for v in (vertices[0], vertices[-1]) if not closed and v in self._held]
        return Chain(np.array(vertices, dtype=np.int32), closed, chosen, tuple(required))


# ---- what follows from new chains


@dataclass(frozen=True)
class Settlement:
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


def settle(topology, marked, chains, paths):
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
    return Settlement([i in moved for i in range(len(chains))], lost, before, region_of)


def _lines(topology, paths, closed):
    """The line of each path; None where there is no path."""
    pairs = [
        np.empty((0, 2), dtype=np.int32) if path is None else contours.contour_edges(path, is_closed)
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


# ---- the search


@dataclass(frozen=True)
class Plan:
    """What became of a network; nothing is written yet.

    Contours across faces are settled once they are cut into the mesh, where they run along edges: see `settle_cut`.
    """

    chains: list
    results: list  # for each chain its native result; None where there is none
    problems: dict  # chain -> why it cannot be optimized, in words
    paths: list  # for each chain its new vertices, -1 where it crosses an edge; None where it stays
    topology: Topology
    settlement: Settlement | None = None

    @property
    def changed(self):
        return any(self.settlement.taken)

    def taken_results(self):
        """The native results of the chains that were optimized and not refused afterwards."""
        left = self.problems.keys() | self.settlement.lost.keys()
        return {
            i: result
            for i, (chain, result) in enumerate(zip(self.chains, self.results))
            if result is not None and chain.movable and i not in left
        }

    def old_edges(self):
        """(n, 2) vertex pairs of the chains that move."""
        return self._edges([chain.vertices for chain in self.chains])

    def moved(self):
        """The chains with a new path, by their numbers; once settled, those that take it."""
        return [i for i, path in enumerate(self.paths) if path is not None and self._takes(i)]

    def _takes(self, i):
        return self.settlement is None or self.settlement.taken[i]

    @property
    def across_faces(self):
        """Whether a new path leaves the edges of the mesh."""
        return any(_leaves_edges(self.topology, self.paths[i], self.chains[i].closed) for i in self.moved())

    def new_edges(self):
        """(n, 2) vertex pairs where they move to, without what lies on the border of the mesh."""
        pairs = self._edges(self.paths)
        edges, _ = self.topology.find(pairs)
        return pairs[self.topology.inner[edges] | self.topology.hidden[edges]]

    def _edges(self, paths):
        pairs = [contours.contour_edges(paths[i], self.chains[i].closed) for i in self.moved()]
        return np.concatenate(pairs) if pairs else np.empty((0, 2), dtype=np.int32)


def optimize(surface, network, progress=None, **settings):
    """Optimizes a network on its native surface, which is needed where something is movable.

    All chains are given to the search, since they keep each other away; the paths of those that must stay are dropped:
    no other contour passes where one was given.
    """
    options = native.module().Options(**parameters.network_options(**settings))
    topology, marked, chains = network.topology, network.marked, network.chains
    if not network.movable:
        nothing = [None] * len(chains)
        return Plan(chains, nothing, {}, nothing, topology, _all_stay(network))
    results, problems = _search(surface, chains, options, progress)
    paths = [_new_path(chain, result) for chain, result in zip(chains, results)]
    plan = Plan(chains, results, problems, paths, topology)
    return plan if plan.across_faces else replace(plan, settlement=settle(topology, marked, chains, paths))


def settle_cut(plan, topology, given, paths):
    """A plan for the mesh with contours cut into it, in which they run along edges.

    given: the vertices of each chain there; paths: those of each contour, None for those that were not cut.
    """
    chains = [replace(chain, vertices=vertices) for chain, vertices in zip(plan.chains, given)]
    marked = np.zeros(len(topology.edges), dtype=bool)
    for chain in chains:
        marked[topology.find(contours.contour_edges(chain.vertices, chain.closed))[0]] = True
    settlement = settle(topology, marked, chains, paths)
    return replace(plan, chains=chains, paths=paths, topology=topology, settlement=settlement)


def _all_stay(network):
    before = regions(network.topology, network.marked)
    return Settlement([False] * len(network.chains), {}, before, before)


def _leaves_edges(topology, path, closed):
    return bool(np.any(path < 0)) or not topology.has(contours.contour_edges(path, closed))


def _new_path(chain, result):
    if result is None or not chain.movable or np.array_equal(result.vertices, chain.vertices):
        return None
    return result.vertices


def _search(surface, chains, options, progress):
    """Results and problems by chain. The native module takes all or none: what it refuses is left out as a barrier."""
    problems = {}
    while True:
        given = [i for i in range(len(chains)) if i not in problems]
        try:
            found = _search_all(surface, chains, given, list(problems), options, progress) if given else []
        except ValueError as error:
            problems |= _refused(surface, chains, given, error)
        else:
            results = dict(zip(given, found))
            return [results.get(i) for i in range(len(chains))], problems


def _search_all(surface, chains, given, left_out, options, progress):
    barriers = [contours.contour_edges(chains[i].vertices, chains[i].closed) for i in left_out]
    return native.module().optimize_all(
        surface,
        [chains[i].vertices for i in given],
        closed=[chains[i].closed for i in given],
        options=options,
        required_vertices=[list(chains[i].required) for i in given],
        barriers=np.concatenate(barriers) if barriers else (),
        progress=progress,
    )


def _refused(surface, chains, given, error):
    """Those of the given chains that are no contours by themselves; or else the one that the message names."""
    problems = {i: native.contour_problem(surface, chains[i].vertices, chains[i].closed) for i in given}
    problems = {i: problem for i, problem in problems.items() if problem}
    if problems:
        return problems
    place = native.told_apart(error)[1]
    return dict.fromkeys(given if place is None else [given[place]], report.problem(error))
