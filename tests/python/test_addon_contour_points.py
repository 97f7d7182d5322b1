# SPDX-License-Identifier: GPL-3.0-or-later
"""Merging points of contours with vertices: how far they move, and that no contour starts to touch another."""

import importlib
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
contour_points = importlib.import_module("addon.core.contour_points")


def contour(*points):
    """Return points from (a, b, t), each segment in its own face."""
    return contour_points.contour_points(
        SimpleNamespace(
            edge_vertices=np.array([point[:2] for point in points]),
            edge_parameters=np.array([point[2] for point in points]),
            segment_faces=np.arange(len(points)),
        )
    )


def places(points):
    return [point.place for point in points]


def merged(*contours, closed=True, fraction=0.3):
    flags = [closed] * len(contours)
    return [places(points) for points in contour_points.merge_points(list(contours), flags, fraction)]


FAR = [(1, 2, 0.5), (2, 3, 0.5), (3, 4, 0.5)]


def test_a_point_has_a_unique_representation():
    assert places(contour((5, 2, 0.25), (3, 3, 0.0), (7, 4, 1.0))) == [(2, 5, 0.75), (3, 3, 0.0), (4, 4, 0.0)]


def test_points_farther_than_the_fraction_stay():
    assert merged(contour((1, 2, 0.31), *FAR[1:])) == [[(1, 2, 0.31), *FAR[1:]]]


@pytest.mark.parametrize("t", [0.1, 0.3, 0.71, 0.95])
def test_a_near_point_moves_to_the_nearer_end(t):
    vertex = 8 if t < 0.5 else 9
    assert merged(contour((8, 9, t), *FAR)) == [[(vertex, vertex, 0.0), *FAR]]


def test_points_around_one_vertex_merge_and_keep_the_last_segment():
    given = contour(FAR[0], (8, 9, 0.1), (8, 10, 0.1), (8, 11, 0.1), *FAR[1:])
    (result,) = contour_points.merge_points([given], [True], 0.3)
    assert places(result) == [FAR[0], (8, 8, 0.0), *FAR[1:]]
    assert [point.face for point in result] == [0, 3, 4, 5]


def test_a_run_across_the_start_of_a_closed_contour_is_one_run():
    assert merged(contour((8, 9, 0.1), *FAR, (8, 10, 0.1))) == [[(8, 8, 0.0), *FAR]]
    apart = contour((8, 9, 0.1), *FAR, (8, 10, 0.1))
    assert merged(apart, closed=False) == [places(apart)]


def test_a_contour_that_passes_a_vertex_twice_is_not_pinched():
    given = contour((8, 9, 0.1), *FAR[:2], (8, 10, 0.1), FAR[2])
    assert merged(given) == [places(given)]


def test_two_contours_do_not_start_to_touch():
    one, two = contour((8, 9, 0.1), *FAR), contour((8, 10, 0.1), (5, 6, 0.5), (6, 7, 0.5))
    assert merged(one, two) == [places(one), places(two)]


def test_contours_that_end_at_one_vertex_do_not_block_points_there():
    one, two = contour((8, 8, 0.0), (8, 9, 0.1), *FAR), contour((8, 8, 0.0), (8, 10, 0.1), (5, 6, 0.5), (6, 7, 0.5))
    assert merged(one, two, closed=False) == [[(8, 8, 0.0), *FAR], [(8, 8, 0.0), (5, 6, 0.5), (6, 7, 0.5)]]


def test_a_protected_vertex_is_touched_only_by_contours_that_touched_it_before():
    off, on = contour((8, 9, 0.1), *FAR), contour((8, 8, 0.0), (8, 9, 0.1), *FAR)
    for given, expected in ((off, places(off)), (on, [(8, 8, 0.0), *FAR])):
        (result,) = contour_points.merge_points([given], [True], 0.3, protected={8})
        assert places(result) == expected


def test_a_chain_does_not_fold_onto_one_edge():
    given = contour((8, 8, 0.0), (8, 9, 0.1), (7, 9, 0.1), (7, 7, 0.0))
    assert merged(given, closed=False) == [places(given)]


def test_a_small_loop_does_not_vanish():
    given = contour((8, 9, 0.1), (8, 10, 0.1), (8, 11, 0.1))
    assert merged(given) == [places(given)]


def test_repeated_points_are_dropped():
    assert merged(contour(FAR[0], *FAR, FAR[2])) == [FAR]
    assert merged(contour(*FAR, FAR[2]), closed=False) == [FAR]


def test_no_point_stays_on_an_unsplittable_edge():
    """It moves to the end that the contour visits next to it, even if the other end is nearer."""
    near, far = contour((8, 8, 0.0), (8, 9, 0.9), *FAR), contour((8, 9, 0.9), *FAR)
    for given, vertex in ((near, 8), (far, 9)):
        (result,) = contour_points.merge_points([given], [True], 0.0, {(8, 9)})
        assert places(result) == [(vertex, vertex, 0.0), *FAR]


def test_points_along_an_edge_are_dropped():
    def along(*points, closed=True):
        return places(contour_points.without_points_along_edges(contour(*points), closed))

    assert along((7, 7, 0), (7, 8, 0.3), (7, 8, 0.6), (8, 8, 0), *FAR) == [(7, 7, 0.0), (8, 8, 0.0), *FAR]
    assert along((7, 8, 0.3), (7, 8, 0.6), (8, 8, 0), *FAR) == [(7, 8, 0.3), (8, 8, 0.0), *FAR]
    assert along((7, 8, 0.3), (7, 8, 0.6), *FAR, closed=False) == [(7, 8, 0.3), (7, 8, 0.6), *FAR]
    assert along((7, 8, 0.6), *FAR, (8, 8, 0), closed=False) == [(7, 8, 0.6), *FAR, (8, 8, 0.0)]
