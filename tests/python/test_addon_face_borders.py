# SPDX-License-Identifier: GPL-3.0-or-later
"""The borders of selected faces: walked, split where they touch themselves, and without stray pieces."""

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
face_borders = importlib.import_module("addon.core.face_borders")

N = 12  # quads along each side of the sheet


def vertex(x, y):
    return y * (N + 1) + x


def face(x, y):
    return y * N + x


SHEET = [(vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)) for y in range(N) for x in range(N)]
POINTS = np.array([(x, y, 0.0) for y in range(N + 1) for x in range(N + 1)])


def arrays(faces, points, selected, hidden=()):
    pairs = [(one, other) for corners in faces for one, other in zip(corners, corners[1:] + corners[:1])]
    edges, numbers = {}, []
    for pair in pairs:
        numbers.append(edges.setdefault(frozenset(pair), len(edges)))
    return face_borders.FaceSelection(
        points,
        np.array([sorted(edge) for edge in edges]),
        np.cumsum([0, *map(len, faces)]),
        np.concatenate(faces),
        np.array(numbers),
        np.array(hidden, dtype=int),
        np.isin(np.arange(len(faces)), list(selected)),
    )


def borders(selected, hidden=(), faces=SHEET, points=POINTS):
    return arrays(faces, points, selected, hidden).borders()


def block(left, low, right, high):
    return {face(x, y) for x in range(left, right) for y in range(low, high)}


def area_to_the_left(loop):
    """Return the signed area that a loop on the sheet encloses."""
    x, y, _ = POINTS[loop].T
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


def test_one_block_has_one_loop_with_the_faces_to_its_left():
    found = borders(block(2, 2, 6, 5))
    (loop,) = found.loops
    assert not found.chains
    assert (len(loop), loop[0], area_to_the_left(loop)) == (14, vertex(2, 2), 12)


def test_a_hole_is_walked_the_other_way_round():
    areas = [area_to_the_left(loop) for loop in borders(block(1, 1, 11, 11) - block(4, 4, 8, 8)).loops]
    assert areas == [100, -16]


def test_a_block_at_the_border_of_the_mesh_has_a_chain_from_border_to_border():
    (chain,) = borders(block(0, 0, 5, 12)).chains
    assert chain.tolist() == [vertex(5, y) for y in range(N + 1)]
    (chain,) = borders(block(5, 0, 12, 12)).chains
    assert chain.tolist() == [vertex(5, y) for y in range(N, -1, -1)]


def test_hidden_faces_end_a_border():
    assert len(borders(block(2, 2, 6, 5), hidden=[face(3, 5), face(6, 3)]).chains) == 2


def test_blocks_that_touch_at_a_vertex_are_loops_of_their_own():
    found = borders(block(1, 1, 5, 5) | block(5, 5, 9, 9))
    assert [area_to_the_left(loop) for loop in found.loops] == [16, 16]
    assert all(vertex(5, 5) in loop for loop in found.loops)


def test_a_border_that_touches_itself_is_split_into_simple_loops():
    """The hole shares a corner with what lies around the block."""
    found = borders(block(1, 1, 9, 9) - block(1, 1, 3, 3) - block(3, 3, 6, 6))
    assert sorted(area_to_the_left(loop) for loop in found.loops) == [-9, 60]
    assert all(len(set(loop.tolist())) == len(loop) for loop in found.loops)


def test_a_pinhole_at_a_pinch_is_filled_and_a_stray_island_is_left_out():
    selected = block(0, 0, 12, 8) - {face(5, 7)} - {face(6, 6)} | {face(2, 10)}
    found = borders(selected)
    assert not found.loops
    assert not found.branching
    (chain,) = found.chains
    assert len(chain) == N + 1 + 2
    assert (found.islands.tolist(), found.pinholes.tolist()) == ([face(2, 10)], [face(6, 6)])
    assert (found.island_count, found.pinhole_count) == (1, 1)


def test_a_hole_between_touching_islands_is_filled():
    """No loop around it remains, and the islands become one."""
    selected = block(0, 0, 12, 8) - {face(4, 4)}
    assert borders(selected).pinholes.tolist() == [face(4, 4)]


@pytest.mark.parametrize("size", [1, 2])
def test_pieces_of_equal_size_are_all_meant(size):
    """However many there are, and also if they are holes."""
    corners = [(x, y) for x in (1, 5, 9) for y in (1, 5, 9)]
    spots = set().union(*(block(x, y, x + size, y + size) for x, y in corners))
    assert len(borders(spots).loops) == 9
    assert len(borders(set(range(N * N)) - spots).loops) == 9
    assert borders(spots).island_count == 0


def test_a_small_selection_in_a_large_mesh_is_no_pinhole():
    assert [area_to_the_left(loop) for loop in borders({face(3, 3)}).loops] == [1]
    assert [area_to_the_left(loop) for loop in borders(set(range(N * N)) - {face(3, 3)}).loops] == [-1]


def test_the_area_counts_and_not_the_number_of_faces():
    """Cutting up an island or a hole changes nothing."""
    faces, selected = list(SHEET), block(0, 0, 12, 8) - {face(5, 5)}
    a, b, c, d = faces[face(5, 5)]
    faces[face(5, 5)] = (a, b, len(POINTS))
    faces += [(b, c, len(POINTS)), (c, d, len(POINTS)), (d, a, len(POINTS))]
    points = np.vstack([POINTS, POINTS[[a, b, c, d]].mean(axis=0)])
    found = borders(selected, faces=faces, points=points)
    assert found.pinhole_count == 1
    assert len(found.pinholes) == 4
    assert (len(found.loops), len(found.chains)) == (0, 1)


def test_numbering_changes_nothing(rng):
    selected = sorted(block(1, 1, 9, 9) - block(1, 1, 3, 3) - block(3, 3, 6, 6) | {face(10, 10)})
    expected = borders(selected)
    for _ in range(5):
        order, names = rng.permutation(len(SHEET)), rng.permutation(len(POINTS))
        faces = [tuple(names[list(np.roll(SHEET[i], rng.integers(4)))].tolist()) for i in order]
        points = np.empty_like(POINTS)
        points[names] = POINTS
        found = borders(np.flatnonzero(np.isin(order, selected)), faces=faces, points=points)
        loops = {frozenset(loop.tolist()) for loop in found.loops}
        assert loops == {frozenset(names[loop].tolist()) for loop in expected.loops}
        assert found.island_count == expected.island_count == 1


def test_random_selections_are_bounded_by_simple_loops_with_each_edge_once(rng):
    for _ in range(60):
        selected = np.flatnonzero(rng.random(N * N) < rng.choice([0.3, 0.5, 0.7]))
        selection = arrays(SHEET, POINTS, selected)
        found = face_borders._walked(selection, selection.selected)
        for contour in [*found.loops, *found.chains]:
            assert len(set(contour.tolist())) == len(contour)
        ends = [face_borders.edge_paths.contour_edges(loop) for loop in found.loops]
        ends += [face_borders.edge_paths.contour_edges(chain, closed=False) for chain in found.chains]
        walked = sorted(map(tuple, np.concatenate(ends).tolist()))
        border = selection.border(selection.selected)
        assert walked == sorted(map(tuple, selection.pairs(selection.directed(selection.selected, border)).tolist()))


def test_faces_that_do_not_fit_together_are_read_by_their_edges():
    faces = list(SHEET)
    faces[face(3, 2)] = faces[face(3, 2)][::-1]
    (loop,) = borders(block(2, 2, 6, 5), faces=faces).loops
    assert len(loop) == 14
