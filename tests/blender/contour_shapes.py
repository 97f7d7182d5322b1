# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours across faces for tests of cutting: intersections of planes with meshes, in the form of native results."""

from collections import defaultdict
from types import SimpleNamespace

import bmesh
import numpy as np
from made_meshes import mesh_object


def rough_sphere(seed=0, dissolve=0.4, bumps=0.2, name="Rough", subdivisions=3):
    """Make a bumpy sphere of triangles, some of which are merged into polygons with many corners."""
    bm = bmesh.new()
    bmesh.ops.create_icosphere(bm, subdivisions=subdivisions, radius=1.0)
    rng = np.random.default_rng(seed)
    for vertex in bm.verts:
        vertex.co *= 1 + bumps * np.sin(4 * vertex.co.z + vertex.co.x)
    return _with_dissolved(bm, rng, dissolve, name)


def rough_plate(seed=0, dissolve=0.4, name="Plate"):
    """Make a flat plate of quads, triangles and larger polygons, not all of them convex."""
    bm = bmesh.new()
    bmesh.ops.create_grid(bm, x_segments=12, y_segments=12, size=1.0)
    rng = np.random.default_rng(seed)
    for vertex in bm.verts:
        if not vertex.is_boundary:
            vertex.co.x += 0.05 * rng.uniform(-1, 1)
            vertex.co.y += 0.05 * rng.uniform(-1, 1)
    bmesh.ops.triangulate(bm, faces=[face for face in bm.faces if rng.random() < 0.5])
    return _with_dissolved(bm, rng, dissolve, name)


def _with_dissolved(bm, rng, fraction, name):
    bm.edges.ensure_lookup_table()
    taken, chosen = set(), []
    for index in rng.permutation(len(bm.edges)):
        edge = bm.edges[index]
        around = {face for vertex in edge.verts for face in vertex.link_faces}
        if rng.random() < fraction and not edge.is_boundary and not around & taken:
            chosen.append(edge)
            taken |= set(edge.link_faces)
    bmesh.ops.dissolve_edges(bm, edges=chosen)
    bm.normal_update()
    obj = mesh_object(name, [])
    bm.to_mesh(obj.data)
    bm.free()
    return obj


def plane_contours(obj, normal, offset):
    """Return the intersections of a mesh's triangles with the plane of all p with normal . p = offset."""
    mesh = obj.data
    mesh.calc_loop_triangles()
    heights = np.array([vertex.co[:] for vertex in mesh.vertices]) @ np.asarray(normal, dtype=float) - offset
    ahead = {}  # from the point on one edge to that on the next, and the face between
    for triangle in mesh.loop_triangles:
        corners = list(triangle.vertices)
        crossed = [(a, b) for a, b in zip(corners, corners[1:] + corners[:1]) if (heights[a] > 0) != (heights[b] > 0)]
        if crossed:
            falling, rising = sorted(crossed, key=lambda edge: heights[edge[0]] < 0)
            ahead[_key(rising)] = _key(falling), triangle.polygon_index
    return [_contour(path, faces, closed, heights) for path, faces, closed in _chained(ahead)]


def _key(edge):
    return tuple(sorted(edge))


def _chained(ahead):
    targets = {target for target, _ in ahead.values()}
    starts = sorted(set(ahead) - targets) + sorted(targets & set(ahead))
    done = set()
    for start in starts:
        path, faces, point = [], [], start
        while point in ahead and point not in done:
            done.add(point)
            path.append(point)
            point, face = ahead[point]
            faces.append(face)
        if path:
            yield (path, faces, True) if point == start else ([*path, point], faces, False)


def _contour(path, faces, closed, heights):
    parameters = [heights[a] / (heights[a] - heights[b]) for a, b in path]
    return SimpleNamespace(
        edge_vertices=np.array(path), edge_parameters=np.array(parameters), segment_faces=np.array(faces), closed=closed
    )


def positions(obj_or_bm, contour):
    """Return the positions of a contour's points."""
    points = np.array([vertex.co[:] for vertex in getattr(obj_or_bm, "data", obj_or_bm).vertices])
    (a, b), t = contour.edge_vertices.T, contour.edge_parameters[:, None]
    return (1 - t) * points[a] + t * points[b]


def flat_area(bm):
    return sum(face.calc_area() for face in bm.faces)


def edges_by_ends(bm):
    """Return how many edges join each pair of vertices."""
    counts = defaultdict(int)
    for edge in bm.edges:
        counts[frozenset(vertex.index for vertex in edge.verts)] += 1
    return counts


def add_attributes(obj, linear):
    """Add layers of every kind: values that the function `linear` gives for positions, and a constant for each face."""
    mesh = obj.data
    points = np.array([vertex.co[:] for vertex in mesh.vertices])
    corners = points[[loop.vertex_index for loop in mesh.loops]]
    group = obj.vertex_groups.new(name="Weights")
    for vertex, value in enumerate(linear(points)):
        group.add([vertex], float(value), "REPLACE")
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", _repeated(linear(corners), 2))
    _fill(mesh, "Heat", "FLOAT", "POINT", "value", linear(points))
    _fill(mesh, "Wind", "FLOAT_VECTOR", "POINT", "vector", _repeated(linear(points), 3))
    _fill(mesh, "Paint", "FLOAT_COLOR", "CORNER", "color", _repeated(linear(corners), 4))
    _fill(mesh, "Dust", "BYTE_COLOR", "CORNER", "color", _repeated(linear(corners), 4))
    _fill(mesh, "Stretch", "FLOAT2", "CORNER", "vector", _repeated(linear(corners), 2))
    _fill(mesh, "Count", "INT", "FACE", "value", np.arange(len(mesh.polygons)) % 7)
    _fill(mesh, "Flag", "BOOLEAN", "FACE", "value", np.arange(len(mesh.polygons)) % 2 == 0)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Moved")
    key.data.foreach_set("co", (2 * points + linear(points)[:, None]).ravel())


def _fill(mesh, name, kind, domain, field, values):
    mesh.attributes.new(name, kind, domain).data.foreach_set(field, np.ravel(values))


def _repeated(values, times):
    return np.repeat(values, times)


def read_attribute(obj, name, field, width):
    data = obj.data.attributes[name].data
    values = np.empty(width * len(data), dtype=np.float32)
    data.foreach_get(field, values)
    return values.reshape(-1, width)


def cut_mesh(obj, contours, merge=0.0):
    """Cut contours in Object Mode and return the chains of vertex ids."""
    from minimum_ratio_contours.mesh import cutting

    bm = bmesh.new()
    bm.from_mesh(obj.data)
    chains = cutting.cut_contours(bm, contours, merge)
    bm.to_mesh(obj.data)
    bm.free()
    return chains
