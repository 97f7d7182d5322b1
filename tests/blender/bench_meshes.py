# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh of a million triangles for the benchmarks, and rough loops on it."""

import time

import bpy
import numpy as np

COLUMNS, ROWS, GROOVE = 1000, 500, 250


def grooved_tube():
    """Make a closed tube of a million triangles with a groove around its middle."""
    angles, rows = 2 * np.pi * np.arange(COLUMNS) / COLUMNS, np.arange(ROWS + 1)
    radii = 1 - 0.2 * np.exp(-(((rows - GROOVE) / 5.0) ** 2) / 2)
    points = np.stack(
        [np.outer(radii, np.cos(angles)), np.outer(radii, np.sin(angles)), np.outer(0.006 * rows, np.ones(COLUMNS))], -1
    ).reshape(-1, 3)
    tips = [(0.0, 0.0, -0.5), (0.0, 0.0, 0.006 * ROWS + 0.5)]
    mesh = _mesh("Tube", np.concatenate([points, tips]), np.concatenate([_wall(), *_caps()]))
    obj = bpy.data.objects.new("Tube", mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def square(row, column, size):
    """Return a closed loop along rows and columns."""
    steps = [(0, 1)] * size + [(1, 0)] * size + [(0, -1)] * size + [(-1, 0)] * size
    corners = np.cumsum([(row, column), *steps[:-1]], axis=0)
    return [int(r * COLUMNS + c) for r, c in corners]


def milliseconds(call, *arguments, **keywords):
    begin = time.perf_counter()
    result = call(*arguments, **keywords)
    return 1e3 * (time.perf_counter() - begin), result


def _wall():
    low = np.arange(ROWS * COLUMNS).reshape(ROWS, COLUMNS)
    following = np.roll(low, -1, axis=1)
    return np.stack([low, following, following + COLUMNS, low, following + COLUMNS, low + COLUMNS], -1).reshape(-1, 3)


def _caps():
    """Return the fans around the two tips, whose vertices come after all others."""
    column, top, tip = np.arange(COLUMNS), ROWS * COLUMNS, (ROWS + 1) * COLUMNS
    following = np.roll(column, -1)
    yield np.stack([following, column, np.full(COLUMNS, tip)], -1)
    yield np.stack([top + column, top + following, np.full(COLUMNS, tip + 1)], -1)


def _mesh(name, points, triangles):
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.astype(np.float32).ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.astype(np.int32).ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    if bpy.app.version < (4, 0, 0):  # later releases derive the end of a face from the next start
        mesh.polygons.foreach_set("loop_total", np.full(len(triangles), 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    return mesh
