# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature (thesis 3.4) against analytic values, and against the independent implementation."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from brute_force import DEFAULTS, NOTHING, Curvatures, Geometry
from conftest import surface_of


def curvature(mesh, **options):
    return mrc.curvature(surface_of(mesh), mrc.Options(**options))


def height_field(size, count, height, rng=None, jitter=0.0):
    """A triangulated square whose middle vertex is at the origin."""
    axis = np.linspace(-size, size, 2 * count + 1)
    y, x = np.meshgrid(axis, axis, indexing="ij")
    if rng is not None:
        x, y = (a + jitter * size / count * rng.uniform(-1, 1, a.shape) for a in (x, y))
        x[count, count] = y[count, count] = 0.0
    faces = meshes.grid_faces(2 * count + 1, 2 * count + 1, closed_columns=False)
    faces = meshes.split_quads(faces, rng or np.random.default_rng(0))
    return meshes.polygon_mesh(np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3), faces)


def vertices_inside(mesh, reach):
    return np.flatnonzero(np.abs(mesh.positions[:, :2]).max(axis=1) < reach)


def along(directions, axis):
    """Absolute cosines of the angles to an axis."""
    return np.abs(directions @ (np.asarray(axis, dtype=float) / np.linalg.norm(axis)))


BODIES = {
    "peanut": lambda rng: meshes.peanut(rng, 2),
    "mixed tube": lambda rng: meshes.tube(
        rng.uniform(0.8, 1.2, 8), 9, step=0.6, split_fraction=0.5, rng=rng, noise=0.1
    ),
    "rough sheet": lambda rng: height_field(1, 6, lambda x, y: 0.2 * np.sin(3 * x) * y, rng, 0.3),
}


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize(("radius", "smoothing"), [(1.6, 1.0), (0.6, 0.0), (2.7, 0.5)])
def test_matches_the_independent_implementation(body, radius, smoothing, rng):
    mesh = BODIES[body](rng)
    geometry = Geometry(mesh)
    expected = Curvatures(geometry, {**DEFAULTS, "curvature_radius": radius, "curvature_smoothing": smoothing})
    found = curvature(mesh, curvature_radius=radius, curvature_smoothing=smoothing)
    for v in range(len(mesh.positions)):
        h = geometry.scale(v)
        low, high = (0.0 if abs(k) < NOTHING / h else k for k in (expected[v].kappa_min, expected[v].kappa_max))
        assert found.kappa_min[v] == pytest.approx(low, rel=1e-9, abs=1e-10 / h)
        assert found.kappa_max[v] == pytest.approx(high, rel=1e-9, abs=1e-10 / h)
        if expected[v].kappa_max - expected[v].kappa_min > 1e-3 / h:
            assert along(found.direction_min[v], expected[v].direction_min) == pytest.approx(1, abs=1e-9)
            assert along(found.direction_max[v], expected[v].direction_max) == pytest.approx(1, abs=1e-9)


def shrinking_disk(mesh, radius, soft=False):
    """Options that average over a disk of the given radius, plain or soft. Convergence needs a disk that shrinks more
    slowly than the edges: a disk of 1.6 h keeps the error of its few edges, however fine the mesh."""
    geometry = Geometry(mesh)
    h = np.mean([geometry.scale(v) for v in range(0, len(mesh.positions), 1 + len(mesh.positions) // 60)])
    if soft:  # its radius squared is 1.5 r^2 + 6 sigma^2
        part = radius / h / np.sqrt(7.5)
        return curvature(mesh, curvature_radius=part, curvature_smoothing=part)
    return curvature(mesh, curvature_radius=radius / h, curvature_smoothing=0.0)


@pytest.mark.parametrize("subdivisions", [3, 4])
def test_sphere_has_curvature_one_over_radius(subdivisions):
    sphere = meshes.icosphere(subdivisions)
    found = curvature(sphere.moved(2.5 * sphere.positions))
    assert found.kappa_min == pytest.approx(0.4, rel=0.12)
    assert found.kappa_max == pytest.approx(0.4, rel=0.12)
    fixed = shrinking_disk(sphere, 0.3)
    assert fixed.kappa_min.mean() == pytest.approx(1, rel=0.06)


def test_cylinder_has_one_curved_direction():
    mesh = meshes.tube(np.full(41, 2.0), 64, step=0.2)
    found = curvature(mesh)
    middle = slice(18 * 64, 22 * 64)
    assert found.kappa_max[middle] == pytest.approx(0.5, rel=0.03)
    assert np.abs(found.kappa_min[middle]).max() < 1e-9
    assert along(found.direction_min[middle], [0, 0, 1]).min() > 1 - 1e-9
    around = np.cross([0, 0, 1], mesh.positions * [1, 1, 0] / 2.0)
    assert np.abs((found.direction_max * around).sum(axis=1))[middle].min() > 1 - 1e-9


def torus_errors(rows):
    mesh = meshes.torus(rows, 4 * rows)
    found = shrinking_disk(mesh, 4.0 / np.sqrt(rows), soft=True)
    angle = np.repeat(2 * np.pi * np.arange(rows) / rows, 4 * rows)
    return np.abs(found.kappa_min - np.cos(angle) / (3 + np.cos(angle))).max(), np.abs(found.kappa_max - 1).max()


def test_torus_converges():
    coarse, fine = torus_errors(12), torus_errors(48)
    assert max(fine) < 0.03
    assert fine[0] < 0.5 * coarse[0]
    assert fine[1] < 0.5 * coarse[1]


def test_torus_principal_directions():
    """kappa_min is negative on the inner side. Its direction runs around the hole, that of kappa_max around the
    tube."""
    mesh = meshes.torus(48, 192)
    found = curvature(mesh)
    inner = np.linalg.norm(mesh.positions[:, :2], axis=1) < 2.9
    assert found.kappa_min[inner].max() < 0
    round_hole = np.cross([0, 0, 1], mesh.positions)
    round_hole /= np.linalg.norm(round_hole, axis=1, keepdims=True)
    assert np.abs((found.direction_min * round_hole).sum(axis=1)).min() > 0.999
    assert np.abs((found.direction_max * round_hole).sum(axis=1)).max() < 0.03


@pytest.mark.parametrize("axis", [(1.0, 0.0), (0.6, 0.8)])
def test_concave_crease_is_negative_with_direction_along_it(axis, rng):
    """In a sharp groove kappa_min < 0, and the direction of kappa_max runs along it."""
    mesh = height_field(1, 10, lambda x, y: 0.8 * np.abs(axis[1] * x - axis[0] * y), rng, 0.1)
    found = curvature(mesh)
    off = np.abs(axis[1] * mesh.positions[:, 0] - axis[0] * mesh.positions[:, 1])
    groove = [v for v in vertices_inside(mesh, 0.6) if off[v] < 0.06]
    assert len(groove) >= 8
    assert found.kappa_min[groove].max() < -1
    assert np.median(along(found.direction_max[groove], [*axis, 0])) > 0.98


def test_convex_crease_is_positive(rng):
    mesh = height_field(1, 10, lambda x, y: -0.8 * np.abs(y), rng, 0.1)
    found = curvature(mesh)
    top = [v for v in vertices_inside(mesh, 0.6) if abs(mesh.positions[v, 1]) < 0.03]
    assert found.kappa_max[top].min() > 1
    assert np.median(along(found.direction_min[top], [1, 0, 0])) > 0.98


def test_saddle_converges(rng):
    """z = (a x^2 - b y^2) / 2, seen from above: curvature -a along x and b along y."""
    errors = []
    for count in (8, 32):
        mesh = height_field(1, count, lambda x, y: 0.5 * (0.6 * x**2 - 0.9 * y**2), rng, 0.2)
        found = shrinking_disk(mesh, 1.4 / np.sqrt(count))
        center = len(mesh.positions) // 2
        errors.append(max(abs(found.kappa_min[center] + 0.6), abs(found.kappa_max[center] - 0.9)))
        assert along(found.direction_min[center], [1, 0, 0]) > 0.99
        assert along(found.direction_max[center], [0, 1, 0]) > 0.99
    assert errors[1] < 0.04
    assert errors[1] < 0.5 * errors[0]


@pytest.mark.parametrize("size", [1e-4, 30.0])
def test_scaling_divides_the_curvature(size, rng):
    mesh = meshes.peanut(rng, 3)
    base, scaled = curvature(mesh), curvature(mesh.moved(mesh.positions * size))
    scale = np.abs(base.kappa_max).max()
    assert scaled.kappa_min * size == pytest.approx(base.kappa_min, rel=1e-9, abs=1e-9 * scale)
    assert scaled.kappa_max * size == pytest.approx(base.kappa_max, rel=1e-9, abs=1e-9 * scale)


def test_rigid_motion_changes_nothing(rng):
    mesh = meshes.peanut(rng, 3)
    base, moved = curvature(mesh), curvature(meshes.rigidly_moved(mesh, rng))
    assert moved.kappa_min == pytest.approx(base.kappa_min, abs=1e-9)
    assert moved.kappa_max == pytest.approx(base.kappa_max, abs=1e-9)


def bowl(gap=None):
    """A shallow bowl, alone or with a second sheet close below it that is connected to it only at the border."""
    sheet = height_field(1, 12, lambda x, y: 0.15 * (x**2 + 0.5 * y**2))
    if gap is None:
        return sheet, np.arange(len(sheet.positions))
    count, n = 25, len(sheet.positions)
    border = [
        *range(count),
        *range(2 * count - 1, n, count),
        *range(n - 2, n - count - 1, -1),
        *range(n - 2 * count, 0, -count),
    ]
    below = [tuple(n + v for v in face[::-1]) for face in sheet.faces]
    rim = [(a, b, n + b, n + a)[::-1] for a, b in zip(border, border[1:] + border[:1], strict=True)]
    positions = np.concatenate([sheet.positions, sheet.positions - [0, 0, gap]])
    return meshes.polygon_mesh(positions, list(sheet.faces) + below + rim), np.arange(n)


def test_other_side_of_a_thin_plate_does_not_count():
    sheet, _ = bowl()
    plate, upper = bowl(gap=0.01)
    inside = vertices_inside(sheet, 0.45)
    one, two = curvature(sheet), curvature(plate)
    assert two.kappa_min[upper][inside] == pytest.approx(one.kappa_min[inside], abs=1e-9)
    assert two.kappa_max[upper][inside] == pytest.approx(one.kappa_max[inside], abs=1e-9)


@pytest.mark.parametrize("body", BODIES)
def test_directions_are_an_orthonormal_tangent_frame(body, rng):
    mesh = BODIES[body](rng)
    found, normals = curvature(mesh), Geometry(mesh).normal
    for directions in (found.direction_min, found.direction_max):
        assert np.linalg.norm(directions, axis=1) == pytest.approx(1, abs=1e-12)
        assert np.abs((directions * normals).sum(axis=1)).max() < 1e-9
    assert np.abs((found.direction_min * found.direction_max).sum(axis=1)).max() < 1e-9
    assert (found.kappa_min <= found.kappa_max).all()


def test_diagonals_of_planar_faces_do_not_matter(rng):
    mesh = meshes.trapezoid_tube(rng, 9, 10)
    other = meshes.polygon_mesh(mesh.positions, mesh.faces, ~np.zeros(len(mesh.faces), dtype=bool))
    assert curvature(other).kappa_min == pytest.approx(curvature(mesh).kappa_min, abs=1e-9)


def test_hidden_faces_contribute_to_curvature(rng):
    mesh = meshes.peanut(rng, 2)
    hidden = mrc.curvature(surface_of(mesh, hidden_faces=np.arange(0, 300, 3, dtype=np.int32)), mrc.Options())
    assert np.array_equal(hidden.kappa_min, curvature(mesh).kappa_min)


def test_curvature_is_finite_on_degenerate_meshes(rng):
    """Borders, zero-area faces, zero-length edges, a flat fold, and a vertex without faces."""
    positions = np.array(
        [[0, 0, 0], [1, 0, 0], [2, 0, 0], [1, 1, 0], [1, 1, 0], [0, 2, 0], [2, 2, 0], [1, -1, 0], [9, 9, 9]],
        dtype=float,
    )
    faces = [(0, 1, 3), (1, 2, 3), (0, 3, 5), (3, 4, 5), (4, 6, 5), (0, 2, 1), (0, 1, 7)]
    flat = meshes.polygon_mesh(positions, faces)
    sheet = height_field(1, 5, lambda x, y: x * y)
    for mesh in (flat, sheet, meshes.tube([1, 0, 1], 5), meshes.tube([1, 1, 1], 3, step=0.0)):
        found = curvature(mesh)
        for values in (found.kappa_min, found.kappa_max, found.direction_min, found.direction_max):
            assert np.isfinite(values).all()
