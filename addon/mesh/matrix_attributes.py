# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps Blender alive where elements carry 4x4 matrices, which Blender 4.2 and later have as attributes.

A bmesh aligns values less strictly than the processor's instructions for whole matrices demand, so Blender crashes
where it gives a new element the default matrix. Copies are safe. So a cut copies old edges; and while holes are filled,
which makes faces and corners, their matrices are held as colors, one for each row.
"""

from contextlib import contextmanager

import bpy
import numpy as np

from . import edit_mode

_MATRIX = "FLOAT4X4"
_ROW = "minimum_ratio_contours_{}_{}"  # attribute and row


def on(mesh, *domains):
    """Return the names of the matrix attributes on these domains; in Edit Mode, too."""
    return [item.name for item in mesh.attributes if item.data_type == _MATRIX and item.domain in domains]


@contextmanager
def as_colors(context, meshes):
    """Hold the matrices of faces and corners as colors, also in the meshes that are made meanwhile.

    If there are any, this leaves Edit Mode and enters it again, at the beginning and at the end.
    """
    names = {name for mesh in meshes for name in on(mesh, "FACE", "CORNER")}
    if not names:
        yield
        return
    numbers = dict(zip(sorted(names), range(len(names))))  # names of attributes must not become too long
    with edit_mode.left(context):
        for mesh in meshes:
            for name in on(mesh, "FACE", "CORNER"):
                _split(mesh, name, numbers[name])
    try:
        yield
    finally:
        with edit_mode.left(context):
            for mesh in bpy.data.meshes:
                for name, number in numbers.items():
                    _join(mesh, name, number)


def _split(mesh, name, number):
    attribute = mesh.attributes[name]
    domain, values = attribute.domain, np.empty((len(attribute.data), 4, 4), dtype=np.float32)
    attribute.data.foreach_get("value", values.reshape(-1))
    mesh.attributes.remove(attribute)
    for row in range(4):
        colors = mesh.attributes.new(_ROW.format(number, row), "FLOAT_COLOR", domain)
        colors.data.foreach_set("color", values[:, row].ravel())


def _join(mesh, name, number):
    rows = [mesh.attributes.get(_ROW.format(number, row)) for row in range(4)]
    if None in rows:
        return
    domain, values = rows[0].domain, np.empty((len(rows[0].data), 4, 4), dtype=np.float32)
    for row in range(4):
        attribute, part = mesh.attributes[_ROW.format(number, row)], np.empty(values[:, row].size, dtype=np.float32)
        attribute.data.foreach_get("color", part)
        values[:, row] = part.reshape(-1, 4)
        mesh.attributes.remove(attribute)
    mesh.attributes.new(name, _MATRIX, domain).data.foreach_set("value", values.ravel())
