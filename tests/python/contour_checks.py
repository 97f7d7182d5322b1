# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a contour across faces is simple, in exact arithmetic."""

from itertools import combinations, pairwise

from contour_energy import UNITS


def crossings(mesh, points, closed):
    """Pairs of chords that meet elsewhere than at a common end, and points that are visited twice."""
    found = [p for p in set(points) if points.count(p) > 1]
    chords = list(pairwise([*points, points[0]] if closed else points))
    triangles = [tuple(t) for t in mesh.triangles.tolist()]
    for triangle in triangles:
        corners = set(triangle)
        within = [chord for chord in chords if {v for p in chord for v in p[:2]} <= corners]
        for one, two in combinations(within, 2):
            if segments_meet(*(flat(p, triangle) for p in (*one, *two)), shared=bool(set(one) & set(two))):
                found.append((one, two))
    return found


def on_surface(mesh, points, closed):
    """Whether every chord lies in a triangle."""
    triangles = [set(t) for t in mesh.triangles.tolist()]
    chords = pairwise([*points, points[0]] if closed else points)
    return all(any({v for p in chord for v in p[:2]} <= triangle for triangle in triangles) for chord in chords)


def flat(point, triangle):
    """Whole coordinates in a triangle's own plane."""
    share = dict.fromkeys(triangle, 0)
    share[point[0]] += UNITS - point[2]
    share[point[1]] += point[2]
    return share[triangle[1]], share[triangle[2]]


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
    """Points that two contours share, and pairs of their chords that cross or touch elsewhere."""
    found = sorted(set(one) & set(two))
    triangles = [tuple(t) for t in mesh.triangles.tolist()]
    by_corner = {}
    for triangle in triangles:
        for corner in triangle:
            by_corner.setdefault(corner, []).append(triangle)

    def chords_by_triangle(points, is_closed):
        within = {}
        for chord in pairwise([*points, points[0]] if is_closed else points):
            corners = {v for p in chord for v in p[:2]}
            for triangle in by_corner[chord[0][0]]:
                if corners <= set(triangle):
                    within.setdefault(triangle, []).append(chord)
        return within

    first, second = (chords_by_triangle(*pair) for pair in zip((one, two), closed, strict=True))
    for triangle in first.keys() & second.keys():
        for p in first[triangle]:
            for q in second[triangle]:
                if segments_meet(*(flat(end, triangle) for end in (*p, *q)), shared=bool(set(p) & set(q))):
                    found.append((p, q))
    return found
