# SPDX-License-Identifier: GPL-3.0-or-later
"""Half a mesh under a Mirror modifier: with the default settings, chains end on the mirror plane and slide along it."""

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import edit, marked_edges, mesh_object, pairs, run, select

COLUMNS, ROWS = 13, 41
HEIGHTS = np.linspace(-2, 2, ROWS)


def half_tube(tilt=0.0):
    """Make the half x >= 0 of a tube along z with a groove at height 0.2, by `tilt` higher in front."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, COLUMNS)
    points = []
    for height in HEIGHTS:
        radii = 1 - 0.3 * np.exp(-12 * (height - 0.2 - tilt * np.cos(angles)) ** 2)
        x, y = radii * np.cos(angles), radii * np.sin(angles)
        x[[0, -1]] = 0.0
        points += [(x[i], y[i], height) for i in range(COLUMNS)]
    corners = [row * COLUMNS + column for row in range(ROWS - 1) for column in range(COLUMNS - 1)]
    obj = mesh_object("Half", points, faces=[(i, i + 1, i + COLUMNS + 1, i + COLUMNS) for i in corners])
    modifier = obj.modifiers.new("Mirror", "MIRROR")
    modifier.use_clip = True
    return obj


def start(tilt, below=3):
    obj = half_tube(tilt)
    edit(obj)
    row = int(np.argmin(abs(HEIGHTS - 0.2))) - below
    select(obj, pairs([row * COLUMNS + column for column in range(COLUMNS)], closed=False))
    return obj


def chain_ends(obj):
    counts = np.bincount([vertex for edge in marked_edges(obj, "select") for vertex in edge])
    return np.flatnonzero(counts == 1).tolist()


@pytest.mark.parametrize("tilt", [0.0, 0.3])
@pytest.mark.parametrize(("output", "refinement"), [("SEAM", 0), ("CUT", 2)])
def test_both_ends_slide_along_the_plane_into_the_groove(output, refinement, tilt, last):
    obj = start(tilt)
    assert run(output=output, refinement=refinement) == {"FINISHED"}
    assert last.message.startswith("1 contour improved")
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    ends = [bm.verts[vertex] for vertex in chain_ends(obj)]
    assert len(ends) == 2
    for vertex in ends:
        assert vertex.is_boundary
        assert vertex.co.x == 0.0
        assert vertex.co.z == pytest.approx(0.2, abs=0.11)
    assert not [vertex for vertex in bm.verts if 0 < abs(vertex.co.x) < 1e-3]


@pytest.mark.parametrize("refinement", [0, 2])
def test_the_mirrored_seam_is_one_loop(refinement):
    obj = start(0.3)
    run(output="SEAM", refinement=refinement)
    bpy.ops.object.mode_set(mode="OBJECT")
    whole = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    counts = np.bincount([vertex for edge in whole.edges if edge.use_seam for vertex in edge.vertices])
    assert set(counts.tolist()) == {0, 2}
    assert not any(0 < abs(vertex.co.x) < 1e-3 for vertex in whole.vertices)


@pytest.mark.parametrize("ends", ["EDGES", "VERTICES"])
def test_the_setting_still_holds_them(ends):
    obj = start(0.0)
    before = chain_ends(obj)
    run(output="SEAM", ends=ends)
    assert chain_ends(obj) == before


def test_selected_faces_end_on_the_plane_too():
    obj = half_tube(0.3)
    edit(obj, mode="FACE")
    for face in bmesh.from_edit_mesh(obj.data).faces:
        face.select_set(face.calc_center_median().z < -0.1)
    run(output="SEAM")
    bpy.ops.object.mode_set(mode="OBJECT")
    ends = np.bincount([vertex for edge in obj.data.edges if edge.use_seam for vertex in edge.vertices]) == 1
    heights = [obj.data.vertices[vertex].co.z for vertex in np.flatnonzero(ends)]
    assert heights == pytest.approx([0.2, 0.2], abs=0.11)
