# SPDX-License-Identifier: GPL-3.0-or-later
"""The chains into which the marked edges of a mesh fall between their junctions. Needs no Blender."""

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from .topology import Topology


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
