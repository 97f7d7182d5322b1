# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh and selection that the scenarios start from."""

import bpy
from made_meshes import GROOVE, SEGMENTS, edit, grooved_cylinder, pairs, rough_loop, select
from mathutils import Matrix

LOOP = rough_loop(GROOVE - 4)
FRONT = 3 * SEGMENTS // 4  # the column that faces the view


def cylinder(matrix=None):
    """Make a cylinder in Edit Mode with a rough loop selected a few rings below the groove."""
    obj = grooved_cylinder()
    obj.matrix_world = matrix or Matrix()
    edit(obj)
    select(obj, pairs(LOOP))
    bpy.ops.ed.undo_push(message="prepared")
    return obj


def now():
    """Look the cylinder up again, since undo replaces the objects."""
    return bpy.data.objects["Cylinder"]
