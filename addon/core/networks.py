# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks of contours: seams, and the borders between the regions of a labeling. Needs no Blender.

A network falls into chains between its junctions, and closed loops. All of them move at once and keep apart; the faces
that they bound before and after tell whether every region is still there, in one piece.
"""

from dataclasses import dataclass, replace

import numpy as np

from . import edge_paths, messages, native, parameters
from .chains import Network
from .region_check import RegionCheck, check_regions
from .search import fraction_of
from .topology import Topology, regions


@dataclass(frozen=True)
class Plan:
    """What became of a network; nothing is written yet.

    Regions beside contours across faces are checked once these are cut into the mesh, where they run along edges: see
    `check_cut`.
    """

    chains: list
    results: list  # for each chain its native result; None where there is none
    problems: dict  # chain -> why it cannot be optimized, in words
    paths: list  # for each chain its new vertices, -1 where it crosses an edge; None where it stays
    topology: Topology
    region_check: RegionCheck | None = None

    @property
    def changed(self):
        assert self.region_check is not None
        return any(self.region_check.taken)

    def taken_results(self):
        """The native results of the chains that were optimized and not refused afterwards."""
        assert self.region_check is not None
        left = self.problems.keys() | self.region_check.lost.keys()
        return {
            i: result
            for i, (chain, result) in enumerate(zip(self.chains, self.results))
            if result is not None and chain.movable and i not in left
        }

    def old_edges(self):
        """(n, 2) vertex pairs of the chains that move."""
        return self._edges([chain.vertices for chain in self.chains])

    def moved(self):
        """The chains with a new path, by their numbers; once regions are checked, those that take it."""
        return [i for i, path in enumerate(self.paths) if path is not None and self._takes(i)]

    def _takes(self, i):
        return self.region_check is None or self.region_check.taken[i]

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
        pairs = [edge_paths.contour_edges(paths[i], self.chains[i].closed) for i in self.moved()]
        return np.concatenate(pairs) if pairs else np.empty((0, 2), dtype=np.int32)


@dataclass
class NetworkSearch:
    """The network of one mesh, and what becomes of it."""

    error: ValueError | None = None  # why there is no network, or none that can be searched
    network: Network | None = None
    arrays: object = None  # of the mesh, where something is movable
    surface: object = None  # the native one made from them
    plan: Plan | None = None


def optimize_networks(searches, settings, progress=None):
    """Gives each search without a problem its plan, or the problem that keeps it from one."""
    searches = [search for search in searches if search.error is None]
    for i, search in enumerate(searches):
        own_progress = fraction_of(progress, i, len(searches))
        try:
            search.plan = optimize(search.surface, search.network, own_progress, **settings)
        except ValueError as error:
            search.error = error


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
    return plan if plan.across_faces else replace(plan, region_check=check_regions(topology, marked, chains, paths))


def check_cut(plan, topology, given, paths):
    """A plan for the mesh with contours cut into it, in which they run along edges.

    given: the vertices of each chain there; paths: those of each contour, None for those that were not cut.
    """
    chains = [replace(chain, vertices=vertices) for chain, vertices in zip(plan.chains, given)]
    marked = np.zeros(len(topology.edges), dtype=bool)
    for chain in chains:
        marked[topology.find(edge_paths.contour_edges(chain.vertices, chain.closed))[0]] = True
    region_check = check_regions(topology, marked, chains, paths)
    return replace(plan, chains=chains, paths=paths, topology=topology, region_check=region_check)


def _all_stay(network):
    before = regions(network.topology, network.marked)
    return RegionCheck([False] * len(network.chains), {}, before, before)


def _leaves_edges(topology, path, closed):
    return bool(np.any(path < 0)) or not topology.has(edge_paths.contour_edges(path, closed))


def _new_path(chain, result):
    if result is None or not chain.movable or np.array_equal(result.vertices, chain.vertices):
        return None
    return result.vertices


def _search(surface, chains, options, progress):
    """Results and problems by chain. A chain in error stays where it is, and the others keep clear of it."""
    found = native.module().optimize_all(
        surface,
        native.contours(chains),
        options=options,
        required_vertices=[list(chain.required) for chain in chains],
        progress=progress,
        errors="return",
    )
    problems = {i: messages.problem(error) for i, error in enumerate(found) if isinstance(error, ValueError)}
    return [None if i in problems else result for i, result in enumerate(found)], problems
