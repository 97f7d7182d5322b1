# SPDX-License-Identifier: GPL-3.0-or-later
"""A Contour is a value and stands wherever vertices do; results have its length, and bands its sides."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

SECTIONS, AROUND = 9, 8
TUBE = meshes.tube(1 + 0.1 * np.cos(np.arange(SECTIONS)), AROUND)
RING = AROUND * 4 + np.arange(AROUND)
ALONG = AROUND * np.arange(2, 7)


def surface():
    return surface_of(TUBE)


def across():
    return mrc.optimize(surface(), RING, options=mrc.Options(refinement=2, max_turn=3.0))


def test_a_contour_has_what_it_was_made_of():
    contour = mrc.Contour(RING, closed=False)
    assert contour.vertices.tolist() == RING.tolist()
    assert contour.edge_vertices.tolist() == [[v, v] for v in RING]
    assert not contour.edge_parameters.any()
    assert contour.closed is False
    assert len(contour) == len(RING)
    assert repr(contour) == "<mrcontour.Contour: open, 8 points>"


def test_equal_contours_have_equal_hashes():
    assert mrc.Contour(RING) == mrc.Contour(list(RING)) == mrc.Contour(mrc.Contour(RING), closed=False)
    assert len({mrc.Contour(RING), mrc.Contour(list(RING))}) == 1
    points = {"edge_vertices": [[0, 1], [1, 2]]}
    zero, minus_zero = (mrc.Contour(**points, edge_parameters=[0.5, t]) for t in (0.0, -0.0))
    assert zero == minus_zero
    assert hash(zero) == hash(minus_zero)


@pytest.mark.parametrize("other", [mrc.Contour(RING, closed=False), mrc.Contour(RING[::-1]), mrc.Contour([]), 3, None])
def test_contours_that_differ_are_not_equal(other):
    assert mrc.Contour(RING) != other


def test_a_result_gives_its_contour():
    result = across()
    contour = result.contour
    assert contour == mrc.Contour(result)
    assert contour == mrc.Contour(edge_vertices=result.edge_vertices, edge_parameters=result.edge_parameters)
    assert contour.vertices.tolist() == result.vertices.tolist()
    assert len(contour) == len(result.positions)
    assert result.scales.given_contour == mrc.Contour(RING)


USES = {
    "optimize": lambda given, **how: mrc.optimize(surface(), given, **how).edge_parameters,
    "optimize_all": lambda given, **how: mrc.optimize_all(surface(), [given], **how)[0].edge_parameters,
    "measure": lambda given, **how: mrc.measure(surface(), given, **how).ratio,
    "band": lambda given, **how: mrc.band(surface(), given, **how),
    "search_space": lambda given, **how: mrc.search_space(surface(), given, **how)["f"],
}


@pytest.mark.parametrize("use", USES)
@pytest.mark.parametrize("closed", [True, False])
def test_a_contour_stands_for_its_vertices_and_closed(use, closed):
    vertices = RING if closed else ALONG
    expected = USES[use](vertices, closed=closed)
    assert np.array_equal(USES[use](mrc.Contour(vertices, closed)), expected)
    assert np.array_equal(USES[use](mrc.Contour(vertices, closed), closed=not closed), expected)


@pytest.mark.parametrize("use", USES)
def test_a_contour_across_faces_stands_for_its_result(use):
    result = across()
    assert np.array_equal(USES[use](result.contour), USES[use](result))


def test_an_open_contour_is_closed_and_gives_an_array():
    chain = RING[:5]
    expected = mrc.close_contour(surface(), chain)
    assert isinstance(expected, np.ndarray)
    assert np.array_equal(mrc.close_contour(surface(), mrc.Contour(chain, closed=False)), expected)
    with pytest.raises(ValueError, match="closed already"):
        mrc.close_contour(surface(), mrc.Contour(chain))


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("refinement", [0, 2])
def test_length_is_that_of_the_segments(closed, refinement):
    given = RING if closed else ALONG
    for progress in (None, lambda share: share < 0.3):
        result = mrc.optimize(surface(), given, closed, mrc.Options(refinement=refinement), progress=progress)
        points = result.positions
        ends = np.roll(points, -1, axis=0) if closed else points[1:]
        segments = np.linalg.norm(ends - points[: len(ends)], axis=1)
        assert result.length == pytest.approx(segments.sum(), rel=1e-12)


def test_sides_part_the_band_of_a_ring_by_height():
    faces, sides = mrc.band(surface(), RING, sides=True)
    assert sides.dtype == np.int8
    assert np.array_equal(faces, mrc.band(surface(), RING))
    below = faces < AROUND * 4
    assert set(sides[below]) | set(sides[~below]) == {1, -1}
    assert len(set(sides[below])) == len(set(sides[~below])) == 1
    other_way = mrc.band(surface(), RING[::-1], sides=True)
    assert np.array_equal(other_way[0], faces)
    assert np.array_equal(other_way[1], -sides)


def test_sides_agree_with_those_of_the_vertices(realistic):
    _, mesh, loop = realistic
    options = mrc.Options(width=3)
    faces, sides = mrc.band(surface_of(mesh), loop, options=options, sides=True)
    space = mrc.search_space(surface_of(mesh), loop, options=options)
    side_of = dict(zip(space["vertices"].tolist(), space["side"].tolist()))
    _, offsets, corners = mesh.arguments()[:3]
    assert set(sides) <= {1, -1}
    for face, side in zip(faces, sides):
        found = {side_of[v] for v in corners[offsets[face] : offsets[face + 1]].tolist()}
        assert found <= {side, 0}


def test_beyond_the_ends_of_an_open_contour_there_is_no_side():
    mesh = meshes.icosphere(3)
    walk = mrc.close_contour(surface_of(mesh), _walk(mesh, 6))[:6]
    faces, sides = mrc.band(surface_of(mesh), walk, closed=False, sides=True)
    assert set(sides) == {1, 0, -1}
    turned, opposite = mrc.band(surface_of(mesh), walk[::-1], closed=False, sides=True)
    assert np.array_equal(turned, faces)
    assert np.array_equal(opposite, -sides)


def _walk(mesh, count):
    """Vertices along edges, each the neighbor farthest along an axis."""
    triangles = np.asarray(mesh.arguments()[2]).reshape(-1, 3)
    walk = [int(np.argmin(mesh.positions[:, 0]))]
    while len(walk) < count:
        beside = np.setdiff1d(triangles[(triangles == walk[-1]).any(axis=1)], walk)
        walk.append(int(beside[np.argmax(mesh.positions[beside, 0])]))
    return walk
