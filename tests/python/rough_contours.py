# SPDX-License-Identifier: GPL-3.0-or-later
"""Rough contours of bounded length and of all kinds, such as users select, on triangle meshes with any defects."""

import importlib
import sys
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
sort_edges = importlib.import_module("addon.core.edge_paths").sort_edges

LONGEST = 150  # the maximum number of points of a contour
REACH = 40  # the maximum number of edges from the seed of a contour to its farthest point


class RoughContours:
    """Each kind is a method that returns a list of (vertices, closed), which is empty if there is none of that kind."""

    def __init__(self, positions, triangles, rng):
        self.positions, self.triangles, self.rng = positions, triangles, rng
        self.corners = np.unique(triangles)

    @cached_property
    def links(self):
        one, two = self.triangles.T.ravel(), np.roll(self.triangles, -1, axis=1).T.ravel()
        ones = np.ones(len(one), dtype=bool)
        links = coo_array((ones, (one, two)), shape=(len(self.positions),) * 2).tocsr()
        return (links + links.T).tocsr()

    def seed(self):
        return int(self.rng.choice(self.corners))

    def ball(self, seed, hops):
        """A mask of the vertices within this many edges."""
        near = np.zeros(len(self.positions), dtype=bool)
        near[seed] = True
        for _ in range(hops):
            near = near | (self.links @ near)
        return near

    def borders(self, chosen, within=None):
        """The edges between chosen and other triangles, sorted into contours as in the add-on."""
        within = np.ones(len(chosen), dtype=bool) if within is None else within
        inside, outside = (edges_of(self.triangles[within & part]) for part in (chosen, ~chosen))
        both = np.concatenate([np.unique(part, axis=0) for part in (inside, outside)])
        edges, counts = np.unique(both, axis=0, return_counts=True)
        return self.bounded(sort_edges(edges[counts == 2]))

    def bounded(self, pieces):
        """Loops and chains of limited length; where edges branch, a path."""
        found = [(loop, True) for loop in pieces.loops if len(loop) <= LONGEST]
        found += [(loop[:LONGEST], False) for loop in pieces.loops if len(loop) > LONGEST]
        found += [(chain[:LONGEST], False) for chain in pieces.chains]
        found += [(simple_path(edges), False) for edges in pieces.branching]
        return [(np.array(vertices, dtype=np.int32), closed) for vertices, closed in found if len(vertices) > 1]

    def face_set(self):
        """The ragged border of the faces painted around a point."""
        near = self.ball(self.seed(), int(self.rng.integers(1, 9)))
        painted = near[self.triangles].all(axis=1)
        return self.borders(painted & (self.rng.random(len(painted)) > self.rng.choice([0.0, 0.02])))

    def plane_cut(self):
        """The zigzag between the faces on both sides of a plane."""
        seed, normal = self.seed(), self.rng.standard_normal(3)
        within = self.ball(seed, REACH)[self.triangles].all(axis=1)
        return self.borders((self.centers - self.positions[seed]) @ normal > 0, within)

    @cached_property
    def centers(self):
        return self.positions[self.triangles].mean(axis=1)

    def parallel_cuts(self):
        """Several cuts at once, side by side."""
        seed, normal = self.seed(), self.rng.standard_normal(3)
        within = self.ball(seed, REACH)[self.triangles].all(axis=1)
        height = (self.centers - self.positions[seed]) @ normal
        spread = np.std(height[within]) if within.any() else 0.0
        cuts = [self.borders(height > offset * spread, within) for offset in (-0.7, -0.1, 0.5)]
        return [contour for cut in cuts for contour in cut[:2]]

    def chain(self):
        """A shortest path."""
        order, before = breadth_first_order(self.links, self.seed(), directed=False)
        end = int(order[self.rng.integers(min(len(order), 2000))])
        path = [end]
        while before[path[-1]] >= 0:
            path.append(int(before[path[-1]]))
        return [(np.array(path[:LONGEST], dtype=np.int32), False)] if len(path) > 1 else []

    def hole(self):
        """The border of the mesh, if it has one."""
        edges, counts = np.unique(edges_of(self.triangles), axis=0, return_counts=True)
        pieces = self.bounded(sort_edges(edges[counts == 1]))
        return [pieces[self.rng.integers(len(pieces))]] if pieces else []


def edges_of(triangles):
    return np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)


def simple_path(edges):
    """Follows edges from the first one, as long as they lead to new vertices."""
    neighbors = {}
    for a, b in edges.tolist():
        neighbors.setdefault(a, []).append(b)
        neighbors.setdefault(b, []).append(a)
    path = [int(edges[0, 0])]
    seen = set(path)
    while len(path) < LONGEST:
        following = next((v for v in neighbors[path[-1]] if v not in seen), None)
        if following is None:
            break
        path.append(following)
        seen.add(following)
    return path
