# SPDX-License-Identifier: GPL-3.0-or-later
"""The points of contours across faces, and how points close to a vertex are merged with it. Does not need Blender."""

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

MIN_SEPARATION = (
    1e-5  # fraction of an edge; Blender's 32-bit positions hardly distinguish a closer point from the vertex
)


@dataclass(frozen=True)
class ContourPoint:
    """One point of a contour: the point at (1 - t) a + t b of edge ab with a < b, a vertex being (v, v, 0)."""

    a: int
    b: int
    t: float
    face: int  # contains the segment to the next point; for the end of an open contour, the segment before it

    @property
    def place(self):
        return self.a, self.b, self.t

    @property
    def is_vertex(self):
        return self.a == self.b

    def nearest_vertex(self):
        return self.a if self.t <= 0.5 else self.b

    def at_vertex(self, vertex):
        return ContourPoint(vertex, vertex, 0.0, self.face)


def contour_points(contour):
    """Return the points of a native result, or of any object with edge_vertices, edge_parameters and segment_faces."""
    faces = np.asarray(contour.segment_faces).tolist()
    points = zip(np.asarray(contour.edge_vertices).tolist(), np.asarray(contour.edge_parameters).tolist())
    return [_point(a, b, t, faces[min(i, len(faces) - 1)]) for i, ((a, b), t) in enumerate(points)]


def without_points_along_edges(contour, closed):
    """Drop each point whose neighbors both lie on its edge: running along an edge cuts nothing."""
    before, after = contour[-1:] + contour[:-1], contour[1:] + contour[:1]
    ends = () if closed else (contour[0], contour[-1])
    return [
        point
        for previous, point, following in zip(before, contour, after)
        if point in ends or not (_on_edge_of(previous, point) and _on_edge_of(following, point))
    ]


def merge_points(contours, closed, fraction, unsplittable=frozenset(), protected=frozenset()):
    """Move each point that is closer to a vertex than this fraction of its edge onto that vertex.

    Every point on an `unsplittable` edge is moved. Points are moved only if they are consecutive along one contour,
    which then passes through the vertex. So no contour starts to touch itself, another contour or a `protected` vertex,
    and none degenerates to fewer than three points.
    """
    near = defaultdict(lambda: defaultdict(list))  # vertex -> contour -> places of its points there
    for c, contour in enumerate(contours):
        for i, point in enumerate(contour):
            if (point.a, point.b) in unsplittable:
                near[_adjacent_end(contour, i)][c].append(i)
            elif min(point.t, 1.0 - point.t) <= max(fraction, MIN_SEPARATION):
                near[point.nearest_vertex()][c].append(i)
    moved = [list(contour) for contour in contours]
    for vertex, visits in near.items():
        if _may_merge(vertex, visits, contours, closed, vertex in protected):
            for c, places in visits.items():
                for i in places:
                    moved[c][i] = contours[c][i].at_vertex(vertex)
    return [_simplified(after, before, is_closed) for after, before, is_closed in zip(moved, contours, closed)]


def _point(a, b, t, face):
    if t <= 0.0 or a == b:
        return ContourPoint(a, a, 0.0, face)
    if t >= 1.0:
        return ContourPoint(b, b, 0.0, face)
    return ContourPoint(a, b, t, face) if a < b else ContourPoint(b, a, 1.0 - t, face)


def _on_edge_of(point, other):
    return not other.is_vertex and {point.a, point.b} <= {other.a, other.b}


def _adjacent_end(contour, i):
    """Return the end of a point's edge that is the previous or next point of the contour, else the nearer end."""
    point = contour[i]
    neighbors = {other.a for other in (contour[i - 1], contour[(i + 1) % len(contour)]) if other.is_vertex}
    ends = neighbors & {point.a, point.b}
    return min(ends) if ends else point.nearest_vertex()


def _may_merge(vertex, visits, contours, closed, protected):
    """Whether the points form one run of one contour; or several contours, if they all pass through the vertex already.

    A protected vertex takes points only of contours that pass through it already.
    """
    if not all(_is_run(places, len(contours[c]), closed[c]) for c, places in visits.items()):
        return False
    at_vertex = [any(contours[c][i].place == (vertex, vertex, 0.0) for i in places) for c, places in visits.items()]
    return all(at_vertex) or (len(visits) == 1 and not protected)


def _is_run(places, count, closed):
    """Whether ascending places are consecutive, which in a closed contour includes wrapping around."""
    gaps = sum(following - place > 1 for place, following in zip(places, places[1:]))
    wraps = closed and places[0] == 0 and places[-1] == count - 1
    return gaps == 0 or (gaps == 1 and wraps)


def _simplified(moved, given, closed):
    """Return the contour without repeated points, or the given contour if too few points would be left."""
    reduced = _without_repeats(moved, closed)
    return reduced if len(reduced) >= 3 else _without_repeats(given, closed)


def _without_repeats(contour, closed):
    """Drop all but the last of consecutive equal points: the last one has the face of the segment that follows."""
    following = contour[1:] + contour[:1]
    distinct = [point for point, after in zip(contour, following) if point.place != after.place]
    return distinct if closed else distinct + contour[-1:] * (not distinct or distinct[-1] is not contour[-1])
