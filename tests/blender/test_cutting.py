# SPDX-License-Identifier: GPL-3.0-or-later
"""Cutting contours into faces: the path of the cut, the new faces, and the values of all layers."""

from itertools import pairwise

import bmesh
import numpy as np
import pytest
from contour_shapes import (
    add_attributes,
    cut_mesh,
    edges_by_ends,
    flat_area,
    plane_contours,
    positions,
    read_attribute,
    rough_plate,
    rough_sphere,
)
from made_meshes import GROOVE, grooved_cylinder, rough_loop
from minimum_ratio_contours import api

SEEDS = range(8)


def random_planes(seed, count):
    """Return planes at a distance from each other, as (normal, offset)."""
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=3)
    normal /= np.linalg.norm(normal)
    return [(normal, offset) for offset in np.sort(rng.uniform(-0.7, 0.7, count))]


def some_contours(obj, seed, count=3):
    if obj.name == "Plate":
        rng = np.random.default_rng(seed)
        normal = np.append(rng.normal(size=2), 0)
        planes = [(normal / np.linalg.norm(normal), offset) for offset in rng.uniform(-0.7, 0.7, count)]
    else:
        planes = random_planes(seed, count)
    contours = [contour for plane in planes for contour in plane_contours(obj, *plane)]
    assert contours
    return contours


def make(kind, seed):
    return rough_plate(seed) if kind == "plate" else rough_sphere(seed)


def distance_to_path(point, path):
    """Return the distance from a point to an (n, 3) polyline."""
    starts, steps = path[:-1], np.diff(path, axis=0)
    t = np.clip(((point - starts) * steps).sum(1) / np.maximum((steps**2).sum(1), 1e-30), 0, 1)
    return np.linalg.norm(starts + t[:, None] * steps - point, axis=1).min()


def mesh_points(obj):
    return np.array([vertex.co[:] for vertex in obj.data.vertices])


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", ["plate", "sphere"])
def test_the_cut_runs_along_edges_and_exactly_along_the_contour(kind, seed):
    obj = make(kind, seed)
    contours = some_contours(obj, seed)
    wanted = [positions(obj, contour) for contour in contours]
    chains = cut_mesh(obj, contours)
    edges = {frozenset(edge.vertices) for edge in obj.data.edges}
    points = mesh_points(obj)
    for chain, contour, targets in zip(chains, contours, wanted):
        ring = [*chain, chain[0]] if contour.closed else list(chain)
        assert all(frozenset(pair) in edges for pair in pairwise(ring))
        assert len(set(chain)) == len(chain)
        target_ring = np.vstack([targets, targets[:1]]) if contour.closed else targets
        assert max(distance_to_path(target, points[ring]) for target in targets) < 2e-5
        assert max(distance_to_path(points[vertex], target_ring) for vertex in chain) < 1e-6


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", ["plate", "sphere"])
def test_the_mesh_is_valid_after_a_cut(kind, seed):
    obj = make(kind, seed)
    chains = cut_mesh(obj, some_contours(obj, seed))
    assert sum(map(len, chains)) > 10
    assert not obj.data.validate(verbose=True)
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    assert max(edges_by_ends(bm).values()) == 1
    assert min(face.calc_area() for face in bm.faces) > 1e-9
    assert all(len(edge.link_faces) in (1, 2) for edge in bm.edges)


@pytest.mark.parametrize("seed", SEEDS)
def test_area_is_preserved(seed):
    """Only for planar faces: the area of a nonplanar polygon is not defined."""
    for obj in (rough_plate(seed), rough_sphere(seed, dissolve=0.0)):
        bm = bmesh.new()
        bm.from_mesh(obj.data)
        before = flat_area(bm)
        cut_mesh(obj, some_contours(obj, seed))
        bm.clear()
        bm.from_mesh(obj.data)
        assert flat_area(bm) == pytest.approx(before, rel=1e-6)


def linear(points):
    return 0.5 + points @ np.array([0.2, -0.15, 0.1])


@pytest.mark.parametrize("seed", SEEDS)
def test_layers_are_interpolated(seed):
    """Values that are linear in the positions stay so after the cut, on planar faces."""
    for obj in (rough_plate(seed), rough_sphere(seed, dissolve=0.0)):
        add_attributes(obj, linear)
        count = len(obj.data.vertices)
        cut_mesh(obj, some_contours(obj, seed))
        points = mesh_points(obj)
        assert len(points) > count
        corners = points[[loop.vertex_index for loop in obj.data.loops]]
        weights = [vertex.groups[0].weight for vertex in obj.data.vertices]
        np.testing.assert_allclose(weights, linear(points), atol=3e-6)
        np.testing.assert_allclose(
            [corner.uv[:] for corner in obj.data.uv_layers["UVMap"].data],
            np.repeat(linear(corners), 2).reshape(-1, 2),
            atol=3e-6,
        )
        for name, field, width, tolerance in (
            ("Heat", "value", 1, 3e-6),
            ("Wind", "vector", 3, 3e-6),
            ("Paint", "color", 4, 3e-6),
            ("Stretch", "vector", 2, 3e-6),
            ("Dust", "color", 4, 0.03),  # 8-bit values
        ):
            values = read_attribute(obj, name, field, width)
            expected = linear(corners if len(values) == len(corners) else points)
            np.testing.assert_allclose(values, np.repeat(expected, width).reshape(-1, width), atol=tolerance)
        moved = np.array([point.co[:] for point in obj.data.shape_keys.key_blocks["Moved"].data])
        np.testing.assert_allclose(moved, 2 * points + linear(points)[:, None], atol=1e-5)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("shape", ["triangles", "quads", "polygons"])
def test_corners_are_interpolated_like_vertices(shape, seed):
    """Also inside polygons that are not planar, where points lie on the diagonals of the triangulation."""
    obj = rough_sphere(seed, dissolve=1.0 if shape == "quads" else 0.0)
    if shape == "polygons":
        without_every_other_vertex(obj)
    corners = mesh_points(obj)[[loop.vertex_index for loop in obj.data.loops]]
    obj.data.uv_layers.new(name="UVMap").data.foreach_set("uv", corners[:, :2].ravel())
    colors = np.column_stack([corners, corners[:, 0]]).ravel()
    obj.data.attributes.new("Paint", "FLOAT_COLOR", "CORNER").data.foreach_set("color", colors)
    obj.data.attributes.new("Place", "FLOAT_VECTOR", "CORNER").data.foreach_set("vector", corners.ravel())
    count = len(obj.data.vertices)
    chains = cut_mesh(obj, some_contours(obj, seed))
    assert len(obj.data.vertices) > count
    assert max(map(max, chains)) == len(obj.data.vertices) - 1
    corners = mesh_points(obj)[[loop.vertex_index for loop in obj.data.loops]]
    np.testing.assert_allclose([corner.uv[:] for corner in obj.data.uv_layers[0].data], corners[:, :2], atol=3e-6)
    np.testing.assert_allclose(read_attribute(obj, "Paint", "color", 4)[:, :3], corners, atol=3e-6)
    np.testing.assert_allclose(read_attribute(obj, "Place", "vector", 3), corners, atol=3e-6)
    assert not obj.data.validate(verbose=True)


def without_every_other_vertex(obj):
    """Merge the faces around vertices, none of which are neighbors."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    taken, chosen = set(), []
    for vertex in bm.verts:
        around = {other for face in vertex.link_faces for other in face.verts}
        if not around & taken:
            chosen.append(vertex)
            taken |= around
    bmesh.ops.dissolve_verts(bm, verts=chosen)
    assert sum(len(face.verts) > 4 for face in bm.faces) >= 12
    bm.to_mesh(obj.data)
    bm.free()


@pytest.mark.parametrize("seed", SEEDS)
def test_pieces_inherit_marks(seed):
    """Halves of an edge keep its marks, new edges inside a face have none, and pieces of a face are like the face."""
    obj = rough_sphere(seed)
    rng = np.random.default_rng(seed)
    for edge in obj.data.edges:
        edge.use_seam, edge.use_edge_sharp = (rng.random(2) < 0.5).tolist()
    for face in obj.data.polygons:
        face.material_index, face.use_smooth = int(rng.integers(4)), bool(rng.random() < 0.5)
    lengths = marked_lengths(obj)
    areas = face_kinds(obj)
    cut_mesh(obj, some_contours(obj, seed))
    assert marked_lengths(obj) == pytest.approx(lengths, rel=1e-5)
    assert set(face_kinds(obj)) == set(areas)


def marked_lengths(obj):
    points = mesh_points(obj)
    edges = [(edge, np.linalg.norm(np.subtract(*points[list(edge.vertices)]))) for edge in obj.data.edges]
    return [
        sum(length for edge, length in edges if edge.use_seam),
        sum(length for edge, length in edges if edge.use_edge_sharp),
    ]


def face_kinds(obj):
    return {(face.material_index, face.use_smooth) for face in obj.data.polygons}


@pytest.mark.parametrize("seed", SEEDS)
def test_elements_that_no_contour_touches_are_bitwise_unchanged(seed):
    obj = rough_sphere(seed)
    add_attributes(obj, linear)
    contours = some_contours(obj, seed, 1)
    before = {face.index: face_data(obj, face) for face in obj.data.polygons}
    count = len(obj.data.vertices)
    positions_before = mesh_points(obj)
    cut_mesh(obj, contours)
    np.testing.assert_array_equal(mesh_points(obj)[:count], positions_before)
    touched = set(np.concatenate([contour.segment_faces for contour in contours]).tolist())
    after = {tuple(face.vertices): face_data(obj, face) for face in obj.data.polygons}
    for index, data in before.items():
        if index not in touched:
            assert after[data[0]] == data


def face_data(obj, face):
    corners = list(face.loop_indices)
    attributes = obj.data.attributes
    return (
        tuple(face.vertices),
        [tuple(obj.data.uv_layers["UVMap"].data[corner].uv) for corner in corners],
        [tuple(attributes["Paint"].data[corner].color) for corner in corners],
        attributes["Count"].data[face.index].value,
        attributes["Flag"].data[face.index].value,
        face.use_smooth,
        face.material_index,
    )


def test_pieces_of_faces_keep_the_data_of_their_face():
    obj = rough_plate(3)
    add_attributes(obj, linear)
    by_center = face_numbers(obj)
    cut_mesh(obj, some_contours(obj, 3))
    for center, number in face_numbers(obj):
        nearest = min(by_center, key=lambda known: np.linalg.norm(known[0] - center))
        assert number in {value for _, value in by_center}
        if np.linalg.norm(nearest[0] - center) < 1e-9:
            assert number == nearest[1]


def face_numbers(obj):
    data = obj.data.attributes["Count"].data
    return [(np.array(face.center), data[face.index].value) for face in obj.data.polygons]


def test_a_contour_along_edges_does_not_change_the_mesh():
    obj = grooved_cylinder()
    loop = rough_loop(GROOVE - 3)
    result = api.optimize_contour(obj, loop)
    before = [tuple(face.vertices) for face in obj.data.polygons]
    (chain,) = cut_mesh(obj, [result])
    np.testing.assert_array_equal(chain, result.vertices)
    assert [tuple(face.vertices) for face in obj.data.polygons] == before


@pytest.mark.parametrize("refinement", [1, 2, 5])
def test_native_results(refinement):
    """Refined contours run through vertices, along edges and across faces."""
    obj = rough_sphere(5, dissolve=0.5, bumps=0.3)
    (contour,) = plane_contours(obj, (0.1, 0.2, 1), 0.2)
    start = contour.edge_vertices, contour.edge_parameters
    result = api.optimize_contour(obj, start, refinement=refinement, min_salience=0.0, length_bias=0.0, anchor=0.0)
    assert (result.vertices < 0).any()
    targets = np.array(result.positions)
    (chain,) = cut_mesh(obj, [result])
    assert not obj.data.validate(verbose=True)
    path = mesh_points(obj)[[*chain, chain[0]]]
    assert max(distance_to_path(target, path) for target in targets) < 2e-5
