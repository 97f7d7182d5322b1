# SPDX-License-Identifier: GPL-3.0-or-later
"""Several contours of one mesh (1.4): they stay apart, and no result depends on their order or the number of
threads."""

from itertools import combinations

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from contour_checks import crossings, meetings
from contour_energy import UNITS, point_on, points_of, vertex

FLOWS = ("harmonic", "gates", "arc_length")


def body(rng, kind):
    """A mesh, and the numbers of rows and columns of its grid."""
    rows, columns = int(rng.integers(24, 34)), int(rng.integers(10, 16))
    if kind == "torus":
        split = rng.choice([0.0, 0.5, 1.0])
        return meshes.torus(columns, rows, rng=rng, split_fraction=split, noise=0.05, grooves=0.3), columns, rows
    radius = 1 + 0.3 * np.sin(0.9 * np.arange(rows)) + rng.uniform(-0.15, 0.15, rows)
    split, noise = rng.choice([0.0, 0.5, 1.0]), rng.choice([0.0, 0.05])
    return meshes.tube(radius, columns, step=0.4, rng=rng, split_fraction=split, noise=noise), rows, columns


def loops_in_a_row(rng, kind):
    """Loops around a tube or along a torus at random distances: from side by side to out of each other's reach."""
    mesh, rows, columns = body(rng, kind)
    row, contours = int(rng.integers(2, 5)), []
    while row + 2 < rows - 2:
        highest = row + int(rng.integers(0, 3))
        contours.append(meshes.zigzag_contour(rng, columns, row, min(highest, rows - 3), step_chance=0.4))
        row = highest + int(rng.choice([1, 1, 2, 3, 8, 12]))
    return mesh, contours


def options_for(rng, seed, **more):
    options = {
        "width": int(rng.integers(1, 6)),
        "flow": FLOWS[seed % 3],
        "refinement": (0, 0, 1, 2)[seed % 4],
        "iterations": int(rng.integers(1, 4)),
        "regular_iterations": int(rng.integers(0, 2)),
    }
    if rng.random() < 0.3:
        options |= {"length_bias": 0.5, "anchor": 0.2}
    if rng.random() < 0.3:
        options["min_salience"] = float(rng.uniform(0.0, 1.5))
    return mrc.Options(**options | more)


def check_apart(mesh, results, given):
    """Results meet only in points that the given contours shared; each is simple and no worse than given."""
    for result in results:
        assert result.objective <= result.initial_objective
        assert crossings(mesh, points_of(result), result.closed) == []
    for (one, two), pair in zip(combinations(results, 2), combinations(given, 2), strict=True):
        touched = {vertex(v) for v in set(pair[0].tolist()) & set(pair[1].tolist())}
        assert set(meetings(mesh, points_of(one), points_of(two), (one.closed, two.closed))) <= touched


def same(one, two):
    """Equal to the last bit."""
    return (
        one.status == two.status
        and one.edge_vertices.tobytes() == two.edge_vertices.tobytes()
        and one.edge_parameters.tobytes() == two.edge_parameters.tobytes()
        and [one.objective, one.ratio, one.lower_bound, one.history]
        == [two.objective, two.ratio, two.lower_bound, two.history]
    )


def cases(count):
    return pytest.mark.parametrize(
        "seed", [pytest.param(seed, marks=[pytest.mark.slow] if seed >= 6 else []) for seed in range(count)]
    )


@pytest.mark.parametrize("kind", ["tube", "torus"])
@cases(24)
def test_loops_stay_apart_in_any_order_on_any_number_of_threads(kind, seed):
    rng = np.random.default_rng([seed, len(kind)])
    mesh, contours = loops_in_a_row(rng, kind)
    surface, options = surface_of(mesh), options_for(rng, seed)
    results = mrc.optimize_all(surface, contours, options=options)
    check_apart(mesh, results, contours)

    order = rng.permutation(len(contours))
    for threads in (1, 3):
        options = mrc.Options(**{name: getattr(options, name) for name in OPTION_NAMES} | {"threads": threads})
        again = mrc.optimize_all(surface, [contours[i] for i in order], options=options)
        for place, i in enumerate(order):
            assert same(again[place], results[i])
            assert sorted(order[j] for j in again[place].held_back_by) == list(results[i].held_back_by)


OPTION_NAMES = [name for name, value in vars(mrc.Options).items() if isinstance(value, property)]


def test_contour_not_held_back_finds_what_it_finds_alone():
    free = held = 0
    for seed in range(24):
        rng = np.random.default_rng(seed)
        mesh, contours = loops_in_a_row(rng, "tube")
        surface, options = surface_of(mesh), options_for(rng, seed, iterations=1, regular_iterations=0)
        results = mrc.optimize_all(surface, contours, options=options)
        for contour, result in zip(contours, results, strict=True):
            assert result.held_back_by or same(result, mrc.optimize(surface, contour, options=options))
            free += not result.held_back_by
            held += bool(result.held_back_by)
    assert min(free, held) >= 10


def test_contours_optimized_alone_would_cross():
    """Otherwise the tests above would prove little."""
    crossing = 0
    for seed in range(12):
        rng = np.random.default_rng([seed, 4])
        mesh, contours = loops_in_a_row(rng, "tube")
        surface, options = surface_of(mesh), mrc.Options(width=5, iterations=2)
        alone = [points_of(mrc.optimize(surface, contour, options=options)) for contour in contours]
        crossing += any(meetings(mesh, one, two) for one, two in combinations(alone, 2))
        check_apart(mesh, mrc.optimize_all(surface, contours, options=options), contours)
    assert crossing >= 6


@pytest.mark.parametrize("k", [0, 1])
def test_list_of_one_contour_equals_optimize(realistic, k):
    _, mesh, contour = realistic
    surface, options = surface_of(mesh), mrc.Options(iterations=2, refinement=k)
    (listed,) = mrc.optimize_all(surface, [contour], options=options)
    assert same(listed, mrc.optimize(surface, contour, options=options))
    assert listed.held_back_by == ()


def two_grooves(depths=(0.3, 0.2)):
    """A tube with grooves at rows 10 and 20."""
    rows, columns = 31, 24
    row = np.arange(rows)
    radius = 1 - sum(d * np.exp(-(((row - at) / 1.2) ** 2)) for d, at in zip(depths, (10, 20), strict=True))
    mesh = meshes.tube(radius, columns, step=0.2)
    return mesh, [r * columns + np.arange(columns, dtype=np.int32) for r in range(rows)]


def test_neighbors_that_would_swap_places_keep_their_order():
    """Each requires a vertex in the groove of the other. Alone, both would pass the other; together neither does."""
    mesh, ring = two_grooves()
    surface, options = surface_of(mesh), mrc.Options(width=12)
    contours, wanted = [ring[13], ring[17]], [[int(ring[20][0])], [int(ring[10][0])]]
    alone = [
        mrc.optimize(surface, contour, options=options, required_vertices=vertices)
        for contour, vertices in zip(contours, wanted, strict=True)
    ]
    assert [result.status for result in alone] == ["constrained", "constrained"]
    assert alone[0].positions[:, 2].mean() > alone[1].positions[:, 2].mean()
    for order in ([0, 1], [1, 0]):
        listed = [contours[i] for i in order], [wanted[i] for i in order]
        with pytest.raises(ValueError, match="^contour 0: required vertex .* other contours"):
            mrc.optimize_all(surface, listed[0], options=options, required_vertices=listed[1])
    together = mrc.optimize_all(surface, contours, options=options)
    heights = [mesh.positions[result.vertices, 2] for result in together]
    assert heights[0].max() < heights[1].min()
    assert together[0].held_back_by == (1,)
    assert together[1].held_back_by == (0,)


def test_only_one_of_two_contours_gets_the_same_groove():
    """The nearer one gets it. The other stops beside it and names the first in `held_back_by`."""
    mesh, ring = two_grooves((0.0, 0.3))
    surface, options = surface_of(mesh), mrc.Options(width=9, iterations=3)
    alone = [mrc.optimize(surface, ring[r], options=options) for r in (13, 18)]
    assert all(abs(result.positions[:, 2] / 0.2 - 20).max() < 1.5 for result in alone)
    far, near = mrc.optimize_all(surface, [ring[13], ring[18]], options=options)
    assert abs(near.positions[:, 2] / 0.2 - 20).max() < 1.5
    assert far.positions[:, 2].max() < near.positions[:, 2].min()
    assert far.held_back_by == (1,)


# ---- across faces


def level_line(mesh, values, level):
    """The closed line on which a function given at the vertices has this level, as points on edges and diagonals."""
    following = {}
    for triangle in mesh.triangles.tolist():
        crossing = {}
        for a, b in zip(triangle, triangle[1:] + triangle[:1], strict=True):
            if (values[a] > level) != (values[b] > level):
                fraction = round(40 * (level - values[a]) / (values[b] - values[a])) / 40
                crossing[values[a] > level] = point_on(a, b, fraction)
        if crossing:
            following[crossing[True]] = crossing[False]
    line = [next(iter(following))]
    while following[line[-1]] != line[0]:
        line.append(following[line[-1]])
    return np.array([p[:2] for p in line], dtype=np.int32), np.array([p[2] / UNITS for p in line])


def grooved_tube():
    rows, columns = 13, 24
    radius = 1 - 0.3 * np.exp(-(((np.arange(rows) - 5) / 1.5) ** 2))
    return meshes.tube(radius, columns, step=0.3, rng=np.random.default_rng(1), split_fraction=1.0)


@pytest.mark.parametrize("k", [0, 1])
def test_contour_does_not_cross_another_in_the_same_faces(k):
    """Alone, both would move down to row 5. The upper one snaps to row 6, which is below the other one."""
    mesh = grooved_tube()
    surface, options = surface_of(mesh), mrc.Options(width=3, iterations=2, refinement=k)
    rows = mesh.positions[:, 2] / 0.3
    given = [level_line(mesh, rows, level) for level in (6.4, 6.2)]
    for edge_vertices, edge_parameters in given:
        alone = mrc.optimize(surface, edge_vertices=edge_vertices, edge_parameters=edge_parameters, options=options)
        assert abs(alone.positions[:, 2] / 0.3 - 5).max() < 0.5
    for result, other in zip(mrc.optimize_all(surface, given, options=options), (1, 0), strict=True):
        assert (result.status, result.held_back_by) == ("unchanged", (other,))
        assert f"contour {other}" in result.reason
    above, below = mrc.optimize_all(surface, [level_line(mesh, rows, 7.4), given[1]], options=options)
    assert below.positions[:, 2].max() < above.positions[:, 2].min()
    assert meetings(mesh, points_of(above), points_of(below)) == []


@pytest.mark.parametrize("k", [0, 1])
def test_edge_crossed_by_another_contour_is_closed(k):
    """A small loop surrounds a vertex of row 6, to which a loop around the tube snaps."""
    mesh = grooved_tube()
    surface, options = surface_of(mesh), mrc.Options(width=3, iterations=2, refinement=k)
    at = 6 * 24 + 5
    near = np.where(np.arange(len(mesh.positions)) == at, 1.0, 0.0)
    around = mesh.positions[:, 2] / 0.3 - 0.8 * near  # so the level line of 6 - 0.3 passes above the vertex
    given = [level_line(mesh, around, 5.7), level_line(mesh, near, 0.9)]
    assert meetings(mesh, *(as_points(contour) for contour in given)) == []
    results = mrc.optimize_all(surface, given, options=options)
    assert meetings(mesh, *(points_of(result) for result in results)) == []


def as_points(contour):
    return [point_on(a, b, t) for (a, b), t in zip(contour[0].tolist(), contour[1].tolist(), strict=True)]


# ---- open chains


def network(rng):
    """Chains of a grid on a tube that meet in junctions: along four meridians and around three rings."""
    rows, columns = 25, 16
    radius = 1 + 0.3 * np.sin(0.7 * np.arange(rows)) + rng.uniform(-0.1, 0.1, rows)
    mesh = meshes.tube(radius, columns, step=0.4, rng=rng, split_fraction=rng.choice([0.0, 1.0]), noise=0.03)
    grid = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    levels, meridians = (4, 12, 20), (0, 4, 8, 12)
    chains = [grid[low : high + 1, c] for low, high in zip(levels, levels[1:], strict=False) for c in meridians]
    chains += [grid[r, np.arange(c, c + 5) % columns] for r in levels for c in meridians]
    return mesh, [np.ascontiguousarray(chain) for chain in chains]


@pytest.mark.parametrize("k", [0, 1])
@cases(9)
def test_network_keeps_its_junctions(k, seed):
    rng = np.random.default_rng([seed, k])
    mesh, chains = network(rng)
    ends = ("vertices", "edges", "border")[seed % 3]
    options = mrc.Options(width=3, flow=FLOWS[seed // 3], refinement=k, ends=ends, iterations=2)
    results = mrc.optimize_all(surface_of(mesh), chains, closed=False, options=options)
    check_apart(mesh, results, chains)
    for chain, result in zip(chains, results, strict=True):
        points = points_of(result)
        assert (points[0], points[-1]) == (vertex(chain[0]), vertex(chain[-1]))
    assert sum(result.status == "improved" for result in results) >= 1


def test_end_on_the_border_slides_unless_shared():
    rows, columns = 9, 16
    rng = np.random.default_rng(5)
    mesh = meshes.tube(1 + 0.3 * np.cos(np.arange(rows)), columns, step=0.4, rng=rng, split_fraction=1.0, noise=0.05)
    grid = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    edges = {tuple(edge) for edge in mesh.real_edges().tolist()}
    # A meridian, and a chain that starts at the same border vertex with a diagonal step.
    column = next(c for c in range(4, 12) if (grid[0, c], grid[1, c + 1]) in edges)
    meridian, other = np.ascontiguousarray(grid[:, column]), np.r_[grid[0, column], grid[1:4, column + 1]]
    surface, options = surface_of(mesh), mrc.Options(width=3, ends="border", max_turn=2.5)
    alone = mrc.optimize(surface, meridian, closed=False, options=options)
    held, _ = mrc.optimize_all(surface, [meridian, other.astype(np.int32)], closed=False, options=options)
    assert alone.vertices[0] != meridian[0]
    assert held.vertices[0] == meridian[0]


# ---- arguments for each contour


def test_arguments_apply_to_all_contours_or_to_each():
    mesh, ring = two_grooves()
    surface, options = surface_of(mesh), mrc.Options(width=2)
    chain = ring[24][:9].copy()
    contours = [ring[6], chain, ring[14]]
    closed = [True, False, True]
    vertices, edges = [[int(ring[7][3])], [], []], [[], [], [(int(ring[14][5]), int(ring[14][6]))]]
    both = mrc.optimize_all(
        surface, contours, closed=closed, options=options, required_vertices=vertices, required_edges=edges
    )
    assert [result.closed for result in both] == closed
    assert both[0].status == "constrained"
    assert ring[7][3] in both[0].vertices
    places = [both[2].vertices.tolist().index(v) for v in edges[2][0]]
    assert places[1] == (places[0] + 1) % len(both[2].vertices)
    scales = [result.scales for result in both]
    again = mrc.optimize_all(surface, contours, closed=closed, options=options, scales=scales)
    assert [result.scales.L0 for result in again] == [one.L0 for one in scales]
    shared = mrc.optimize_all(surface, contours, closed=closed, options=options, scales=scales[0])
    assert {result.scales.L0 for result in shared} == {scales[0].L0}


def test_contours_may_be_results_and_points_on_edges():
    mesh, ring = two_grooves()
    surface, options = surface_of(mesh), mrc.Options(width=2, refinement=1)
    first = mrc.optimize_all(surface, [ring[7], ring[17]], options=options)
    points = [(result.edge_vertices, result.edge_parameters) for result in first]
    for contours in (first, points):
        again = mrc.optimize_all(surface, contours, options=options, scales=[result.scales for result in first])
        for one, two in zip(again, first, strict=True):
            assert one.initial_objective == pytest.approx(two.objective, rel=1e-12)
            assert one.objective <= one.initial_objective


def test_held_back_by_names_a_contour_along_another():
    mesh, ring = two_grooves()
    results = mrc.optimize_all(surface_of(mesh), [ring[8], ring[8], ring[18]])
    assert [result.held_back_by for result in results] == [(1,), (0,), ()]
    assert [result.status for result in results] == ["unchanged", "unchanged", "improved"]


def test_joint_iterations_converge():
    """A contour that returns to where it was given, since it found nothing concave, does not restart the others."""
    rows = np.arange(31)
    radius = 1 - 0.3 * np.exp(-(((rows - 10) / 1.2) ** 2)) - 0.01 * np.exp(-((rows - 16.0) ** 2))
    ring = rows[:, None] * 24 + np.arange(24)
    surface = surface_of(meshes.tube(radius, 24, step=0.2))
    few, many = (
        mrc.optimize_all(surface, [ring[11], ring[15]], options=mrc.Options(iterations=i, min_salience=1.0))
        for i in (6, 20)
    )
    assert [result.status for result in many] == ["improved", "unchanged"]
    assert [result.statistics["iterations"] for result in many] == [result.statistics["iterations"] for result in few]
    assert max(result.statistics["iterations"] for result in few) < 6


def test_empty_list_of_contours_is_legal():
    assert mrc.optimize_all(surface_of(two_grooves()[0]), []) == []


def test_touching_given_contours_still_touch_only_there():
    mesh, ring = two_grooves()
    # Each contour steps to the ring between them and back again.
    first = np.r_[ring[8][:6], ring[9][5:8], ring[8][7:]].astype(np.int32)
    second = np.r_[ring[10][:6], ring[9][5:8], ring[10][7:]].astype(np.int32)
    results = mrc.optimize_all(surface_of(mesh), [first, second], options=mrc.Options(width=4, iterations=2))
    check_apart(mesh, results, [first, second])


def test_progress_is_called_and_can_cancel_all():
    mesh, ring = two_grooves()
    surface, options = surface_of(mesh), mrc.Options(iterations=3)
    fractions = []
    mrc.optimize_all(surface, [ring[7], ring[17]], options=options, progress=fractions.append)
    assert fractions == sorted(fractions)
    assert (fractions[0], fractions[-1]) == (0.0, 1.0)
    cancelled = mrc.optimize_all(surface, [ring[7], ring[17]], options=options, progress=lambda _: False)
    assert [result.status for result in cancelled] == ["cancelled", "cancelled"]
    assert [result.vertices.tolist() for result in cancelled] == [ring[7].tolist(), ring[17].tolist()]
    with pytest.raises(ZeroDivisionError):
        mrc.optimize_all(surface, [ring[7]], progress=lambda _: 1 // 0)


# ---- bad input


def bad(**change):
    mesh, ring = two_grooves()
    arguments = {"contours": [ring[7], ring[17]], "options": mrc.Options(width=2)} | change
    return mrc.optimize_all(surface_of(mesh), **arguments)


@pytest.mark.parametrize(
    ("change", "message"),
    {
        "no edge": ({"contours": [24 * 7 + np.arange(24), np.array([0, 5, 9])]}, "^contour 1: .*0 and 5"),
        "two bad contours": ({"contours": [np.array([0, 7, 9]), np.array([0, 5, 9])]}, "^contour 0: .*0 and 7"),
        "out of range": ({"contours": [np.array([0, 1, 9999])]}, "9999"),
        "too few closed": ({"closed": [True]}, "closed has 1 entries for 2"),
        "too many scales": ({"scales": [None, None, None]}, "scales has 3 entries for 2"),
        "too few required": ({"required_vertices": [[3]]}, "required_vertices has 1 entries for 2"),
        "too few edges": ({"required_edges": [[(3, 4)], [], []]}, "required_edges has 3 entries for 2"),
        "required out of reach": ({"required_vertices": [[], [3]]}, "^contour 1: required vertex 3 "),
        "density": ({"region_density": np.ones(3)}, "^contour 0: .*3 entries"),
    }.values(),
)
def test_errors_name_the_contour(change, message):
    with pytest.raises(ValueError, match=message):
        bad(**change)


def test_wrong_types_are_refused():
    for change in ({"contours": [None]}, {"contours": 3}, {"scales": [3, 4]}, {"required_vertices": [["a"], []]}):
        with pytest.raises((TypeError, ValueError)):
            bad(**change)
    with pytest.raises(ValueError, match="threads"):
        mrc.Options(threads=-1)


@pytest.mark.parametrize("seed", range(0, 64, 2))
def test_edge_between_two_shared_points_is_closed_to_both_contours(seed):
    """Where two given contours part and meet again, both might take the edge between the two vertices."""
    rng = np.random.default_rng(seed)
    mesh = meshes.tube(1 + 0.4 * rng.random(11), 8, step=0.5, rng=rng, split_fraction=1.0, noise=0.1)
    given = [np.array(meshes.zigzag_contour(rng, 8, 4, 6, 0.9)) for _ in range(2)]
    results = mrc.optimize_all(surface_of(mesh), given, options=mrc.Options(iterations=2, width=2))
    one, two = (edges_of(result.vertices) for result in results)
    assert one & two <= edges_of(given[0]) & edges_of(given[1])


def edges_of(ring):
    return {tuple(sorted(pair)) for pair in zip(ring.tolist(), np.roll(ring, -1).tolist(), strict=True)}
