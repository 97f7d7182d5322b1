# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces whose best contour is known: parallels of surfaces of revolution and sharp valleys, with triangulations that
do not follow them; three-sided prisms; thin plates."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from contour_energy import points_of


def revolved(radius, half, edge, rng, mean_radius=1.0):
    """A surface around the z axis for heights from -half to half, with jittered vertices and random triangles. The
    radius is a function of height and angle. Also returns a zigzag contour at about a given height."""
    step, columns = 0.8 * edge, round(2 * np.pi * mean_radius / edge)
    rows = round(2 * half / step)
    mesh = meshes.tube(np.ones(rows), columns, split_fraction=1.0, rng=rng)
    row, column = np.divmod(np.arange(rows * columns), columns)
    start, shift = rng.random(2), rng.uniform(-0.25, 0.25, (2, rows * columns))
    z = (row + shift[0] + start[0] - rows / 2) * step
    angle = (column + shift[1] + start[1]) * 2 * np.pi / columns
    r = radius(z, angle)
    mesh = mesh.moved(np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1))

    def contour_at(height):
        there = round(height / step + rows / 2)
        return meshes.zigzag_contour(rng, columns, there - 1, there + 1)

    return mesh, contour_at


def optimize(mesh, contour, **options):
    return mrc.optimize(surface_of(mesh), contour, options=mrc.Options(flow="harmonic", **options))


def test_finds_the_waist_of_a_hyperboloid():
    """x^2 + y^2 = 1 + z^2: the contour is within an edge length of the waist, and closer for shorter edges and larger
    k."""
    away = []
    for edge, k in ((0.5, 1), (0.25, 2), (0.125, 3)):
        mesh, contour_at = revolved(lambda z, _: np.sqrt(1 + z**2), 1.5, edge, np.random.default_rng(1))
        more = {"width": round(0.8 / edge) + 2, "regular_iterations": 4, "iterations": 6, "refinement": k}
        away.append(abs(optimize(mesh, contour_at(0.35), **more).positions[:, 2]).max())
        assert away[-1] <= edge
    assert away[0] > away[1] > away[2]


class Profile:
    """A wide waist, where the surface is thinnest, and an asymmetric groove, where it is most concave."""

    def __init__(self, rng):
        self.waist, self.groove = rng.permutation([-1.6, 1.6])
        self.waist_depth, self.groove_depth = rng.uniform(0.3, 0.4), rng.uniform(0.15, 0.2)
        self.groove_width, self.skew = rng.uniform(0.5, 0.7), rng.choice([-1, 1]) * rng.uniform(0.2, 0.4)

    def radius(self, z, _=None):
        u = (z - self.groove) / self.groove_width
        groove = self.groove_depth * np.exp(-((u * (1 + self.skew * np.tanh(u))) ** 2))
        return 1 - self.waist_depth * np.exp(-(((z - self.waist) / 1.3) ** 2)) - groove

    def kappa_min(self, z, step=1e-4):
        """The smaller principal curvature: 1 / (r sqrt(1 + r'^2)) along the parallel, -r'' / (1 + r'^2)^(3/2) along the
        profile. Where it is negative, it is the ratio of the parallel by eq. 3.2."""
        low, r, high = self.radius(z - step), self.radius(z), self.radius(z + step)
        slope, bend = (high - low) / (2 * step), (high - 2 * r + low) / step**2
        return np.minimum(-bend / (1 + slope**2) ** 1.5, 1 / (r * np.sqrt(1 + slope**2)))

    def heights(self):
        """The heights of the lowest kappa_min and of the smallest radius."""
        z = np.linspace(-2.7, 2.7, 20001)
        return z[np.argmin(self.kappa_min(z))], z[np.argmin(self.radius(z))]


def search(profile, edge, rng, **options):
    """Searches from halfway between the groove and the waist, in a band that reaches beyond both."""
    mesh, contour_at = revolved(profile.radius, 3.0, edge, rng)
    return optimize(mesh, contour_at(0.0), width=round(2.6 / (0.8 * edge)), **options)


@pytest.mark.slow
@pytest.mark.parametrize("k", [0, 1, 3])
@pytest.mark.parametrize("seed", range(8))
def test_finds_the_most_concave_parallel_not_the_thinnest(seed, k):
    rng, edge = np.random.default_rng(seed), 0.1
    profile = Profile(rng)
    concave, thinnest = profile.heights()
    assert profile.radius(concave) > 1.1 * profile.radius(thinnest)
    assert abs(concave - profile.groove) > 0.5 * edge  # the groove is asymmetric
    result = search(profile, edge, rng, refinement=k)
    assert abs(result.positions[:, 2] - concave).max() <= edge


@pytest.mark.slow
@pytest.mark.parametrize("k", [0, 1])
@pytest.mark.parametrize("seed", range(2))
def test_ratio_tends_to_the_lowest_curvature(seed, k):
    """The area that the disk B and the smoothing average over shrinks with the edges, and so does the error."""
    rng = np.random.default_rng(seed)
    profile = Profile(rng)
    lowest = profile.kappa_min(profile.heights()[0])
    errors = [abs(search(profile, edge, rng, refinement=k).ratio / lowest - 1) for edge in (0.2, 0.1, 0.05)]
    assert errors[1] < 0.6 * errors[0]
    assert errors[2] < 0.6 * errors[1]


@pytest.mark.parametrize("k", [0, 1, 3])
@pytest.mark.parametrize("seed", range(7))
def test_bulge_is_a_ridge_and_not_a_valley(seed, k):
    rng, edge = np.random.default_rng(seed), 0.1
    middle, width = rng.uniform(-0.5, 0.5), rng.uniform(0.2, 0.3)

    def radius(z, _):
        return 1 + 0.15 * np.exp(-(((z - middle) / width) ** 2))

    mesh, contour_at = revolved(radius, 1.5, edge, rng)
    start = contour_at(middle + rng.choice([-1, 1]) * 0.5)
    ridge, valley = (optimize(mesh, start, width=14, feature=f, refinement=k) for f in ("ridge", "valley"))
    assert abs(ridge.positions[:, 2] - middle).max() <= edge
    # The profile is concave where it leaves the bulge, beyond its inflections at middle +- width / sqrt(2).
    assert abs(valley.positions[:, 2] - middle).min() > width / np.sqrt(2)
    assert max(ridge.ratio, valley.ratio) < 0


def sampled(points, step):
    """Points along a closed polyline, at most a step apart."""
    ahead = np.roll(points, -1, axis=0) - points
    counts = np.ceil(np.linalg.norm(ahead, axis=1) / step).astype(int)
    fractions = np.concatenate([np.arange(count) / count for count in counts])
    return np.repeat(points, counts, axis=0) + fractions[:, None] * np.repeat(ahead, counts, axis=0)


def hausdorff(one, two, step):
    one, two = sampled(one, step), sampled(two, step)
    apart = np.linalg.norm(one[:, None] - two[None], axis=2)
    return max(apart.min(axis=0).max(), apart.min(axis=1).max())


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(7))
def test_sharp_valley_is_found_under_any_triangulation(seed):
    """The valley is a slanted curve; neither triangulation follows it, and they are independent of each other."""
    tilt, slope, phase = np.random.default_rng(seed).uniform([0.2, 0.4, 0.0], [0.6, 0.8, 2 * np.pi])

    def radius(z, angle):
        return 1 + slope * abs(z - tilt * np.cos(angle - phase))

    apart = []
    for edge in (0.28, 0.14, 0.07):
        found = []
        for other in range(2):
            mesh, contour_at = revolved(radius, 1.6, edge, np.random.default_rng([seed, other]))
            found.append(optimize(mesh, contour_at(0.0), width=round(1.0 / (0.8 * edge)), refinement=4))
        for result in found:
            x, y, z = result.positions.T
            assert abs(z - tilt * np.cos(np.arctan2(y, x) - phase)).max() <= 2 * edge
        apart.append(hausdorff(*(result.positions for result in found), edge / 10))
        assert apart[-1] <= 2 * edge
    assert apart[2] < 0.75 * apart[0]


@pytest.mark.parametrize("k", [0, 1, 2])
@pytest.mark.parametrize("seed", range(7))
def test_ring_around_a_three_sided_prism_is_legal(seed, k):
    """It turns by 120 degrees at each corner, but not in the tangent plane there. Curvature is measured so near that
    the other sides of the prism do not count."""
    rng, rows = np.random.default_rng(seed), 9
    waist, given = rng.permutation([3, 4, 5])[:2]
    mesh = meshes.tube(1 + rng.uniform(0.3, 0.6) * abs(np.arange(rows) - waist), 3, step=rng.uniform(0.7, 1.2))
    settings = {"refinement": k, "max_turn": np.radians(30), "curvature_radius": 0.8, "curvature_smoothing": 0.0}
    surface, options = surface_of(mesh), mrc.Options(flow="harmonic", width=3, **settings)
    result = mrc.optimize(surface, 3 * given + np.arange(3), options=options)
    assert result.status == "improved"
    assert (result.edge_vertices // 3 == waist).all()


def plate(rng, below=None):
    """A sheet with a hump, alone or joined at its border to a rough second sheet close below it. Also returns a loop of
    edges around the hump."""
    count, edge = 33, 0.1
    y, x = (edge * (a - count // 2 + rng.uniform(-0.2, 0.2, (count, count))) for a in np.indices((count, count)))
    z = rng.uniform(0.2, 0.4) * np.exp(-((x**2 + rng.uniform(0.5, 1.0) * y**2) / 0.16))
    faces = meshes.split_quads(meshes.grid_faces(count, count, closed_columns=False), rng)
    upper = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    number = np.arange(count**2).reshape(count, count)
    square = number[11:22, 11:22]
    loop, rim = ([*a[0, :-1], *a[:-1, -1], *a[-1, :0:-1], *a[:0:-1, 0]] for a in (square, number))
    if below is None:
        return meshes.polygon_mesh(upper, faces), np.array(loop)
    lower = upper - [0.0, 0.0, 0.02] + below.uniform(-0.005, 0.005, upper.shape)
    faces += [tuple(count**2 + v for v in face[::-1]) for face in faces]
    faces += [(b, a, count**2 + a, count**2 + b) for a, b in zip(rim, np.roll(rim, -1), strict=True)]
    return meshes.polygon_mesh(np.concatenate([upper, lower]), faces), np.array(loop)


@pytest.mark.parametrize("k", [0, 1])
@pytest.mark.parametrize("seed", range(10))
def test_other_side_of_a_thin_plate_does_not_count(seed, k):
    alone, *two = (plate(np.random.default_rng(seed), below) for below in (None, *map(np.random.default_rng, (1, 2))))
    base, *others = (optimize(*made, width=3, refinement=k) for made in (alone, *two))
    assert base.status == "improved"
    for other in others:
        assert points_of(other) == points_of(base)
        assert other.ratio == pytest.approx(base.ratio, rel=1e-10)
