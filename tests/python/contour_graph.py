# SPDX-License-Identifier: GPL-3.0-or-later
"""The search graph of chapter 3, regular or refined, closed or open, built in a simple way, and its optimum: by a
solver that makes one pass for each lambda (4.2.5) and keeps every source separate, or one for each number of arcs
(appendix A).

The only input from the module is the increments of the flow on the band. Required elements delete nothing here: each
path records which of them it has visited.
"""

from collections import defaultdict
from itertools import pairwise
from math import floor, inf

import numpy as np
from brute_force import Levels, edges_of, reaching, signed_ranks
from contour_energy import UNITS, edge_of, point_on, vertex

LEVEL = 1e-12  # chords with smaller increments are level once the vertices are classified


def lower_left(sums):
    """The rows (F, G) that no other row dominates: none is lower in one column and not higher in the other."""
    sums = sums[np.lexsort((sums[:, 0], sums[:, 1]))]
    best = np.minimum.accumulate(sums[:, 0])
    return sums[np.concatenate([[True], sums[1:, 0] < best[:-1]])]


class AllLevels(Levels):
    """Flow levels whose increments are defined on diagonals, too."""

    def __init__(self, geometry, space):
        super().__init__(geometry, space)
        links = defaultdict(dict)
        for (a, b), increment in zip(space["edges"].tolist(), space["increments"].tolist(), strict=True):
            links[a][b], links[b][a] = increment, -increment
        raw = self._values(links)
        shift = {v: self.nearest(self.value[v] - raw[v]) for v in raw}
        self.form = {(a, b): d + shift[b] - shift[a] for a in links for b, d in links[a].items()}
        self.form = {(a, b): 0.0 if self.name[a] == self.name[b] else d for (a, b), d in self.form.items()}

    def at(self, p):
        """The value at a point, in the same period as that of the first end of its edge."""
        return self.value[p[0]] + (p[2] / UNITS * self.form[p[:2]] if p[2] else 0.0)


class ContourGraph:
    """Nodes (p, q, kind): chords along which the flow rises (kind 0), or only the rank rises (1) or falls (-1)."""

    def __init__(self, energy, space, ends=None):
        self.energy, self.k = energy, energy.options["refinement"]
        geometry = energy.geometry
        self.levels = AllLevels(geometry, space)
        self.triangles = [tuple(t) for t in space["triangles"].tolist()]
        self.rank = self._ranks(space)
        self.nodes, self.inside = [], {}
        self._chords()
        self._arcs()
        self._borders(ends)

    def _ranks(self, space):
        """Signed distances from the given contour. For open and refined contours, the sides come from the module."""
        if self.energy.closed and self.energy.along_edges:
            corners = [p[0] for p in self.energy.given if p[0] == p[1]]
            return signed_ranks(self.energy.geometry, corners, space["faces"])
        sides = dict(zip(space["vertices"].tolist(), space["side"].tolist(), strict=True))
        return {v: side * self.energy.from_given[v] for v, side in sides.items()}

    def _chords(self):
        increments = {}
        for i, triangle in enumerate(self.triangles):
            sides = [self._side(*edge) for edge in edges_of(triangle)]
            for side in sides:
                for p, q in pairwise(side):
                    self._candidate(increments, triangle, p, q, None)
                others = [p for other in sides if other is not side for p in other]
                for p in side[1:-1]:
                    for q in others:
                        if q not in side:
                            self._candidate(increments, triangle, p, q, i)
        self._lone_edges(increments)
        for (p, q), (increment, triangle) in increments.items():
            kind = self._kind(p, q, increment)
            if kind is not None:
                self.nodes.append((p, q, kind))
                self.inside[p, q] = triangle
        self.increment = {chord: value for chord, (value, _) in increments.items()}

    def _side(self, a, b):
        return [vertex(a), *[point_on(a, b, i / (self.k + 1)) for i in range(1, self.k + 1)], vertex(b)]

    def _candidate(self, increments, triangle, p, q, inside):
        value = {triangle[0]: 0.0, **{v: self.levels.form[triangle[0], v] for v in triangle[1:]}}
        climb = self._value(q, value) - self._value(p, value)
        increments[p, q], increments[q, p] = (climb, inside), (-climb, inside)

    @staticmethod
    def _value(p, value):
        return value[p[0]] + p[2] / UNITS * (value[p[1]] - value[p[0]])

    def _lone_edges(self, increments):
        """Edges of the given contour that belong to no triangle of the band."""
        for a, b in self.levels.real:
            for p, q in pairwise(self._side(a, b)):
                climb = self.levels.form[a, b] / (self.k + 1)
                increments.setdefault((p, q), (climb, None))

    def _kind(self, p, q, increment):
        edge = edge_of(p, q)
        geometry = self.energy.geometry
        if edge is not None:
            real = edge in self.levels.real
            if self.k == 0 and not real:
                return None
            if real and ((edge not in geometry.left_face) or (edge[::-1] not in geometry.left_face)):
                return None  # on the mesh border, where no contour runs
        if abs(increment) < LEVEL:
            return self._rank_kind(p, q)
        return 0 if increment > 0 else None

    def _rank_kind(self, p, q):
        climb = self.energy.linear(q, self.rank.__getitem__) - self.energy.linear(p, self.rank.__getitem__)
        if abs(climb) <= 1e-12 * self.energy.L0:
            return None
        return 1 if climb > 0 else -1

    def _arcs(self):
        given = self.energy.given
        ring = [*given, *given[:2]] if self.energy.closed else given
        kept = set(zip(ring, ring[1:], ring[2:], strict=False))
        leaving = defaultdict(list)
        for i, (p, _, _) in enumerate(self.nodes):
            leaving[p].append(i)
        self.arcs = [[] for _ in self.nodes]
        for i, (p, q, kind) in enumerate(self.nodes):
            for j in leaving[q]:
                _, r, following = self.nodes[j]
                if r == p or kind * following == -1:
                    continue
                triangle = self.inside[p, q]
                if triangle is not None and triangle == self.inside[q, r]:
                    continue  # rule 1 of section 3.2
                if (p, q, r) in kept or self.energy.admissible(p, q, r):
                    self.arcs[i].append((j, *self.energy.arc(p, q, r)))

    def _borders(self, ends):
        """Where paths begin and end. Closed: the chords that cross one level through no point of the graph."""
        if not self.energy.closed:
            first, last = ends
            self.first = {i: self.energy.at_point(p, [(p, q)]) for i, (p, q, _) in enumerate(self.nodes) if first(p, q)}
            self.last = {i: self.energy.at_point(q, [(p, q)]) for i, (p, q, _) in enumerate(self.nodes) if last(p, q)}
            return
        values = sorted({x - floor(x) for x in (self.levels.at(p) for node in self.nodes for p in node[:2])})
        gap, value = max((b - a, a) for a, b in pairwise([*values, values[0] + 1]))
        level = value + gap / 2
        self.sources = []
        for i, (p, q, kind) in enumerate(self.nodes):
            tail = self.levels.at(p) - level
            if kind == 0 and floor(tail + self.increment[p, q]) > floor(tail):
                self.sources.append(i)

    # ---- the solvers

    def order(self):
        """A topological order; arcs into sources end a period and do not count."""
        ending = set(self.sources) if self.energy.closed else set()
        waiting = [0] * len(self.nodes)
        for arcs in self.arcs:
            for j, _, _ in arcs:
                waiting[j] += j not in ending
        ready, order = [i for i, n in enumerate(waiting) if n == 0], []
        while ready:
            i = ready.pop()
            order.append(i)
            for j, _, _ in self.arcs[i]:
                if j not in ending:
                    waiting[j] -= 1
                    if waiting[j] == 0:
                        ready.append(j)
        assert len(order) == len(self.nodes), "the graph has a cycle within a period"
        return order

    def best(self, required_vertices=(), required_edges=()):
        """The least objective with the plain ratio, or inf."""
        self._visits(required_vertices, required_edges)
        order, least, ratio = self.order(), inf, 0.0
        while True:
            found = self._pass(order, ratio)
            if found is None or found[0] / found[1] >= least - 1e-13 * self.energy.K:
                return least
            least = ratio = found[0] / found[1]

    def _visits(self, vertices, edges):
        """The required elements that each node visits, as bits; a refined edge is k + 1 chords."""
        elements = [{vertex(v)} for v in vertices]
        elements += [set(chord) for a, b in edges for chord in pairwise(self._side(a, b))]
        self.all_bits = (1 << len(elements)) - 1
        self.bits = [sum(1 << n for n, e in enumerate(elements) if e <= {p, q}) for p, q, _ in self.nodes]

    def _pass(self, order, ratio):
        """(F, G) of the path with the least F - ratio G that visits all required elements: one column for each
        source."""
        starts = self.sources if self.energy.closed else [None]
        shape = (len(self.nodes), self.all_bits + 1, len(starts))
        cost, F, G = np.full(shape, inf), np.zeros(shape), np.zeros(shape)
        found = []
        if self.energy.closed:
            for column, s in enumerate(starts):
                cost[s, self.bits[s], column] = 0.0
        else:
            for s, (f, g) in self.first.items():
                cost[s, self.bits[s], 0], F[s, self.bits[s], 0], G[s, self.bits[s], 0] = f - ratio * g, f, g
        column_of = {s: n for n, s in enumerate(starts)}
        for i in order:
            if not np.isfinite(cost[i]).any():
                continue
            ends = [(j, column_of[j], f, g) for j, f, g in self.arcs[i] if j in column_of]
            if not self.energy.closed and i in self.last:
                ends.append((i, 0, *self.last[i]))
            for j, column, f, g in ends:
                for mask in range(self.all_bits + 1):
                    if mask | self.bits[j] == self.all_bits and cost[i, mask, column] < inf:
                        total = F[i, mask, column] + f, G[i, mask, column] + g
                        found.append((cost[i, mask, column] + f - ratio * g, *total))
            for j, f, g in self.arcs[i]:
                if j not in column_of:
                    self._relax((cost, F, G), i, j, (f - ratio * g, f, g))
        return min(found)[1:] if found else None

    def _relax(self, tables, i, j, weights):
        bits = self.bits[j]
        into = [(slice(None), slice(None))] if bits == 0 else [(m, m | bits) for m in range(self.all_bits + 1)]
        for mask, to in into:
            better = tables[0][i, mask] + weights[0] < tables[0][j, to]
            if better.any():
                for table, weight in zip(tables, weights, strict=True):
                    table[j, to][better] = table[i, mask][better] + weight

    def best_by_count(self, objective):
        """Appendix A: the least F for every number of arcs, one column for each source. Returns the least
        objective(F, count), where every arc has g = 1 (as have both ends of an open curve together)."""
        starts = self.sources if self.energy.closed else [None]
        order = self.order()
        longest = self._longest(order) + 2
        least = np.full((len(self.nodes), longest, len(starts)), inf)
        column_of = {s: n for n, s in enumerate(starts)}
        if self.energy.closed:
            for s, column in column_of.items():
                least[s, 0, column] = 0.0
        else:
            for s, (f, _) in self.first.items():
                least[s, 0, 0] = f
        best = inf
        for i in order:
            if not self.energy.closed and i in self.last:
                counted = least[i, :, 0] + self.last[i][0]
                best = min([best, *(objective(f, n + 1) for n, f in enumerate(counted) if f < inf)])
            for j, f, _ in self.arcs[i]:
                if j in column_of:
                    counted = least[i, :, column_of[j]] + f
                    best = min([best, *(objective(F, n + 1) for n, F in enumerate(counted) if inf > F)])
                else:
                    np.minimum(least[j, 1:], least[i, :-1] + f, out=least[j, 1:])
        return best

    def best_with_bias(self, limit):
        """The least objective below `limit` with length bias by arc length, or `limit`. The paths below a limit c have
        F <= K G (c - beta max(G / L0, floor)). With F' = F - K G (c - beta floor) that is
        F' <= K G beta (floor - max(G / L0, floor)), which only falls with G: a path to a node is not needed if another
        path to it is better in both F' and G. Every better path found lowers the limit."""
        energy, order, least, found = self.energy, self.order(), inf, limit
        while found < least:
            least = found
            slope = energy.K * (least - energy.options["length_bias"] * energy.options["length_floor"])
            sums = self._pareto(order, slope)
            found = min([least, *(energy.objective(f + slope * g, g) for f, g in sums)])
        return least

    def _pareto(self, order, slope):
        """(F', G) of the paths that no other path dominates, separately for each source."""
        closed, found = self.energy.closed, []
        last, ending = ({}, set(self.sources)) if closed else (self.last, set())
        for start in [{s: (0.0, 0.0)} for s in self.sources] if closed else [self.first]:
            labels = {i: [np.array([[f - slope * g, g]])] for i, (f, g) in start.items()}
            for i in order:
                if i not in labels:
                    continue
                here = lower_left(np.concatenate(labels.pop(i)))
                if i in last:
                    f, g = last[i]
                    found.append(here + [f - slope * g, g])
                for j, f, g in self.arcs[i]:
                    if j not in ending:
                        labels.setdefault(j, []).append(here + [f - slope * g, g])
                    elif j in start:
                        found.append(here + [f - slope * g, g])
        return np.concatenate(found).tolist() if found else []

    def _longest(self, order):
        steps = [0] * len(self.nodes)
        for i in order:
            for j, _, _ in self.arcs[i]:
                steps[j] = max(steps[j], steps[i] + 1)
        return max(steps)

    def paths(self):
        """Every contour, by depth-first search: (points, F, G)."""
        if self.energy.closed:
            sources = set(self.sources)
            for source in self.sources:
                stack = [(source, (self.nodes[source][0],), 0.0, 0.0)]
                useful = reaching(enumerate(self.arcs), {source}, sources)
                while stack:
                    i, path, F, G = stack.pop()
                    for j, f, g in self.arcs[i]:
                        if j == source:
                            yield path, F + f, G + g
                        elif j in useful:
                            stack.append((j, (*path, self.nodes[j][0]), F + f, G + g))
            return
        useful = reaching(enumerate(self.arcs), set(self.last), set())
        stack = [(i, self.nodes[i][:2], f, g) for i, (f, g) in self.first.items()]
        while stack:
            i, path, F, G = stack.pop()
            if i in self.last:
                f, g = self.last[i]
                yield path, F + f, G + g
            stack += [
                (j, (*path, self.nodes[j][1]), F + f, G + g)
                for j, f, g in self.arcs[i]
                if j in useful or j in self.last
            ]

    def count(self):
        """The number of contours, by dynamic programming."""
        order, total = self.order(), 0
        for start in self.sources if self.energy.closed else [None]:
            path_counts = [0] * len(self.nodes)
            for s in [start] if self.energy.closed else self.first:
                path_counts[s] = 1
            for i in order:
                if not self.energy.closed and i in self.last:
                    total += path_counts[i]
                for j, _, _ in self.arcs[i] if path_counts[i] else ():
                    if self.energy.closed and j == start:
                        total += path_counts[i]
                    elif not self.energy.closed or j not in self.sources:
                        path_counts[j] += path_counts[i]
        return total
