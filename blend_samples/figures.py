# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and rough contours that show the same as the thesis's figures (1.1, 3.3 and chapter 5).

The thesis shows scans. These are bodies of known shape instead, so that the correct contours are known. Uses only
NumPy: Blender draws the figures and the tests measure them.
"""

from dataclasses import dataclass, field

import numpy as np
from figure_meshes import border_loops, finger, grid_faces, grid_path, lathe, plane_loops, pole, split_quads

FRAGMENT, GAP = 9, 10  # of 3.3, in edges: the length of each of the two grooves, and of the gap between them
TORSO_GROOVES, TORSO_WAIST = (-0.15, 0.3, 0.75, 1.2), -1.05  # heights
EYES, EYE = 15.0, (10.0, 4.0)  # distance of the eyes from the middle; their half length and half height
FACE = (11.0, 14.0)  # half axes of the face's outline
NECK = (4.5, 2.2, 0.6)  # the crease below the chin: distance from the outline, depth, and extent as an angle


@dataclass(frozen=True)
class Search:
    """One call of `mrcontour.optimize`."""

    title: str
    given: np.ndarray  # vertices of the given contour
    options: dict
    constraints: dict = field(default_factory=dict)  # further keyword arguments of `optimize`
    closed: bool = True


@dataclass(frozen=True)
class Figure:
    name: str
    title: str
    positions: np.ndarray
    faces: tuple
    searches: tuple
    truths: tuple = ()  # curves known by construction, as vertices in order
    up: tuple = (0, 0, 1)


def ball(azimuth, elevation, radius):
    """Return a grid of points around a head that looks along -y, and its two poles (the upper one first)."""
    flat = radius * np.cos(elevation)
    points = np.stack([flat * np.sin(azimuth), -flat * np.cos(azimuth), radius * np.sin(elevation)], axis=-1)
    top, bottom = (np.mean(np.linalg.norm(row, axis=-1)) for row in (points[-1], points[0]))
    return np.concatenate([points.reshape(-1, 3), [[0, 0, top], [0, 0, -bottom]]])


def relief(rows, columns, height, dome, rng):
    """Make a curved sheet with edges of length 1 that looks along -y, with a relief of the given height(x, z).

    It is triangulated at random. `dome` has the quadratic coefficients of its curvature along x and z.
    """
    x, z = np.meshgrid(np.arange(columns) - (columns - 1) / 2, np.arange(rows) - (rows - 1) / 2)
    x, z = (axis + 0.12 * rng.standard_normal(axis.shape) for axis in (x, z))
    y = dome[0] * x**2 + dome[1] * z**2 - height(x, z)
    positions = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    return positions, tuple(split_quads(grid_faces(rows, columns, closed_columns=False), rng))


def trunk(rows, columns, edge, radius, rng, slant=0.0):
    """Make a closed body around the z axis with the given radius(angle, z) and round ends, triangulated at random.

    The rows of the mesh are tilted with the slope `slant`.
    """
    angle, z = np.meshgrid(2 * np.pi * np.arange(columns) / columns, edge * (np.arange(rows) - (rows - 1) / 2))
    ends = np.sqrt(1 - (z / (0.5 * edge * rows)) ** 10)
    angle = angle + 0.4 * np.pi / columns * rng.uniform(-1, 1, angle.shape)
    z = z + slant * np.cos(angle) + 0.2 * edge * rng.uniform(-1, 1, z.shape)
    r = radius(angle, z) * ends
    points = np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1).reshape(-1, 3)
    poles = [[0, 0, z[-1].mean() + 0.5 * edge], [0, 0, z[0].mean() - 0.5 * edge]]
    faces = split_quads(grid_faces(rows, columns), rng) + pole(rows - 1, columns, rows * columns)
    faces += pole(0, columns, rows * columns + 1, below=True)
    return np.concatenate([points, poles]), tuple(faces)


def valley(away, width):
    """Return the profile of a groove: 1 on its line and 0 far away from it."""
    return np.exp(-((away / width) ** 2))


def longest_loop(positions, faces, normal, offset):
    return max(plane_loops(positions, faces, normal, offset), key=len)


def finger_at_three_heights():
    """1.1: From every start on the finger, even in a crease (D), a band that contains the base (F) finds it.

    Contour A, near the tip, does not vanish even in a narrow band.
    """
    positions, faces, base = finger(np.random.default_rng(11), joint=0.05)
    starts = {"C": ([0.2, 0.1, 1], 2.9), "D": ([0, 0, 1], 2.0), "E": ([-0.15, 0.2, 1], 1.2), "A": ([0.1, -0.1, 1], 4.1)}
    given = {name: longest_loop(positions, faces, *plane) for name, plane in starts.items()}
    searches = [Search(f"contour {name}, width 24", loop, {"width": 24}) for name, loop in given.items()]
    searches.append(Search("contour A, width 2", given["A"], {"width": 2, "iterations": 10}))
    title = "From anywhere on a finger to its base"
    return Figure("1.1", title, positions, tuple(faces), tuple(searches), (base,))


def gap_between_fragments():
    """3.3: Two grooves, A and C, on a sheet bent across the diagonal, so that every path between them has a cost.

    B is the straight path, D and E are detours to its left and right. The mesh is a lattice of equilateral triangles,
    so all three run along edges.
    """
    rows, columns = 29, 45
    row, column = np.divmod(np.arange(rows * columns), columns)
    x, z = column - columns // 2 + 0.5 * (row - rows // 2), (row - rows // 2) * np.sqrt(3) / 2
    inner, outer = GAP / 2 + 0.5, GAP / 2 + FRAGMENT + 1
    groove = valley(z, 1.3) / (1 + np.exp(2 * (inner - abs(x)))) / (1 + np.exp(2 * (abs(x) - outer)))
    positions = np.stack([x, 0.01 * (x + z) ** 2 + 1.2 * groove, z], axis=-1)
    quads = grid_faces(rows, columns, closed_columns=False)
    faces = tuple(triangle for a, b, c, d in quads for triangle in ((a, b, d), (b, c, d)))
    straight, left, right = (detour(rows // 2, columns, away) for away in (0, 3, -4))
    searches = tuple(
        Search(title, given, {"width": 7}, closed=False) for title, given in (("from ADC", left), ("from AEC", right))
    )
    return Figure("3.3", "Two grooves are joined by the shortest way", positions, faces, searches, (straight,))


def detour(row, columns, away):
    """Return a path from left to right along a row of the lattice with a detour some rows up or down in the gap."""
    up, down = columns, 1 - columns  # both go half an edge to the right
    there, back = (up, down) if away > 0 else (down, up)
    over = [there] * abs(away) + [1] * (GAP - abs(away)) + [back] * abs(away)
    steps = [1] * FRAGMENT + over + [1] * FRAGMENT
    return row * columns + columns // 2 - GAP // 2 - FRAGMENT + np.cumsum([0, *steps])


def limb(seed=51):
    """5.1: A limb with a groove around it, the circle z = 0. The rows of the mesh are tilted, so no edges follow it."""

    def radius(angle, z):
        return 1 - 0.1 * z - 0.1 * valley(z, 0.2)

    edge, rows, columns = 0.09, 41, 63
    positions, faces = trunk(rows, columns, edge, radius, np.random.default_rng(seed), slant=0.35)
    turn = 2 * np.pi * np.arange(columns) / columns
    given = grid_path(rows // 2 + np.round(2.4 * np.sin(2 * turn)).astype(int), columns)
    refined = {"width": 6, "regular_iterations": 2, "iterations": 3}
    searches = [Search("regular", given, {"width": 6, "iterations": 2})]
    searches += [Search(f"k = {k}", given, {**refined, "refinement": k}) for k in (1, 2)]
    return Figure("5.1", "Refined contours are smoother", positions, faces, tuple(searches))


def finger_narrowing():
    """5.2: The finger's diameter decreases all the way to the tip; the base is its only concave ring."""
    positions, faces, base = finger(np.random.default_rng(52))
    given = longest_loop(positions, faces, [0.12, -0.08, 1.0], 1.9)
    searches = (
        Search("width 13", given, {"width": 13}),
        Search("width 13, then refined", given, {"width": 13, "regular_iterations": 1, "refinement": 2}),
    )
    title = "A narrowing finger: the contour climbs down to the base"
    return Figure("5.2", title, positions, tuple(faces), searches, (base,))


def thumb():
    """5.3: A thumb on its ball. The ball begins at a deep ring, and the thumb leaves it at a shallow one."""
    rng = np.random.default_rng(53)
    edge, columns = 0.2, 36
    corners = [(2.6, 0.0), (1.5, 0.0), (1.55, 0.45), (1.1, 1.0), (0.8, 3.2)]
    profile, at = corners[:1], [0]
    for (r0, z0), (r1, z1) in zip(corners, corners[1:]):
        share = np.linspace(0, 1, round(np.hypot(r1 - r0, z1 - z0) / edge) + 1)[1:]
        profile += [(r0 + (r1 - r0) * t, z0 + (z1 - z0) * t) for t in share]
        at.append(len(profile) - 1)
    profile += [(0.8 * np.cos(a), 3.2 + 0.8 * np.sin(a)) for a in np.linspace(0, np.pi / 2, 7)[1:-1]]
    positions, faces = lathe(profile, columns, 4.0, rng, 0.03 * edge)
    x, y, z = positions.T
    positions = np.stack([1.15 * x + 0.1 * np.maximum(z, 0) ** 1.5, 0.9 * y, z], axis=-1)
    deep, shallow = (at[i] * columns + np.arange(columns) for i in (1, 3))
    given = grid_path(at[3] + 3 + np.round(0.9 * np.sin(np.arange(columns))).astype(int), columns)
    settled = {"regular_iterations": 3, "refinement": 2}
    searches = tuple(Search(f"width {width}", given, {"width": width, **settled}) for width in (4, 9))
    title = "A wider band finds the deeper of two known rings (black)"
    return Figure("5.3", title, positions, tuple(faces), searches, (shallow, deep))


def torso():
    """5.4: A trunk with shallow grooves in its belly, and a deep waist below them."""

    def radius(angle, z):
        belly = 0.5 - 0.5 * np.sin(angle)
        grooves = sum(valley(z - height, 0.14) for height in TORSO_GROOVES)
        return 1.2 - 0.09 * belly * grooves - 0.3 * valley(z - TORSO_WAIST, 0.3)

    positions, faces = trunk(45, 60, 0.13, radius, np.random.default_rng(54))
    positions = positions * [1.25, 0.85, 1.0]
    given = longest_loop(positions, faces, [0.05, 0.1, 1.0], 0.6)
    searches = tuple(Search(f"width {width}", given, {"width": width, "iterations": 4}) for width in (2, 12))
    return Figure("5.4", "A wide band jumps over the grooves to the waist", positions, faces, searches)


def eyes():
    """5.5: A pair of eyes in grooves. The given contours are near the grooves only at the corners of the eyes."""

    def height(x, z):
        away = eye_distance(x, z)
        return 1.2 / (1 + np.exp(2 * away)) - 1.1 * valley(away, 1.1)

    positions, faces = relief(39, 61, height, (0.012, 0.02), np.random.default_rng(55))
    centers = np.array([positions[list(face)].mean(axis=0) for face in faces])
    inside = eye_distance(centers[:, 0], centers[:, 2], (EYE[0] + 1.0, 12.5)) < 0
    left, right = (max(border_loops(faces, inside & (side * centers[:, 0] > 0)), key=len) for side in (-1, 1))
    refined = {"width": 2, "regular_iterations": 5, "refinement": 1}
    searches = [Search(f"after {i}", left, {"width": 2, "iterations": i}) for i in range(1, 6)]
    searches += [Search("left, refined", left, refined), Search("right, refined", right, refined)]
    return Figure("5.5", "Iterations creep along the groove round an eye", positions, faces, tuple(searches))


def eye_distance(x, z, eye=EYE):
    """Return about how far a point is outside the nearer eye, an almond between two parabolas."""
    along = (abs(x) - EYES) / eye[0]
    slope = 2 * eye[1] / eye[0] * along
    return (abs(z) - eye[1] * (1 - along**2)) / np.sqrt(1 + slope**2)


def face():
    """5.6: The outline of a face, and a deeper crease below the chin. Three vertices on the chin are required."""

    def height(x, z):
        away = face_distance(x, z)
        neck = valley(np.arctan2(x, -z), NECK[2]) * valley(away - NECK[0], 1.3)
        return 1.5 / (1 + np.exp(2 * away)) - 0.9 * valley(away, 1.3) - NECK[1] * neck

    positions, faces = relief(47, 39, height, (0.02, 0.012), np.random.default_rng(56))
    x, _, z = np.array([positions[list(face)].mean(axis=0) for face in faces]).T
    wander = 1.6 * np.sin(6 * np.arctan2(z / FACE[1], x / FACE[0]))
    given = max(border_loops(faces, face_distance(x, z) < wander), key=len)
    chin = [nearest(positions, given, np.radians(degrees)) for degrees in (-120, -90, -60)]
    options = {"width": 4, "iterations": 3}
    searches = (
        Search("free", given, options),
        Search("three vertices held", given, options, {"required_vertices": np.array(chin, dtype=np.int32)}),
    )
    return Figure("5.6", "Three vertices hold the contour on the chin", positions, faces, searches)


def face_distance(x, z):
    """Return about how far a point is outside the face's outline, an ellipse."""
    return (np.hypot(x / FACE[0], z / FACE[1]) - 1) * np.mean(FACE)


def nearest(positions, vertices, angle):
    """Return which of the vertices is nearest to the point of the outline at this angle."""
    point = FACE[0] * np.cos(angle), FACE[1] * np.sin(angle)
    return int(vertices[np.argmin(np.linalg.norm(positions[vertices][:, [0, 2]] - point, axis=1))])


def hairline():
    """5.7: A head whose hair is a raised shell. The row of vertices at its foot is the hairline.

    At the back of the head the step fades away, so no closed contour is natural.
    """
    rng = np.random.default_rng(57)
    rows, columns, line = 32, 96, 18
    azimuth = 2 * np.pi * np.arange(columns) / columns - np.pi
    front = np.exp(-((azimuth / 1.4) ** 2))
    foot = np.radians(20 + 14 * front - 4 * front * np.cos(5 * azimuth))
    share = np.concatenate([np.linspace(-1, 0, line + 1), np.linspace(0, 1, rows - line)[1:]])[:, None]
    elevation = foot + np.where(share < 0, share * (foot + np.radians(75)), share * (np.radians(82) - foot))
    shell = np.clip((np.arange(rows)[:, None] - line) / 2.5, 0, 1) * np.clip((2.4 - abs(azimuth)) / 0.5, 0, 1)
    elevation, azimuth = (angle + 0.006 * rng.standard_normal(shell.shape) for angle in (elevation, azimuth))
    positions = ball(azimuth, elevation, 1 + 0.14 * shell)
    faces = split_quads(grid_faces(rows, columns), rng) + pole(rows - 1, columns, rows * columns)
    faces += pole(0, columns, rows * columns + 1, below=True)
    first, last = columns // 2 - 28, columns // 2 + 28
    wander = np.round(3.4 * np.sin(np.linspace(0, 3 * np.pi, last - first + 1))).astype(int)
    wander[[1, -2]] = 0  # the first and last edges are held, so they lie on the hairline
    given, truth = (grid_path(line + away, columns, first, closed=False) for away in (wander, 0 * wander))
    search = Search("width 5, 2 iterations", given, {"width": 5, "iterations": 2}, closed=False)
    return Figure("5.7", "An open curve finds the hairline", positions, tuple(faces), (search,), (truth,))


FIGURES = {
    "1.1": finger_at_three_heights,
    "3.3": gap_between_fragments,
    "5.1": limb,
    "5.2": finger_narrowing,
    "5.3": thumb,
    "5.4": torso,
    "5.5": eyes,
    "5.6": face,
    "5.7": hairline,
}
