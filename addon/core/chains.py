# SPDX-License-Identifier: GPL-3.0-or-later
"""Divides the marked edges of a mesh into chains between junctions. Does not need Blender."""

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from .topology import Topology


@dataclass(frozen=True)
class Chain:
    """A piece of a network between two junctions, or a closed loop."""

    vertices: np.ndarray  # in order; a closed chain does not repeat its first vertex
    closed: bool
    chosen: bool  # whether it may move
    required: tuple = ()  # vertices that it must keep, besides the ends that it shares with other chains

    @property
    def edge_count(self):
        return len(self.vertices) if self.closed else len(self.vertices) - 1

    @property
    def movable(self):
        """Whether it may move. A single edge is the shortest path already and has no neighborhood to search."""
        return self.chosen and self.edge_count > 1


@dataclass(frozen=True)
class Network:
    """The marked edges of a mesh, and the chains they form."""

    topology: Topology
    marked: np.ndarray  # (n,) edges
    chains: list

    @property
    def movable(self):
        return any(chain.movable for chain in self.chains)


def make_network(topology, marked, chosen=None):
    """Return the network of the marked edges, of which only the chosen ones may move (None: all of them)."""
    return Network(topology, marked, find_chains(topology, marked, chosen))


def find_chains(topology, marked, chosen=None):
    """Return the chains of the marked edges that lie between two visible faces; each edge is in exactly one chain.

    Chains end at vertices where the number of marked edges is not two, on the mesh border, and where chosen edges meet
    edges that were not chosen.
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
    """Follows the edges of a network from junction to junction, each edge once."""

    def __init__(self, topology, around, nodes, chosen):
        self._ends, self._hidden = topology.edges, topology.hidden_vertices
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
        required += [v for v in (vertices[0], vertices[-1]) if not closed and v in self._hidden]
        return Chain(np.array(vertices, dtype=np.int32), closed, chosen, tuple(required))
