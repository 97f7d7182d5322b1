# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads selected edges as loops and chains, also where spurs hang off them or they are drawn twice. Needs no Blender.

A connected piece of edges that branches may enclose cells: regions that are thin and small. If these are shrunk to
nothing, what is left has no loop, one, or more. With one, the shortest loop that goes once round is meant; with none,
the chain between the ends farthest apart. All else must lie near it; otherwise it is not clear what is meant.
"""

from collections import Counter, deque
from dataclasses import dataclass, field

import numpy as np

from . import dashes, edge_paths
from .edge_graphs import EdgeGraph
from .faces import edge_keys

_THIN = 0.08  # a cell's mean width, as a fraction of the outline of the largest region beside it
_SMALL = 0.25  # a cell's area, as a fraction of that region's
_NEAR = 0.25  # how far what is left out may lie from the contour, as a fraction of its length


@dataclass(frozen=True)
class Contour:
    """A contour that is read from selected edges."""

    vertices: np.ndarray  # in order; a closed one does not repeat its first
    closed: bool
    beside: np.ndarray  # (n, 2) selected edges that are left out
    joined: bool = False  # whether it is made of dashes, so that not all of its edges are selected

    @property
    def as_selected(self):
        """Whether its edges are just those that are selected."""
        return not (self.joined or len(self.beside))


@dataclass(frozen=True)
class EdgeContours:
    """What is read from selected edges."""

    contours: list = field(default_factory=list)
    branching: list = field(default_factory=list)  # (n, 2) edges of which it is not clear what is meant
    left_out: Counter = field(default_factory=Counter)  # how many of each kind
    dashes: int = 0  # how many chains were joined to others


def read_edges(edges, read_faces, closing=False):
    """Return the contours of (n, 2) selected edges; read_faces() returns the mesh's Faces, and is called if needed.

    closing: whether chains are to be closed, so that all dashes in a row are part of one loop.
    """
    pieces = edge_paths.sort_edges(edges)
    none = np.empty((0, 2), dtype=np.int32)
    contours = [Contour(loop, True, none) for loop in pieces.loops]
    contours += [Contour(chain, False, none) for chain in pieces.chains]
    unclear, left_out = [], Counter()
    if pieces.branching:
        for piece in _pieces(pieces.branching, read_faces()):
            contour = piece.contour()
            if contour is None:
                unclear.append(piece.pairs)
            else:
                contours.append(contour)
                left_out += piece.left_out(contour)
    contours, joined = _without_gaps(contours, read_faces, closing)
    contours.sort(key=lambda contour: (not contour.closed, contour.vertices.min()))
    return EdgeContours(contours, unclear, left_out, joined)


def _without_gaps(contours, read_faces, closing):
    """Return the contours with dashes joined, and how many were."""
    loops, chains = ([contour for contour in contours if contour.closed is closed] for closed in (True, False))
    taken = np.concatenate([np.empty(0, dtype=np.int32), *(loop.vertices for loop in loops)]).tolist()
    joined, alone = dashes.join([chain.vertices for chain in chains], taken, read_faces, closing)
    for one in joined:
        beside = np.concatenate([chains[number].beside for number in one.dashes])
        loops.append(Contour(one.vertices, one.closed, beside, joined=True))
    return loops + [chains[number] for number in alone], len(chains) - len(alone)


def _pieces(branching, faces):
    """Return the branching pieces with the cells that each encloses."""
    numbers = [faces.find_edges(pairs) for pairs in branching]
    wall = np.full(len(faces.edges), -1)
    for i, own in enumerate(numbers):
        wall[own] = i
    labels = np.append(faces.regions(wall < 0), -1)  # for face -1
    areas = np.bincount(labels[:-1], weights=faces.areas, minlength=faces.count)
    sides = labels[faces.edge_faces]
    # A region that a border of the mesh or of what is hidden bounds is not enclosed.
    bounding = (wall < 0) & (faces.uses > 0) & (sides < 0).any(axis=1)
    is_open = np.isin(np.arange(faces.count), sides[bounding])
    return [_Piece(pairs, faces, own, sides, areas, is_open, wall) for pairs, own in zip(branching, numbers)]


class _Piece:
    """A connected piece of edges that branches."""

    def __init__(self, pairs, faces, numbers, sides, areas, is_open, wall):
        self.pairs, self._faces, self._lengths = pairs, faces, faces.lengths(numbers)
        self._sides = sides[numbers]
        self._inner = (faces.edge_faces[numbers] >= 0).all(axis=1)  # no contour runs along the border of the mesh
        self._vertices, self._ends = np.unique(pairs, return_inverse=True)
        self._ends = self._ends.reshape(-1, 2)
        no_cells = np.empty(0, dtype=int)  # a single loop is meant, however thin what it encloses
        self._cells = no_cells if self._loop_count() < 2 else self._find_cells(numbers, sides, areas, is_open, wall)

    def contour(self):
        """Return the loop or chain that is meant; None if it is not clear."""
        rank = self._loop_count() - len(self._cells)
        if rank not in (0, 1):
            return None
        vertices = self._loop() if rank else self._chain()
        if vertices is None or len(set(vertices)) < len(vertices) or self._is_far((vertices, rank == 1)):
            return None
        vertices = np.array(vertices, dtype=np.int32)
        closed = rank == 1
        vertices = _from_the_lowest(vertices) if closed else vertices if vertices[0] < vertices[-1] else vertices[::-1]
        return Contour(vertices, closed, _without(self.pairs, edge_paths.contour_edges(vertices, closed)))

    def _loop_count(self):
        """Return how many loops there are that are independent of each other."""
        return len(self.pairs) - len(self._vertices) + 1

    def left_out(self, contour):
        """Return how many spurs are left out, and how many other edges."""
        ends, counts = np.unique(self.pairs, return_counts=True)
        spurs = np.setdiff1d(ends[counts == 1], contour.vertices)
        return Counter({"spur": len(spurs), "doubled edge": len(_without_spurs(contour.beside, contour.vertices))})

    def _find_cells(self, numbers, sides, areas, is_open, wall):
        """Return the regions that are shrunk to nothing."""
        own = sides[numbers]
        regions = np.unique(own[own >= 0])
        if not len(regions):
            return regions
        once = (own[:, 0] != own[:, 1])[:, None] & (own >= 0)
        outlines = np.bincount(own[once], np.broadcast_to(self._lengths[:, None], own.shape)[once], len(areas))
        largest = regions[np.argmax(areas[regions])]
        others = sides[(wall >= 0) & (wall != wall[numbers[0]])]
        cells = np.setdiff1d(regions[~is_open[regions]], [*np.unique(others), largest])
        thin = 2 * areas[cells] < _THIN * outlines[largest] * outlines[cells]
        cells = cells[thin & (areas[cells] < _SMALL * areas[largest])]
        return cells if areas[cells].sum() < areas[largest] else cells[:0]

    def _loop(self):
        """Return the shortest loop that goes once round; None if there is none off the border of the mesh."""
        crossing = np.zeros(len(self.pairs), dtype=bool)
        crossing[self._cut()] = True
        pairs, lengths = self.pairs[self._inner].tolist(), self._lengths[self._inner].tolist()
        crossing = np.flatnonzero(crossing[self._inner]).tolist()
        graph = EdgeGraph(pairs, lengths, crossing)
        best, least = None, np.inf
        for i in crossing:
            (a, b), length = pairs[i], lengths[i]
            found = graph.path(a, b, limit=least - length)
            if found is not None and found[1] + length < least:
                best, least = found[0], found[1] + length
        return best

    def _cut(self):
        """Return edges of which every loop that goes once round has an odd number, and every cell an even number.

        A spanning tree of the regions, cells and one for all others, and one of the vertices that shares no edge with
        it leave just one edge. The cut is this edge and what joins its two sides in the tree of regions. There is none
        where faces do not fit together.
        """
        places = np.searchsorted(self._cells, self._sides) if len(self._cells) else np.zeros_like(self._sides)
        inside = np.isin(self._sides, self._cells)
        nodes = np.where(inside, places + 1, 0)
        before = _spanning_tree(nodes.tolist(), 0)
        used = {edge for edge, _ in before.values() if edge is not None}
        tree = _spanning_tree(self._ends.tolist(), 0, used)
        used |= {edge for edge, _ in tree.values() if edge is not None}
        rest = sorted(set(range(len(self.pairs))) - used)
        if len(rest) != 1 or not before.keys() >= set(nodes[rest[0]].tolist()):
            return []
        cut = set(rest)
        for node in nodes[rest[0]].tolist():
            while before[node][0] is not None:
                edge, node = before[node]
                cut ^= {edge}
        return sorted(cut)

    def _chain(self):
        """Return the shortest path between the ends that are farthest apart."""
        graph = EdgeGraph(self.pairs.tolist(), self._lengths.tolist())
        one = graph.farthest(int(self._vertices[0]))
        return graph.path(one, graph.farthest(one))[0]

    def _is_far(self, contour):
        """Whether something lies far from the contour."""
        length = self._faces.lengths(self._faces.find_edges(edge_paths.contour_edges(*contour))).sum()
        points, kept = (self._faces.points[vertices] for vertices in (self._vertices, contour[0]))
        reach = [np.linalg.norm(kept - point, axis=1).min() for point in points]
        return max(reach) > _NEAR * length


def _spanning_tree(pairs, root, without=()):
    """Return for each node the edge that leads to it and the node before, None at the root."""
    around = {}
    for edge, (a, b) in enumerate(pairs):
        if edge not in without:
            around.setdefault(a, []).append((edge, b))
            around.setdefault(b, []).append((edge, a))
    before, queue = {root: (None, None)}, deque([root])
    while queue:
        node = queue.popleft()
        for edge, other in around.get(node, ()):
            if other not in before:
                before[other] = edge, node
                queue.append(other)
    return before


def _from_the_lowest(loop):
    """Return a loop from its lowest vertex on, towards the lower of its neighbors."""
    loop = np.roll(loop, -int(np.argmin(loop)))
    return loop if loop[1] < loop[-1] else np.roll(loop[::-1], 1)


def _without(edges, others):
    return edges[~np.isin(edge_keys(edges), edge_keys(others))]


def _without_spurs(edges, kept):
    """Return edges without those that lead to a free end, which none of the kept vertices is."""
    while True:
        vertices, counts = np.unique(edges, return_counts=True)
        tips = np.isin(edges, np.setdiff1d(vertices[counts == 1], kept)).any(axis=1)
        if not tips.any():
            return edges
        edges = edges[~tips]
