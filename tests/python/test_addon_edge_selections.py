# SPDX-License-Identifier: GPL-3.0-or-later
"""Selected edges as loops and chains: spurs, doubled and thick rings, and what is not clear."""

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
edge_selections = importlib.import_module("addon.core.edge_selections")
faces_module = importlib.import_module("addon.core.faces")
edge_paths = importlib.import_module("addon.core.edge_paths")
dashes_module = importlib.import_module("addon.core.dashes")

COLUMNS, ROWS = 24, 41


def at(row, column):
    return row * COLUMNS + column % COLUMNS


def ring(row, columns=range(COLUMNS)):
    return [(at(row, i), at(row, i + 1)) for i in columns]


def column(i, rows):
    return [(at(row, i), at(row + 1, i)) for row in rows]


def make_faces(points, faces):
    pairs = [(one, other) for corners in faces for one, other in zip(corners, corners[1:] + corners[:1])]
    edges, numbers = {}, []
    for pair in pairs:
        numbers.append(edges.setdefault(frozenset(pair), len(edges)))
    return faces_module.Faces(
        np.array(points, dtype=float),
        np.array([sorted(edge) for edge in edges]),
        np.cumsum([0, *map(len, faces)]),
        np.concatenate(faces),
        np.array(numbers),
        np.array([], dtype=int),
    )


def tube():
    """Make a tube along z that is narrowest at row 20."""
    angles = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
    radii = 1 - 0.3 * np.exp(-4 * np.linspace(-2, 2, ROWS) ** 2)
    points = [(r * np.cos(a), r * np.sin(a), z) for r, z in zip(radii, np.linspace(-2, 2, ROWS)) for a in angles]
    quads = [
        (at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row + 1, i))
        for row in range(ROWS - 1)
        for i in range(COLUMNS)
    ]
    return make_faces(points, quads)


TUBE = tube()


def read(*edge_lists):
    edges = sorted({tuple(sorted(edge)) for edges in edge_lists for edge in edges})
    return edge_selections.read_edges(np.array(edges), lambda: TUBE)


def edge_set(contour):
    return {frozenset(edge) for edge in edge_paths.contour_edges(contour.vertices, contour.closed).tolist()}


def as_set(edges):
    return {frozenset(edge) for edge in edges}


def test_simple_loops_and_chains_need_no_faces():
    found = edge_selections.read_edges(np.array(ring(5) + ring(9, range(7))), None)
    loop, chain = found.contours
    assert (loop.closed, chain.closed) == (True, False)
    assert edge_set(loop) == as_set(ring(5))
    assert not found.left_out


def test_spurs_are_left_out():
    found = read(ring(12), column(3, range(9, 12)), column(9, range(12, 14)), ring(14, [9, 10]))
    (loop,) = found.contours
    assert loop.closed
    assert edge_set(loop) == as_set(ring(12))
    assert found.left_out == {"spur": 2}
    assert as_set(loop.beside.tolist()) == as_set(column(3, range(9, 12)) + column(9, [12, 13]) + ring(14, [9, 10]))


def test_spurs_of_a_chain_are_left_out():
    found = read(ring(12, range(14)), column(5, [12, 13]), column(8, [10, 11]))
    (chain,) = found.contours
    assert not chain.closed
    assert edge_set(chain) == as_set(ring(12, range(14)))
    assert found.left_out == {"spur": 2}


@pytest.mark.parametrize("rungs", [range(COLUMNS), [3], [0, 1, 11, 17]])
@pytest.mark.parametrize("row", [12, 26])
def test_of_a_doubled_ring_the_shorter_one_is_taken(row, rungs):
    found = read(ring(row), ring(row + 1), *(column(i, [row]) for i in rungs))
    (loop,) = found.contours
    assert edge_set(loop) == as_set(ring(row + 1 if row < 20 else row))
    assert set(found.left_out) == {"doubled edge"}
    assert found.left_out["doubled edge"] == COLUMNS + len(rungs)


def test_of_a_thick_ring_the_shortest_loop_is_taken(rng):
    """Some edges of the ribbon are missing, and its rims are ragged."""
    ribbon = [edge for row in range(10, 15) for edge in ring(row)]
    ribbon += [edge for i in range(COLUMNS) for edge in column(i, range(10, 14))]
    found = read(ribbon)
    assert edge_set(found.contours[0]) == as_set(ring(14))
    ragged = [edge for edge in ribbon if rng.random() < 0.85 or edge in ring(12)]
    found = read(ragged)
    (loop,) = found.contours
    assert loop.closed
    graph = edge_selections.EdgeGraph(ragged, TUBE.lengths(TUBE.find_edges(np.array(ragged))).tolist())
    assert len(graph.around) > COLUMNS
    length = TUBE.lengths(TUBE.find_edges(edge_paths.contour_edges(loop.vertices))).sum()
    assert length <= TUBE.lengths(TUBE.find_edges(np.array(ring(12)))).sum() + 1e-12


def test_a_ring_with_a_doubled_stretch_is_one_loop():
    found = read(ring(12), ring(13, range(4, 9)), column(4, [12]), column(9, [12]))
    (loop,) = found.contours
    assert as_set(ring(12, [*range(4), *range(9, COLUMNS)])) <= edge_set(loop)
    assert found.left_out["doubled edge"]


def test_of_a_thick_chain_the_path_between_its_ends_is_taken():
    found = read(ring(12, range(12)), ring(13, range(12)), *(column(i, [12]) for i in range(13)))
    (chain,) = found.contours
    assert not chain.closed
    columns = {vertex % COLUMNS for vertex in chain.vertices.tolist()}
    assert columns == set(range(13))
    assert found.left_out["doubled edge"]


@pytest.mark.parametrize(
    "edges",
    [
        ring(12, range(10)) + column(5, range(12, 19)),  # three arms of like length
        ring(12) + column(3, range(5, 12)) + column(3, range(12, 30)),  # a long tail
        ring(6) + ring(30) + column(0, range(6, 30)),  # two rings
        ring(12, range(9))
        + ring(25, range(9))
        + column(0, range(12, 25))
        + column(9, range(12, 25))
        + ring(18, range(9)),
    ],
)
def test_what_is_not_clear_is_given_back_whole(edges):
    found = read(edges)
    assert not found.contours
    assert as_set(found.branching[0].tolist()) == as_set(edges)


def test_all_edges_of_a_mesh_are_not_clear():
    found = read(TUBE.edges.tolist())
    assert len(found.branching) == 1
    assert not found.contours


@pytest.mark.parametrize("row", [0, ROWS - 3])
def test_of_a_thick_ring_at_the_border_of_the_mesh_no_loop_along_the_border_is_taken(row):
    edges = [edge for i in range(3) for edge in ring(row + i)] + [
        e for i in range(COLUMNS) for e in column(i, [row, row + 1])
    ]
    (loop,) = read(edges).contours
    assert edge_set(loop) in (as_set(ring(row + i)) for i in range(3) if row + i not in (0, ROWS - 1))


def test_a_loop_around_something_long_and_thin_stays_a_loop():
    around = ring(20, range(2, 12)) + ring(22, range(2, 12)) + column(2, [20, 21]) + column(12, [20, 21])
    (contour,) = read(around, column(5, [22, 23])).contours
    assert contour.closed
    assert edge_set(contour) == as_set(around)


def test_a_loop_that_is_doubled_along_a_stretch_stays_a_loop():
    around = ring(15, range(2, 12)) + ring(25, range(2, 12)) + column(2, range(15, 25)) + column(12, range(15, 25))
    (contour,) = read(around, ring(26, [4, 5]) + column(4, [25]) + column(6, [25])).contours
    assert contour.closed
    assert as_set(around) - edge_set(contour) <= as_set(ring(25, [4, 5]))


def test_each_piece_is_read_by_itself():
    found = read(ring(8), column(0, [8, 9]), ring(30), ring(31), column(5, [30]), ring(15), ring(20, range(5)))
    closed = [contour.closed for contour in found.contours]
    assert closed == [True, True, True, False]
    assert {frozenset(edge_set(contour)) for contour in found.contours} == {
        frozenset(as_set(edges)) for edges in (ring(8), ring(15), ring(30), ring(20, range(5)))
    }
    assert found.left_out == {"spur": 1, "doubled edge": COLUMNS + 1}


def test_order_and_direction_of_the_edges_change_nothing(rng):
    edges = np.array(ring(12) + ring(13) + column(3, [12, 11]) + column(9, [12]) + ring(20, range(8)))
    expected = edge_selections.read_edges(edges, lambda: TUBE)
    for _ in range(5):
        shuffled = rng.permuted(rng.permutation(edges), axis=1)
        found = edge_selections.read_edges(shuffled, lambda: TUBE)
        assert [c.vertices.tolist() for c in found.contours] == [c.vertices.tolist() for c in expected.contours]
        assert found.left_out == expected.left_out


# ---- dashes


def dashes(row, *stretches):
    return [np.array([at(row, i) for i in range(first, last + 1)]) for first, last in stretches]


def join(chains, others=(), **more):
    return dashes_module.join(chains, others, lambda: TUBE, **more)


@pytest.mark.parametrize(("count", "length"), [(12, 1), (8, 1), (6, 2), (4, 4), (4, 3), (3, 4)])
def test_dashes_round_a_limb_make_one_loop(rng, count, length):
    """Whatever their order and directions."""
    step = COLUMNS // count
    chains = dashes(15, *((i * step, i * step + length) for i in range(count)))
    chains = [chains[i][:: rng.choice([-1, 1])] for i in rng.permutation(count)]
    ((found,), alone) = join(chains)
    assert (found.closed, alone, len(found.dashes)) == (True, [], count)
    assert edge_set(found) == as_set(ring(15))
    assert found.vertices[0] == at(15, 0)


def test_dashes_of_two_loops_make_two():
    chains = dashes(10, *((i, i + 2) for i in range(0, COLUMNS, 4)))
    chains += dashes(20, *((i, i + 3) for i in range(0, COLUMNS, 6)))
    found, alone = join(chains)
    assert not alone
    assert [edge_set(contour) for contour in found] == [as_set(ring(10)), as_set(ring(20))]


@pytest.mark.parametrize(
    "chains",
    [
        dashes(10, (0, 9)) + dashes(11, (0, 9)),  # beside each other
        dashes(10, (0, 3)) + dashes(10, (12, 15)),  # far apart
        dashes(10, (0, 3), (5, 8), (10, 13)),  # in a row, but not all round
        dashes(5, (0, 5)) + dashes(30, (0, 5)),
    ],
)
def test_other_chains_stay_apart(chains):
    assert join(chains) == ([], list(range(len(chains))))


def test_dashes_in_a_row_are_one_chain_if_chains_are_to_be_closed():
    ((found,), alone) = join(dashes(10, (0, 3), (5, 8), (10, 13)) + dashes(30, (3, 5)), chains_too=True)
    assert (found.closed, alone) == (False, [3])
    assert found.vertices.tolist() == [at(10, i) for i in range(14)]


def test_joints_keep_off_other_contours():
    """A contour lies across a gap of two edges; the path around it would be too long, or crosses it."""
    chains = dashes(15, *((i * 6, i * 6 + 4) for i in range(4)))
    across = [at(row, 5) for row in range(5, 25)]
    assert join(chains, across) == ([], [0, 1, 2, 3])


def test_random_selections_are_read_whole_and_in_any_order(rng):
    """Every edge is in a contour, beside it or given back, and all contours are simple."""
    for _ in range(40):
        count = int(rng.integers(1, 4))
        rows = rng.choice(np.arange(2, 38, 6), count, replace=False)
        edges = [edge for row in rows.tolist() for edge in ring(row) + ring(row + 1)]
        edges += [edge for row in rows.tolist() for i in range(COLUMNS) for edge in column(i, [row])]
        edges = np.array([edge for edge in edges if rng.random() < rng.choice([0.5, 0.8, 0.95])]).reshape(-1, 2)
        found = edge_selections.read_edges(edges, lambda: TUBE)
        again = edge_selections.read_edges(rng.permuted(rng.permutation(edges), axis=1), lambda: TUBE)
        assert [c.vertices.tolist() for c in found.contours] == [c.vertices.tolist() for c in again.contours]
        held = set()
        for contour in found.contours:
            assert len(set(contour.vertices.tolist())) == len(contour.vertices)
            held |= edge_set(contour) | as_set(contour.beside.tolist())
        for piece in found.branching:
            held |= as_set(piece.tolist())
        assert held >= as_set(edges.tolist())
