# SPDX-License-Identifier: GPL-3.0-or-later
"""Shortest paths and loops along some edges of a mesh. Does not need Blender. Equal paths: the lower vertices win."""

import heapq
from collections import defaultdict


class EdgeGraph:
    """Edges between vertices, each with its length, and whether it crosses a cut."""

    def __init__(self, pairs, lengths, crossing=()):
        self.around = defaultdict(list)
        crossing = set(crossing)
        for i, ((a, b), length) in enumerate(zip(pairs, lengths)):
            self.around[a].append((b, length, i in crossing))
            self.around[b].append((a, length, i in crossing))

    def distances(self, starts, blocked=(), goal=None, limit=float("inf")):
        """Return for each place, (vertex, side), within the limit its distance from the starts and the place before.

        A path changes its side, 0 or 1, at each edge that crosses the cut. It stops at blocked vertices and the goal.
        """
        found: dict = {}
        queue: list = [(0.0, (start, 0), None) for start in sorted(starts)]
        while queue:
            distance, place, before = heapq.heappop(queue)
            if place in found:
                continue
            found[place] = distance, before
            if place == goal:
                break
            vertex, side = place
            if vertex in blocked and before is not None:
                continue
            for other, length, crosses in self.around[vertex]:
                following = other, side ^ crosses
                if following not in found and distance + length <= limit:
                    heapq.heappush(queue, (distance + length, following, place))
        return found

    def path(self, start, end, blocked=(), limit=float("inf")):
        """Return the vertices of the shortest path on one side, and its length; None if there is none."""
        found = self.distances([start], blocked, (end, 0), limit)
        return (_back(found, (end, 0)), found[end, 0][0]) if (end, 0) in found else None

    def farthest(self, start):
        """Return the vertex farthest from another, the lowest of several."""
        found = self.distances([start])
        return min(found, key=lambda place: (-found[place][0], place))[0]


def _back(found, place):
    path = []
    while place is not None:
        path.append(place[0])
        place = found[place][1]
    return path[::-1]
