# SPDX-License-Identifier: GPL-3.0-or-later
"""Open chains are closed around the limb that they lie on."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

FRACTIONS = (0.25, 1 / 3, 0.5)
COLUMNS = 28


def grid_limb(kind, rng, rows=45):
    """A limb of `rows` rings along the z axis (unless bent), of triangles and quads, with noise."""
    along = np.arange(rows) / (rows - 1)
    radius = {
        "cylinder": np.full(rows, 1.0),
        "cone": 1.3 - 0.7 * along,
        "grooved": 1.0 - 0.25 * np.exp(-(((along - 0.5) / 0.04) ** 2)),
        "tapering": 0.8 + 0.3 * np.cos(4 * along),
    }[kind]
    return meshes.tube(radius, COLUMNS, step=0.2, split_fraction=rng.uniform(), rng=rng, noise=0.01)


def limb(rng):
    """A random limb, with the center and two directions of a plane across its axis, in the middle."""
    kind = rng.choice(["cylinder", "cone", "grooved", "tapering", "bent"])
    if kind != "bent":
        return grid_limb(kind, rng), np.zeros(3), np.eye(3)[:2]
    middle = np.array([1, 1, 0]) / np.sqrt(2)
    return meshes.bent_tube(rng, rows=45, columns=COLUMNS), 4 * middle, np.array([middle, [0, 0, 1]])


def rough_ring(rng, lowest=19, highest=25):
    return meshes.zigzag_contour(rng, COLUMNS, lowest, highest, step_chance=rng.uniform(0, 0.6))


def length_of(mesh, contour, closed=True):
    points = mesh.positions[np.append(contour, contour[0]) if closed else contour]
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum()


def part_of(mesh, ring, fraction, rng):
    """A chain along a ring that has this fraction of its length, from a random place in a random direction."""
    ring = np.roll(ring, rng.integers(len(ring)))
    steps = np.linalg.norm(np.diff(mesh.positions[np.append(ring, ring[0])], axis=0), axis=1)
    count = max(2, int(np.searchsorted(np.cumsum(steps), fraction * steps.sum())) + 1)
    return ring[:count][:: rng.choice([-1, 1])].copy()


def winding(mesh, loop, center, plane):
    """How many times a loop goes around the axis through the center."""
    x, y = plane @ (mesh.positions[loop] - center).T
    steps = np.diff(np.unwrap(np.arctan2(np.append(y, y[0]), np.append(x, x[0]))))
    return round(steps.sum() / (2 * np.pi))


def edges_of(loop):
    return {frozenset(pair) for pair in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True)}


def check_simple(mesh, loop, chain):
    """The loop begins with the chain, passes no vertex twice, and follows mesh edges."""
    np.testing.assert_array_equal(loop[: len(chain)], chain)
    assert len(set(loop.tolist())) == len(loop)
    assert edges_of(loop) <= {frozenset(pair) for pair in mesh.real_edges().tolist()}


@pytest.mark.parametrize("fraction", FRACTIONS)
def test_part_of_a_ring_is_closed_once_around_the_limb(fraction):
    for seed in range(70):
        rng = np.random.default_rng([seed, round(100 * fraction)])
        mesh, center, plane = limb(rng)
        ring = rough_ring(rng)
        chain = part_of(mesh, ring, fraction, rng)
        loop = mrc.close_contour(surface_of(mesh), chain)
        check_simple(mesh, loop, chain)
        assert abs(winding(mesh, loop, center, plane)) == 1, seed
        assert length_of(mesh, loop) <= 1.3 * length_of(mesh, ring), seed


@pytest.mark.parametrize("count", [2, 3, 4, 27])
def test_shortest_and_longest_chains_are_closed(count):
    """A single edge of a straight ring is enough, and a ring without one edge is completed by that edge."""
    for seed in range(10):
        rng = np.random.default_rng(seed)
        mesh = grid_limb(rng.choice(["cylinder", "grooved"]), rng)
        ring = 22 * COLUMNS + np.roll(np.arange(COLUMNS), rng.integers(COLUMNS))
        loop = mrc.close_contour(surface_of(mesh), ring[:count])
        check_simple(mesh, loop, ring[:count])
        assert abs(winding(mesh, loop, np.zeros(3), np.eye(3)[:2])) == 1
        assert length_of(mesh, loop) <= 1.3 * length_of(mesh, ring)
    assert count < 27 or edges_of(loop) == edges_of(ring)


def test_chain_is_closed_around_the_tube_of_a_torus():
    for seed in range(20):
        rng = np.random.default_rng(seed)
        mesh = meshes.torus(20, 60, rng=rng, split_fraction=rng.uniform(), noise=0.01)
        ring = 60 * np.arange(20) + rng.integers(60)
        loop = mrc.close_contour(surface_of(mesh), part_of(mesh, ring, 0.3, rng))
        assert winding(mesh, loop, np.zeros(3), np.eye(3)[:2]) == 0
        direction = mesh.positions[ring].mean(axis=0)
        around = np.array([direction / np.linalg.norm(direction), [0, 0, 1]])
        assert abs(winding(mesh, loop, direction, around)) == 1


def test_chain_is_closed_around_a_thin_limb():
    """The section is flat, four times as wide as thick."""
    for seed in range(20):
        rng = np.random.default_rng(seed)
        mesh = grid_limb("cylinder", rng)
        flat = mesh.moved(mesh.positions * [1.0, 0.25, 1.0])
        chain = part_of(flat, rough_ring(rng), 1 / 3, rng)
        assert abs(winding(flat, mrc.close_contour(surface_of(flat), chain), np.zeros(3), np.eye(3)[:2])) == 1


def test_chain_is_closed_around_a_finger_not_over_its_tip():
    for seed in range(20):
        rng = np.random.default_rng(seed)
        mesh, base = meshes.finger(rng)
        base = np.asarray(base)
        loop = mrc.close_contour(surface_of(mesh), part_of(mesh, base, 0.25, rng))
        center = mesh.positions[base].mean(axis=0)
        assert abs(winding(mesh, loop, center, np.eye(3)[:2])) == 1
        radius = np.linalg.norm(mesh.positions[base] - center, axis=1).mean()
        assert np.abs(mesh.positions[loop, 2] - center[2]).max() < radius
        assert length_of(mesh, loop) <= 1.3 * length_of(mesh, base)


def test_reversal_gives_the_same_loop():
    """This holds even if many paths are equally short."""
    for seed in range(20):
        rng = np.random.default_rng(seed)
        mesh = meshes.tube(np.full(30, 1.0), COLUMNS, step=0.2) if seed % 2 else limb(rng)[0]
        chain = part_of(mesh, rough_ring(rng, 12, 17), rng.choice(FRACTIONS), rng)
        surface = surface_of(mesh)
        there, back = mrc.close_contour(surface, chain), mrc.close_contour(surface, chain[::-1].copy())
        np.testing.assert_array_equal(np.roll(there[::-1], len(chain)), back)


def test_rigid_motion_scale_and_renumbering_change_nothing():
    for seed in range(20):
        rng = np.random.default_rng(seed)
        mesh, _, _ = limb(rng)
        chain = part_of(mesh, rough_ring(rng), rng.choice(FRACTIONS), rng)
        loop = mrc.close_contour(surface_of(mesh), chain)
        for other in (
            meshes.rigidly_moved(mesh, rng),
            mesh.moved(mesh.positions * 1e-3),
            mesh.moved(mesh.positions * 1e4),
        ):
            np.testing.assert_array_equal(mrc.close_contour(surface_of(other), chain), loop)
        other, number = meshes.renumbered(mesh, rng)
        np.testing.assert_array_equal(mrc.close_contour(surface_of(other), number[chain]), number[loop])


def test_faces_far_away_change_nothing():
    """A limb three times as long gives the same loop."""
    for seed in range(10):
        rng = np.random.default_rng(seed)
        mesh = grid_limb("grooved", rng)
        faces = [*mesh.faces, *meshes.grid_faces(91, COLUMNS)[44 * COLUMNS :]]
        angle = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
        rest = [np.column_stack([np.cos(angle), np.sin(angle), np.full(COLUMNS, 0.2 * row)]) for row in range(45, 91)]
        longer = meshes.polygon_mesh(np.concatenate([mesh.positions, *rest]), faces)
        chain = part_of(mesh, rough_ring(rng), 0.3, rng)
        np.testing.assert_array_equal(
            mrc.close_contour(surface_of(longer), chain), mrc.close_contour(surface_of(mesh), chain)
        )


@pytest.mark.parametrize("fraction", FRACTIONS)
def test_optimization_finds_the_groove_from_part_of_a_ring(fraction):
    """This holds if the chain lies within three rings of the groove, wherever it begins."""
    options = mrc.Options(flow="harmonic", width=8, iterations=2, length_bias=2.0, anchor=0.5)
    for seed in range(70):
        rng = np.random.default_rng([seed, round(100 * fraction)])
        mesh = grid_limb("grooved", rng)
        chain = part_of(mesh, rough_ring(rng, 20, 25), fraction, rng)
        surface = surface_of(mesh)
        result = mrc.optimize(surface, mrc.close_contour(surface, chain), options=options)
        assert np.abs(np.asarray(result.vertices) // COLUMNS - 22).max() <= 1, seed


# ---- chains that cannot be closed, and cancelling


def plane(rows=12, columns=15):
    x, y = np.meshgrid(np.arange(columns) * 1.0, np.arange(rows) * 1.0)
    points = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    return meshes.polygon_mesh(points, meshes.grid_faces(rows, columns, closed_columns=False))


def test_progress_never_decreases_and_changes_nothing():
    rng = np.random.default_rng(4)
    mesh, chain = grid_limb("grooved", rng), np.arange(20 * COLUMNS + 3, 20 * COLUMNS + 12)
    fractions = []
    loop = mrc.close_contour(surface_of(mesh), chain, progress=fractions.append)
    np.testing.assert_array_equal(loop, mrc.close_contour(surface_of(mesh), chain))
    assert fractions == sorted(fractions)
    assert (fractions[0], fractions[-1]) == (0.0, 1.0)


def test_closing_can_be_cancelled_at_once():
    surface, fractions = surface_of(grid_limb("cylinder", np.random.default_rng(4))), []
    chain = np.arange(20 * COLUMNS + 3, 20 * COLUMNS + 12)
    assert mrc.close_contour(surface, chain, progress=lambda fraction: fractions.append(fraction) or False) is None
    assert fractions == [0.0]
    with pytest.raises(ZeroDivisionError):
        mrc.close_contour(surface, chain, progress=lambda _: 1 / 0)


def test_long_vain_search_can_be_cancelled():
    """Everything within reach is searched before the chain is refused, and progress is called meanwhile."""
    plane = meshes.polygon_mesh(*flat_sheet(160))
    fractions = []
    with pytest.raises(ValueError, match="nothing leads"):
        mrc.close_contour(surface_of(plane), np.arange(12870, 12890), progress=fractions.append)
    assert len(fractions) > 3
    assert fractions == sorted(fractions)
    heard = []
    left = mrc.close_contour(
        surface_of(plane), np.arange(12870, 12890), progress=lambda fraction: heard.append(fraction) or fraction < 0.3
    )
    assert left is None
    assert 0.3 <= heard[-1] < 0.9


def flat_sheet(size):
    x, y = np.meshgrid(np.arange(size) * 1.0, np.arange(size) * 1.0)
    points = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    return points, meshes.grid_faces(size, size, closed_columns=False)


def test_chain_on_a_plane_cannot_be_closed():
    with pytest.raises(ValueError, match="vertex 83.*vertex 79.*draw the chain on a limb"):
        mrc.close_contour(surface_of(plane()), np.arange(79, 84))


def test_hidden_faces_and_slits_are_not_crossed():
    """A slit along the whole opposite side of the limb, or hidden faces there, leave no path around."""
    mesh = meshes.tube(np.full(20, 1.0), COLUMNS, step=0.2)
    chain = np.arange(5, 10) + 10 * COLUMNS
    behind = [i for i, face in enumerate(mesh.faces) if {v % COLUMNS for v in face} & {20, 21}]
    assert abs(winding(mesh, mrc.close_contour(surface_of(mesh), chain), np.zeros(3), np.eye(3)[:2])) == 1
    with pytest.raises(ValueError, match="hidden"):
        mrc.close_contour(surface_of(mesh, hidden_faces=np.array(behind, dtype=np.int32)), chain)
    slit = meshes.polygon_mesh(mesh.positions, [face for i, face in enumerate(mesh.faces) if i not in behind])
    with pytest.raises(ValueError, match="border"):
        mrc.close_contour(surface_of(slit), chain)


@pytest.mark.parametrize(
    ("chain", "message"),
    [
        ([40], "1 vertices"),
        ([], "0 vertices"),
        ([40, 41, 40], "vertex 40 twice"),
        ([40, 45], "40 and 45 are not joined"),
        ([40, 99999], "99999 is out of range"),
        ([0, 1, 2], r"\(0, 1\).*border"),
    ],
)
def test_errors_name_the_bad_vertices_of_a_chain(chain, message):
    mesh = meshes.tube(np.full(20, 1.0), COLUMNS)
    with pytest.raises(ValueError, match=message):
        mrc.close_contour(surface_of(mesh), np.array(chain, dtype=np.int32))


# ---- nothing doubles back


def split_tube(radius, caps=False):
    """A tube whose column 0 has vertices of its own on each side, as a format with texture coordinates stores it."""
    mesh = meshes.tube(radius, COLUMNS, step=0.2)
    rows, count = len(radius), len(mesh.positions)
    first = np.arange(rows) * COLUMNS
    twin = dict(zip(first.tolist(), range(count, count + rows), strict=True))
    faces = [
        tuple(twin.get(v, v) for v in face) if {v % COLUMNS for v in face} == {0, COLUMNS - 1} else face
        for face in mesh.faces
    ]
    positions = np.concatenate([mesh.positions, mesh.positions[first]])
    if caps:
        top = (rows - 1) * COLUMNS + np.arange(COLUMNS)
        around = [*top.tolist(), twin[int(top[0])]]
        faces += [(a, b, len(positions)) for a, b in zip(around, around[1:], strict=False)]
        positions = np.concatenate([positions, [[0, 0, 0.2 * rows]]])
    return meshes.polygon_mesh(positions, faces), count


GROOVED = 1 - 0.3 * np.exp(-(((np.arange(41) - 22) / 4.0) ** 2))


@pytest.mark.parametrize("radius", [np.full(41, 1.0), GROOVED])
@pytest.mark.parametrize(
    ("part", "caps"),
    [
        (slice(None), False),
        (slice(None), True),
        (slice(1, None), False),
        (slice(1, None), True),
        (slice(4, 14), False),
        (slice(8, 12), False),
        (slice(0, 9), False),
        (slice(0, 9), True),
    ],
)
@pytest.mark.parametrize("row", [19, 22])
def test_on_a_mesh_that_is_split_a_chain_is_refused_with_the_cure(radius, caps, part, row):
    mesh, count = split_tube(radius, caps)
    chain = [*range(row * COLUMNS, (row + 1) * COLUMNS), count + row][part]
    with pytest.raises(ValueError, match="lie at the same place.*Merge by Distance") as caught:
        mrc.close_contour(surface_of(mesh), chain)
    places = mesh.positions[[vertex for _, vertex in caught.value.elements]]
    np.testing.assert_array_equal(places[0], places[1])


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_a_slit_leaves_no_way_back_beside_a_chain_that_is_nearly_a_loop(scale):
    mesh = meshes.tube(GROOVED, COLUMNS, step=0.2)
    kept = [face for face in mesh.faces if {v % COLUMNS for v in face} != {0, COLUMNS - 1}]
    slit = meshes.polygon_mesh(mesh.positions * scale, kept)
    for row in (16, 19, 22):
        for count in (COLUMNS, COLUMNS - 3, COLUMNS // 2):
            with pytest.raises(ValueError, match="nothing leads"):
                mrc.close_contour(surface_of(slit), row * COLUMNS + np.arange(count))


def blade(rows, half_width=6, height=0.25):
    """A flat limb, two faces thick, of this many rows of faces up to its end."""
    across = np.linspace(-1, 1, 2 * half_width + 1)
    thick = 0.1
    section = [(x, -thick) for x in across] + [(1.05, 0.0)] + [(x, thick) for x in across[::-1]] + [(-1.05, 0.0)]
    columns = len(section)
    rings = [np.column_stack([section, np.full(columns, height * row)]) for row in range(30 + rows)]
    faces = meshes.grid_faces(30 + rows, columns)
    top = np.arange((29 + rows) * columns, (30 + rows) * columns)
    faces += [tuple(top.tolist())]
    return meshes.polygon_mesh(np.concatenate(rings), faces), columns


@pytest.mark.parametrize("rows", [1, 2, 3, 8])
@pytest.mark.parametrize("count", [7, 13, 20, 27])
def test_short_limbs_are_no_way_back(rows, count):
    """Even where the end of a flat limb is much nearer than its sides."""
    mesh, columns = blade(rows)
    chain = 29 * columns + np.arange(min(count, columns - 1))
    loop = mrc.close_contour(surface_of(mesh), chain)
    check_simple(mesh, loop, chain)
    assert set(loop % columns) >= set(range(columns)) - {13, 27}


@pytest.mark.parametrize("sides", [3, 4, 6])
def test_a_spike_of_few_faces_is_a_limb(sides):
    radius = [1.0, 1.0, 1.0, 0.9, 0.6]
    mesh = meshes.tube(radius, sides, step=0.8)
    base = (len(radius) - 2) * sides + np.arange(sides)
    top = base + sides
    tip = len(mesh.positions)
    faces = [*mesh.faces, *[(a, b, tip) for a, b in zip(top.tolist(), np.roll(top, -1).tolist(), strict=True)]]
    spike = meshes.polygon_mesh(np.concatenate([mesh.positions, [[0, 0, 4.5]]]), faces)
    for ring in (base, top):
        loop = mrc.close_contour(surface_of(spike), ring[:-1])
        assert set(loop.tolist()) == set(ring.tolist())
