# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's sorting of selected edges into loops, chains and branching pieces, without Blender."""

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
edge_paths = importlib.import_module("addon.core.edge_paths")


def edges_of(pieces):
    """Return the edges of all pieces together, as a sorted list of sorted pairs."""
    return sorted(tuple(sorted(map(int, pair))) for piece in pieces for pair in piece)


def loop_edges(vertices):
    return np.column_stack([vertices, np.roll(vertices, -1)])


@pytest.mark.parametrize("count", [3, 4, 17, 1000])
def test_a_shuffled_loop_comes_back_in_order(rng, count):
    vertices = rng.choice(10 * count, count, replace=False)
    edges = rng.permuted(rng.permutation(loop_edges(vertices)), axis=1)
    found = edge_paths.sort_edges(edges)
    assert (found.chains, found.branching) == ([], [])
    (loop,) = found.loops
    assert loop[0] == vertices.min()
    assert loop[1] < loop[-1]
    assert edges_of([edge_paths.contour_edges(loop)]) == edges_of([loop_edges(vertices)])


@pytest.mark.parametrize("count", [2, 3, 50])
def test_a_shuffled_chain_comes_back_from_its_lower_end(rng, count):
    vertices = rng.choice(10 * count, count, replace=False)
    edges = rng.permutation(loop_edges(vertices)[:-1])
    found = edge_paths.sort_edges(edges)
    assert (found.loops, found.branching) == ([], [])
    expected = vertices if vertices[0] < vertices[-1] else vertices[::-1]
    np.testing.assert_array_equal(found.chains[0], expected)
    np.testing.assert_array_equal(edge_paths.contour_edges(found.chains[0], closed=False)[:, 1], expected[1:])


def test_pieces_are_separated_and_no_edge_is_lost(rng):
    for _ in range(50):
        edges = np.unique(np.sort(rng.integers(0, 60, (45, 2)), axis=1), axis=0)
        edges = edges[edges[:, 0] != edges[:, 1]]
        found = edge_paths.sort_edges(edges)
        pieces = [edge_paths.contour_edges(loop) for loop in found.loops]
        pieces += [edge_paths.contour_edges(chain, closed=False) for chain in found.chains]
        pieces += found.branching
        assert edges_of(pieces) == edges_of([edges])
        vertex_sets = [set(np.unique(piece)) for piece in pieces]
        assert sum(map(len, vertex_sets)) == len(set().union(*vertex_sets))
        assert all(len(edge_paths.branch_vertices(piece)) for piece in found.branching)


@pytest.mark.parametrize(
    ("edges", "branches"),
    [
        ([(0, 1), (1, 2), (2, 0), (2, 3)], [2]),  # a loop with a tail
        ([(0, 1), (1, 2), (2, 0), (2, 3), (3, 4), (4, 2)], [2]),  # two loops that touch
        ([(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)], [0, 2]),  # a loop with a chord
    ],
)
def test_branching_pieces_name_their_vertices(edges, branches):
    found = edge_paths.sort_edges(edges)
    assert (found.loops, found.chains) == ([], [])
    assert edge_paths.branch_vertices(found.branching[0]).tolist() == branches


def test_nothing_selected():
    found = edge_paths.sort_edges(np.empty((0, 2), dtype=np.int32))
    assert (found.loops, found.chains, found.branching) == ([], [], [])


def grid_border(selected, hidden=()):
    """Return the region border on a 3 x 3 grid of quads, as sorted vertex pairs of its 4 x 4 vertices."""
    faces = [[4 * y + x, 4 * y + x + 1, 4 * y + x + 5, 4 * y + x + 4] for y in range(3) for x in range(3)]
    pairs = [tuple(sorted(pair)) for face in faces for pair in zip(face, face[1:] + face[:1])]
    edges = sorted(set(pairs))
    corner_edges = np.array([edges.index(pair) for pair in pairs])
    masks = [np.isin(np.arange(9), ids) for ids in (selected, hidden)]
    border = edge_paths.region_border(np.arange(0, 37, 4), corner_edges, *masks, len(edges))
    return [edges[edge] for edge in border]


def test_the_border_of_selected_faces():
    assert grid_border([4]) == [(5, 6), (5, 9), (6, 10), (9, 10)]
    assert grid_border([0]) == [(1, 5), (4, 5)]
    assert grid_border(range(9)) == grid_border([]) == []


def test_hidden_faces_count_as_missing():
    assert grid_border([4], hidden=[5]) == [(5, 6), (5, 9), (9, 10)]


def test_a_loop_takes_the_direction_of_its_edges(rng):
    for _ in range(20):
        vertices = rng.choice(100, 9, replace=False)
        edges = rng.permutation(loop_edges(vertices))
        (loop,) = edge_paths.sort_edges(edges).loops
        turned = edge_paths.along(loop, edges)
        assert {tuple(pair) for pair in loop_edges(turned).tolist()} == {tuple(pair) for pair in edges.tolist()}


def test_a_chain_takes_the_direction_of_its_edges(rng):
    for _ in range(20):
        vertices = rng.choice(100, 9, replace=False)
        edges = rng.permutation(loop_edges(vertices)[:-1])
        (chain,) = edge_paths.sort_edges(edges).chains
        np.testing.assert_array_equal(edge_paths.along(chain, edges, closed=False), vertices)


def test_common_edges_in_either_direction():
    edges = np.array([[1, 2], [3, 2], [3, 4]])
    assert edge_paths.common_edges(edges, [[2, 3], [9, 4]]).tolist() == [[3, 2]]
    assert edge_paths.common_edges(edges, np.empty((0, 2))).tolist() == []


GRID = np.array([(x, y, 0.0) for y in range(4) for x in (-2, -1, 0, 1, 2)])  # vertex 5 y + x + 2
GRID_EDGES = np.array([(v, v + 1) for v in range(20) if v % 5 < 4] + [(v, v + 5) for v in range(15)])


def as_set(edges):
    return {frozenset(pair) for pair in np.asarray(edges).tolist()}


def test_mirror_images_are_added_in_reverse():
    edges = np.array([[3, 4], [4, 9]])
    assert edge_paths.with_mirror_images(edges, GRID, GRID_EDGES).tolist() == [[3, 4], [4, 9], [0, 1], [5, 0]]


def test_a_half_on_the_mirror_plane_becomes_whole():
    half = np.array([[2, 3], [3, 8], [8, 7]])
    both = edge_paths.with_mirror_images(half, GRID, GRID_EDGES)
    assert len(edge_paths.sort_edges(both).loops) == 1


def test_a_symmetric_selection_is_unchanged():
    both = edge_paths.with_mirror_images(np.array([[0, 1], [3, 4], [2, 7]]), GRID, GRID_EDGES)
    assert as_set(both) == {frozenset(pair) for pair in ((0, 1), (3, 4), (2, 7))}
    assert len(both) == 3


def test_an_asymmetric_mesh_has_no_images():
    edges = np.array([[3, 4]])
    moved = GRID + np.where(np.arange(20) == 0, 0.01, 0.0)[:, None]
    assert edge_paths.with_mirror_images(edges, moved, GRID_EDGES) is None
    fewer = GRID_EDGES[[tuple(pair) != (0, 1) for pair in GRID_EDGES.tolist()]]
    assert edge_paths.with_mirror_images(edges, GRID, fewer) is None


def test_images_that_would_make_a_contour_branch_are_refused():
    assert edge_paths.with_mirror_images(np.array([[1, 2], [2, 7]]), GRID, GRID_EDGES) is None
