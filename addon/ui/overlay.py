# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws bands and contours over the surface in 3D Viewports. Never changes the mesh."""

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

_OFFSET, _FLAT_OFFSET = 0.0025, 1e-5  # toward the eye, in perspective and orthographic views
_BAND_ALPHA = 0.25
_GIVEN_WIDTH, _FOUND_WIDTH, _PIN_SIZE = 2.0, 4.0, 10.0  # in points
_DIRECTION_WIDTH = 1.5
_DIRECTION_COLOR = (1.0, 1.0, 0.35, 1.0)  # stands out from the blue of valleys and from marked edges


class Overlay:
    """Draws shapes over some objects until `remove` is called."""

    def __init__(self, kind=None):
        self._kind = kind or _Batches
        self._items = []  # (matrix, the argument of this kind of batches)
        self._batches = None
        self._handle = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_VIEW")

    def show(self, items):
        """Draw these items from now on: pairs of a matrix and Shapes, or whatever the kind takes."""
        self._items, self._batches = items, None
        _redraw()

    def remove(self):
        if self._handle is not None:
            bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")
            self._handle = None
            _redraw()

    def _draw(self):
        context = bpy.context
        if self._batches is None:
            self._batches = [(matrix, self._kind(shapes)) for matrix, shapes in self._items]
        projection = _toward_eye(gpu.matrix.get_projection_matrix(), context.region_data)
        gpu.state.depth_test_set("NONE" if _seen_through(context.space_data.shading) else "LESS_EQUAL")
        gpu.state.blend_set("ALPHA")
        try:
            for matrix, batches in self._batches:
                with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
                    gpu.matrix.load_projection_matrix(projection)
                    gpu.matrix.multiply_matrix(matrix)
                    batches.draw(context)
        finally:
            gpu.state.depth_test_set("NONE")
            gpu.state.blend_set("NONE")
            gpu.state.point_size_set(1.0)


class _Batches:
    """The shapes of one object, on the GPU."""

    def __init__(self, shapes):
        self._fill, self._line = _shader("UNIFORM_COLOR"), _shader("POLYLINE_UNIFORM_COLOR")
        self._point = _point_shader()
        self._band = _batch(self._fill, "TRIS", shapes.band)
        self._given = _batch(self._line, "LINES", shapes.given)
        self._found = _batch(self._line, "LINES", shapes.found)
        self._pins = _batch(self._point, "POINTS", shapes.pins)

    def draw(self, context):
        theme = context.preferences.themes[0].view_3d
        scale = context.preferences.system.pixel_size
        self._draw_band((*theme.face_select[:3], _BAND_ALPHA))
        _draw_lines(context, self._line, self._given, (*theme.transform[:3], 1.0), _GIVEN_WIDTH * scale)
        _draw_lines(context, self._line, self._found, (*theme.edge_select[:3], 1.0), _FOUND_WIDTH * scale)
        self._draw_pins((*theme.editmesh_active[:3], 1.0), _PIN_SIZE * scale)

    def _draw_band(self, color):
        if self._band:
            gpu.state.depth_mask_set(False)
            self._fill.uniform_float("color", color)
            self._band.draw(self._fill)

    def _draw_pins(self, color, size):
        if self._pins:
            gpu.state.point_size_set(size)
            self._point.uniform_float("color", color)
            if bpy.app.version >= (5, 0, 0):
                self._point.uniform_float("size", size)
            self._pins.draw(self._point)


class Directions:
    """The directions of one object, as the ends of lines, on the GPU."""

    def __init__(self, ends):
        self._line = _shader("POLYLINE_UNIFORM_COLOR")
        self._batch = _batch(self._line, "LINES", ends)

    def draw(self, context):
        width = _DIRECTION_WIDTH * context.preferences.system.pixel_size
        _draw_lines(context, self._line, self._batch, _DIRECTION_COLOR, width)


def _draw_lines(context, shader, batch, color, width):
    if batch:
        shader.uniform_float("viewportSize", (context.region.width, context.region.height))
        shader.uniform_float("lineWidth", width)
        shader.uniform_float("color", color)
        batch.draw(shader)


def _shader(name):
    """Return a builtin shader. Blender 4.0 dropped the prefix that distinguished 2D from 3D drawing."""
    return gpu.shader.from_builtin(name if bpy.app.version >= (4, 0, 0) else f"3D_{name}")


def _point_shader():
    return _shader("POINT_UNIFORM_COLOR" if bpy.app.version >= (5, 0, 0) else "UNIFORM_COLOR")


def _batch(shader, kind, points):
    """Return a batch, or None if there is nothing to draw: some drivers fail on empty batches."""
    return batch_for_shader(shader, kind, {"pos": np.ascontiguousarray(points)}) if len(points) else None


def _seen_through(shading):
    """Whether the viewport shows what lies behind the surface."""
    return {"SOLID": shading.show_xray, "WIREFRAME": shading.show_xray_wireframe}.get(shading.type, False)


def _toward_eye(projection, view):
    """Return a projection that draws slightly nearer, as Blender's GPU_polygon_offset does for its own edges."""
    shifted = projection.copy()
    if projection[3][3] < 0.5:  # perspective: a fraction of the distance
        shifted[2][3] *= 1 + _OFFSET
    elif view.view_perspective == "CAMERA":
        shifted[2][3] -= _FLAT_OFFSET / max(abs(projection[0][0]), abs(projection[1][1]))
    else:
        shifted[2][3] -= _FLAT_OFFSET * view.view_distance
    return shifted


def _redraw():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
