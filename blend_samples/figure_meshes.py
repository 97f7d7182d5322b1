# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons on grids, bodies of revolution, and rough curves on them. Uses only NumPy, for Blender and the tests."""

import numpy as np


def grid_faces(rows, columns, closed_rows=False, closed_columns=True):
    """Return the quads of a grid whose vertex (row, column) has the index row * columns + column.

    Seen from outside, the columns run to the right and the rows up.
    """
    faces = []
    for row in range(rows if closed_rows else rows - 1):
        for column in range(columns if closed_columns else columns - 1):
            right, up = (column + 1) % columns, (row + 1) % rows
            faces.append((row * columns + column, row * columns + right, up * columns + right, up * columns + column))
    return faces


def split_quads(faces, rng, fraction=1.0):
    """Split a fraction of the quads into two triangles along a random diagonal."""
    result = []
    for a, b, c, d in faces:
        if rng.random() >= fraction:
            result.append((a, b, c, d))
        elif rng.random() < 0.5:
            result += [(a, b, c), (a, c, d)]
        else:
            result += [(a, b, d), (b, c, d)]
    return result


def pole(row, columns, number, below=False):
    """Return triangles that close a tube's row of vertices with the vertex `number`, above it or below."""
    ring = row * columns + np.arange(columns)
    return [(b, a, number) if below else (a, b, number) for a, b in zip(ring.tolist(), np.roll(ring, -1).tolist())]


def lathe(profile, columns, top, rng, noise):
    """Turn a profile of (radius, height) around the z axis, and close it with a vertex on the axis at height `top`."""
    angle = 2 * np.pi * np.arange(columns) / columns
    rings = [np.stack([r * np.cos(angle), r * np.sin(angle), np.full(columns, z)], axis=-1) for r, z in profile]
    positions = np.concatenate([*rings, np.array([[0.0, 0.0, top]])])
    positions = positions + noise * rng.standard_normal(positions.shape)
    faces = split_quads(grid_faces(len(profile), columns), rng)
    return positions, faces + pole(len(profile) - 1, columns, len(profile) * columns)


def finger(rng, columns=32, edge=0.2, length=4.0, base=1.0, tip=0.6, joint=0.0):
    """Make a finger on a palm by turning a profile. Return positions, faces and the vertices of the base ring.

    The profile is a flat palm, the concave base ring, a shaft that narrows all the way to the tip, and a round tip. The
    base is its only concave corner, except for a joint halfway up whose depth may be given. Triangulated at random.
    """
    palm = [(r, 0.0) for r in np.arange(base + 8 * edge, base + 0.5 * edge, -edge)]
    shaft_rows = round(length / edge)
    shaft = [
        (base + (tip - base) * t - joint * np.exp(-(((t - 0.5) * length / edge) ** 2)), length * t)
        for t in np.linspace(0, 1, shaft_rows + 1)
    ]
    tip_rows = round(tip * np.pi / 2 / edge)
    cap = [(tip * np.cos(a), length + tip * np.sin(a)) for a in np.linspace(0, np.pi / 2, tip_rows + 1)[1:-1]]
    positions, faces = lathe(palm + shaft + cap, columns, length + tip, rng, 0.03 * edge)
    return positions, faces, len(palm) * columns + np.arange(columns)


def grid_path(rows, columns, first=0, closed=True):
    """Return the path along a grid's edges through one row per column from `first` on; it climbs between columns."""
    following = np.append(rows[1:], rows[0] if closed else rows[-1])
    path = []
    for i, (row, goal) in enumerate(zip(rows, following)):
        here = (first + i) % columns
        path += [r * columns + here for r in range(row, goal, 1 if goal > row else -1)] + [goal * columns + here]
    return np.array(path, dtype=np.int32)


def plane_loops(positions, faces, normal, offset):
    """Return the jagged loops between the polygons with their center above a plane, on the left, and the others.

    Loops that touch themselves or each other are left out, and so are those on the mesh border.
    """
    centers = np.array([positions[list(face)].mean(axis=0) for face in faces])
    return border_loops(faces, centers @ np.asarray(normal, dtype=float) > offset)


def border_loops(faces, chosen):
    """Return the loops around the chosen polygons, which lie on their left; none that touch or lie on the border."""
    owner = {edge: i for i, face in enumerate(faces) for edge in zip(face, face[1:] + face[:1])}
    following, branched = {}, set()
    for (a, b), face in owner.items():
        twin = owner.get((b, a))
        if chosen[face] and twin is not None and not chosen[twin]:
            branched |= {a} & set(following)
            following[a] = b
    loops, seen = [], set()
    for start in sorted(following):
        loop, v = [], start
        while v not in seen and v in following:
            seen.add(v)
            loop.append(v)
            v = following[v]
        if len(loop) >= 3 and v == start and not branched & set(loop):
            loops.append(np.array(loop, dtype=np.int32))
    return loops
