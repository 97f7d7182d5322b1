# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the borders of selected faces as simple loops and chains, without what was hardly meant. Needs no Blender.

A border is walked with the selected faces to its left. Where it touches itself at a vertex, it turns through the
selected faces there, and what it encloses between two visits of a vertex becomes a loop of its own.
"""

from dataclasses import dataclass, field

import numpy as np

from . import edge_paths
from .faces import Faces

_STRAY = 0.02  # of the area of the selected faces: smaller islands and holes are left out,
_OUTSIZED = 0.25  # where they are also smaller than this fraction of the largest island or hole
_NO_FACES = np.empty(0, dtype=np.int64)


@dataclass(frozen=True)
class FaceBorders:
    """The borders of selected faces, with these to their left; each list is in the order of lowest vertices."""

    loops: list = field(default_factory=list)  # vertices in order; the first is not repeated
    chains: list = field(default_factory=list)
    branching: list = field(default_factory=list)  # (n, 2) edges that are no contour
    islands: np.ndarray = field(default_factory=lambda: _NO_FACES)  # selected faces that are left out
    pinholes: np.ndarray = field(default_factory=lambda: _NO_FACES)  # unselected faces that count as selected
    island_count: int = 0
    pinhole_count: int = 0


class FaceSelection(Faces):
    """The selected faces of a mesh."""

    def __init__(self, points, edges, face_offsets, corner_vertices, corner_edges, hidden_faces, selected):
        super().__init__(points, edges, face_offsets, corner_vertices, corner_edges, hidden_faces)
        self.selected = selected & ~self.hidden

    def vertices(self):
        """Return the vertices of the selected faces."""
        return np.unique(self.corner_vertices[self.selected[self.corner_faces]])

    def borders(self):
        """Return the borders without stray islands and pinholes."""
        everything = _walked(self, self.selected)
        if len(everything.loops) + len(everything.chains) + len(everything.branching) < 2:
            return everything
        islands, pinholes, counts = self._strays()
        cleaned = self.selected.copy()
        cleaned[islands], cleaned[pinholes] = False, True
        found = _walked(self, cleaned)
        if not (len(islands) or len(pinholes)) or not (found.loops or found.chains):
            return everything
        return FaceBorders(found.loops, found.chains, found.branching, islands, pinholes, *counts)

    def border(self, selected):
        """Return the edges between selected and visible other faces, by number; see edge_paths.region_border."""
        return edge_paths.region_border(self.offsets, self.corner_edges, selected, self.hidden, len(self.edges))

    def directed(self, selected, border):
        """Return the corner of the selected face at which each border edge begins."""
        corners = np.flatnonzero(selected[self.corner_faces])
        first = np.full(len(self.edges), -1)
        first[self.corner_edges[corners]] = corners
        return first[border]

    def pairs(self, corners):
        """Return the (n, 2) vertices of the edges that begin at corners."""
        return np.column_stack([self.corner_vertices[corners], self.corner_vertices[self.next_corners(corners)]])

    def successors(self, selected, border, corners):
        """Return which border edge follows each one, -1 where the faces end; None if faces do not fit together."""
        place = np.full(len(self.edges), -1)
        place[border] = np.arange(len(border))
        first, last = self.edge_corners
        following = np.full(len(border), -1)
        turning = np.arange(len(border))
        here = self.next_corners(corners)
        heads = self.corner_vertices[here]
        while len(turning):
            edges = self.corner_edges[here]
            following[turning] = place[edges]
            on = (place[edges] < 0) & (self.uses[edges] > 1)  # else it is found, or the border of the mesh
            turning, here, heads, edges = turning[on], here[on], heads[on], edges[on]
            twins = first[edges] + last[edges] - here
            on = selected[self.corner_faces[twins]]  # else it is hidden
            if np.any(self.uses[edges] > 2) or np.any(self.corner_vertices[self.next_corners(twins[on])] != heads[on]):
                return None
            turning, here, heads = turning[on], self.next_corners(twins[on]), heads[on]
        return following if _is_injective(following) else None

    def _strays(self):
        """Return the faces of stray islands, those of pinholes, and how many of each there are.

        Only pieces beside the border count: others bound no contour.
        """
        one, other = self.edge_faces.T
        unlike = self.selected[one] != self.selected[other]
        labels = self.regions(~unlike)
        areas = np.bincount(labels, weights=self.areas, minlength=self.count)
        beside = unlike & (self.edge_faces >= 0).all(axis=1)
        pieces = np.unique(labels[self.edge_faces[beside]])
        limit = _STRAY * areas[np.unique(labels[self.selected])].sum()
        found = []
        for kind in (pieces[self.selected[pieces]], pieces[~self.selected[pieces]]):
            largest = areas[kind].max(initial=0.0)
            found.append(kind[(areas[kind] < limit) & (areas[kind] < _OUTSIZED * largest)])
        islands, pinholes = (np.flatnonzero(np.isin(labels, kind)) for kind in found)
        return islands, pinholes, [len(kind) for kind in found]


def _walked(selection, selected):
    """Return the borders of selected faces, all of them."""
    border = selection.border(selected)
    corners = selection.directed(selected, border)
    pairs = selection.pairs(corners)
    following = selection.successors(selected, border, corners)
    if following is None:  # windings disagree or edges have more than two faces: only edges count
        pieces = edge_paths.sort_directed_edges(pairs)
        return FaceBorders(pieces.loops, pieces.chains, pieces.branching)
    loops, chains = [], []
    for walk, closed in _walks(pairs, following):
        inner, rest = _split(walk)
        loops += inner + [rest] * closed
        chains += [rest] * (not closed)
    loops = [np.roll(loop, -int(np.argmin(loop))) for loop in map(np.array, loops) if len(loop) > 2]
    chains = [np.array(chain) for chain in chains if len(chain) > 1]
    return FaceBorders(sorted(loops, key=min), sorted(chains, key=min))


def _is_injective(following):
    found = following[following >= 0]
    return len(np.unique(found)) == len(found)


def _walks(pairs, following):
    """Return the vertices along each walk, and whether it is closed; the first vertex of a closed one is its lowest."""
    started = np.ones(len(pairs), dtype=bool)
    started[following[following >= 0]] = False
    order = np.lexsort((pairs[:, 1], pairs[:, 0], ~started))  # starts of open walks first
    tails, heads, following, used, walks = pairs[:, 0].tolist(), pairs[:, 1].tolist(), following.tolist(), set(), []
    for start in order.tolist():
        edge, walk, closed = start, [], not started[start]
        while edge >= 0 and edge not in used:
            used.add(edge)
            walk.append(edge)
            edge = following[edge]
        if walk:
            walks.append(([tails[i] for i in walk] + [heads[walk[-1]]] * (not closed), closed))
    return walks


def _split(walk):
    """Return the loops between two visits of a vertex, and what is left of the walk."""
    loops, rest, place = [], [], {}
    for vertex in walk:
        if vertex in place:
            loops.append(rest[place[vertex] :])
            for passed in rest[place[vertex] + 1 :]:
                del place[passed]
            del rest[place[vertex] + 1 :]
        else:
            place[vertex] = len(rest)
            rest.append(vertex)
    return loops, rest
