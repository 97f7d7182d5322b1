# SPDX-License-Identifier: GPL-3.0-or-later
"""Joins the dashes of a loop that is selected with gaps. Does not need Blender.

Ends of two chains may be joined where the gap is short beside them and the way across it does not turn back. Of these,
ends that are nearest to one another are joined along the shortest path, which no other contour touches.
"""

from dataclasses import dataclass

import numpy as np

from .edge_graphs import EdgeGraph

_GAP = 2.2  # the longest gap, in lengths of the longer of the two dashes beside it
_AHEAD = -0.3  # the least cosine between the direction of a dash and the gap at its end,
_ONWARD = -0.6  # and between the directions of two dashes; staircases turn by right angles, three dashes by 120 degrees
_ASKEW = 0.5  # how much farther an end is counted that lies abreast
_DETOUR = 2.0  # the longest path across a gap, in lengths of the gap
_MOST = 1000  # dashes; more are no drawing


@dataclass(frozen=True)
class Joined:
    """A chain or loop that is made of dashes."""

    vertices: np.ndarray
    closed: bool
    dashes: list  # of how they lie along it, by their numbers


def join(chains, others, read_faces, chains_too=False):
    """Return what dashes among the chains make together, and the numbers of the chains that are none.

    chains: lists of vertices; others: vertices of contours that no joint touches; read_faces() returns the mesh's
    Faces. chains_too: whether dashes are also joined that do not make a loop.
    """
    alone = list(range(len(chains)))
    if not 2 <= len(chains) <= _MOST:
        return [], alone
    faces = read_faces()
    joints = _joints(chains, faces.points)
    graph, joined = None, []
    taken = set(others).union(*(chain.tolist() for chain in chains))
    for ends in _rounds(len(chains), joints):
        closed = ends[0] // 2 == ends[-1] // 2
        if not closed and not chains_too:
            continue
        graph = graph or _graph(faces, chains, joints)
        vertices = _connected(chains, ends, closed, faces.points, graph, taken)
        if vertices is not None:
            taken.update(vertices)
            numbers = list(dict.fromkeys(end // 2 for end in ends))
            joined.append(Joined(np.array(vertices, dtype=np.int32), closed, numbers))
            alone = [number for number in alone if number not in numbers]
    return joined, alone


def _joints(chains, points):
    """Return for each end the end that it is joined to; end 2 i is the first of chain i, 2 i + 1 the last; -1: none."""
    lines = [points[vertices] for chain in chains for vertices in (chain, chain[::-1])]  # each from its end on
    ends = np.array([line[0] for line in lines])
    lengths = np.array([np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines])
    gaps = np.linalg.norm(ends[:, None] - ends[None], axis=2)
    own = np.arange(len(ends)) // 2
    possible = (gaps <= _GAP * np.maximum(lengths[:, None], lengths[None])) & (own[:, None] != own[None]) & (gaps > 0)
    costs = np.full(gaps.shape, np.inf)
    for i, j in np.argwhere(np.triu(possible)).tolist():
        across = (ends[j] - ends[i]) / gaps[i, j]
        one, other = (_direction(lines[end], gaps[i, j]) for end in (i, j))
        ahead, onward = min(one @ across, -(other @ across)), -(one @ other)
        possible[i, j] = possible[j, i] = ahead >= _AHEAD and onward >= _ONWARD
        costs[i, j] = costs[j, i] = gaps[i, j] * (1 + _ASKEW * (1 - ahead))
    nearest = np.argmin(np.where(possible, costs, np.inf), axis=1)
    mutual = (nearest[nearest] == np.arange(len(ends))) & possible.any(axis=1)
    return np.where(mutual, nearest, -1)


def _direction(line, reach):
    """Return the direction in which a line arrives at its first point, over this length of it."""
    lengths = np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))
    other = line[min(np.searchsorted(lengths, reach) + 1, len(line) - 1)]
    size = np.linalg.norm(line[0] - other)
    return (line[0] - other) / size if size > 0 else np.zeros(3)


def _rounds(count, joints):
    """Return the ends along each row of joined chains, in pairs; a closed one begins and ends with the same chain."""
    joints, seen, rows = joints.tolist(), set(), []
    openings = [end for end in range(2 * count) if joints[end] < 0 <= joints[end ^ 1]]
    for start in openings + list(range(0, 2 * count, 2)):
        if start // 2 in seen or joints[start ^ 1] < 0:
            continue
        row, end = [start], start ^ 1
        while True:
            seen.add(end // 2)
            row.append(end)
            following = joints[end]
            if following < 0:
                break
            row.append(following)
            if following // 2 in seen:
                break
            end = following ^ 1
        rows.append(row)
    return rows


def _graph(faces, chains, joints):
    """Return the edges between visible faces around the gaps."""
    ends = np.array([chain[side] for chain in chains for side in (0, -1)])
    here, there = (faces.points[some] for some in (ends[joints >= 0], ends[joints[joints >= 0]]))
    margin = _DETOUR * np.linalg.norm(here - there, axis=1).max()
    inside = ((faces.points >= here.min(axis=0) - margin) & (faces.points <= here.max(axis=0) + margin)).all(axis=1)
    some = np.flatnonzero((faces.edge_faces >= 0).all(axis=1) & inside[faces.edges].all(axis=1))
    return EdgeGraph(faces.edges[some].tolist(), faces.lengths(some).tolist())


def _connected(chains, ends, closed, points, graph, taken):
    """Return the vertices along a row of chains with paths across the gaps; None where one is missing."""
    taken, vertices = set(taken), []
    for i in range(0, len(ends) - 1, 2):
        chain = chains[ends[i] // 2].tolist()
        vertices += chain if ends[i] % 2 == 0 else chain[::-1]
        if i + 2 == len(ends):
            break
        start, goal = vertices[-1], chains[ends[i + 2] // 2][-(ends[i + 2] % 2)]
        gap = float(np.linalg.norm(points[start] - points[goal]))
        path = graph.path(start, int(goal), taken, _DETOUR * gap)
        if path is None:
            return None
        vertices += path[0][1:-1]
        taken.update(path[0])
    return _canonical(vertices, closed)


def _canonical(vertices, closed):
    """Return a loop from its lowest vertex on towards the lower neighbor, a chain from its lower end on."""
    if not closed:
        return vertices if vertices[0] < vertices[-1] else vertices[::-1]
    lowest = vertices.index(min(vertices))
    vertices = vertices[lowest:] + vertices[:lowest]
    return vertices if vertices[1] < vertices[-1] else vertices[:1] + vertices[:0:-1]
