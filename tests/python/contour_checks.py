# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a contour across faces is simple, in exact arithmetic."""

from collections import Counter
from itertools import combinations, pairwise

from contour_energy import UNITS


def chords_by_triangle(mesh, points, closed):
    """The chords in each triangle, by its sorted corners; those in no triangle are under None."""
    by_corner = {}
    for triangle in mesh.triangles.tolist():
        for corner in triangle:
            by_corner.setdefault(corner, set()).add(tuple(sorted(triangle)))
    within = {}
    for chord in pairwise([*points, points[0]] if closed else points):
        corners = {v for p in chord for v in p[:2]}
        holding = [triangle for triangle in by_corner.get(chord[0][0], ()) if corners <= set(triangle)]
        for triangle in holding or [None]:
            within.setdefault(triangle, []).append(chord)
    return within


def crossings(mesh, points, closed):
    """Pairs of chords that meet anywhere but at a common end, and points that are visited twice."""
    found = [point for point, count in Counter(points).items() if count > 1]
    for triangle, chords in chords_by_triangle(mesh, points, closed).items():
        for one, two in combinations(chords, 2):
            if triangle and chords_meet(one, two, triangle):
                found.append((one, two))
    return found


def on_surface(mesh, points, closed):
    """Whether every chord lies in a triangle."""
    return None not in chords_by_triangle(mesh, points, closed)


def chords_meet(one, two, triangle):
    return segments_meet(*(flat(p, triangle) for p in (*one, *two)), shared=bool(set(one) & set(two)))


def flat(point, triangle):
    """Integer coordinates in the plane of a triangle."""
    weights = dict.fromkeys(triangle, 0)
    weights[point[0]] += UNITS - point[2]
    weights[point[1]] += point[2]
    return weights[triangle[1]], weights[triangle[2]]


def turn(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def between(a, b, c):
    """Whether c, on the line ab, lies strictly between a and b."""
    along = (c[0] - a[0]) * (b[0] - a[0]) + (c[1] - a[1]) * (b[1] - a[1])
    return 0 < along < (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2


def segments_meet(a, b, c, d, shared):
    turns = turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)
    if turns[0] * turns[1] < 0 and turns[2] * turns[3] < 0:
        return not shared
    lines = (a, b, c), (a, b, d), (c, d, a), (c, d, b)
    return any(side == 0 and between(*line) for side, line in zip(turns, lines, strict=True))


def meetings(mesh, one, two, closed=(True, True)):
    """Points that two contours weights, and pairs of their chords that cross or touch elsewhere."""
    found = sorted(set(one) & set(two))
    first, second = (chords_by_triangle(mesh, *pair) for pair in zip((one, two), closed, strict=True))
    for triangle in (first.keys() & second.keys()) - {None}:
        found += [(p, q) for p in first[triangle] for q in second[triangle] if chords_meet(p, q, triangle)]
    return found
