# SPDX-License-Identifier: GPL-3.0-or-later
"""Undo and redo restore exactly the same mesh; neither they nor a second run build the native surface again."""

from functools import partial

import bmesh
import bpy
import pytest
from made_meshes import (
    GROOVE,
    SEGMENTS,
    edge_set,
    edit,
    grooved_cylinder,
    mark_edges,
    marked_edges,
    mesh_state,
    pairs,
    ring,
    rough_loop,
    select,
)
from minimum_ratio_contours import api
from minimum_ratio_contours.core import native
from minimum_ratio_contours.mesh.arrays import synchronize


@pytest.fixture
def built(monkeypatch):
    """The native surfaces that were built so far."""
    make, surfaces = native.module().Surface, []

    def counted(**arrays):
        surfaces.append(make(**arrays))
        return surfaces[-1]

    monkeypatch.setattr(native.module(), "Surface", counted)
    return surfaces


def prepared():
    obj = grooved_cylinder()
    edit(obj)
    loop = rough_loop(GROOVE - 3)
    mark_edges(obj, pairs(loop), "seam")
    select(obj, pairs(loop))
    bpy.ops.ed.undo_push(message="prepared")


def cylinder():
    """Look the cylinder up again, since undo replaces the objects."""
    return bpy.data.objects["Cylinder"]


def surface():
    synchronize(cylinder())
    return api.surface_of(cylinder())


@pytest.mark.parametrize("output", ["SELECT", "SEAM", "SHARP"])
def test_undo_and_redo(output):
    prepared()
    before = mesh_state(cylinder())
    assert bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, output=output) == {"FINISHED"}
    after = mesh_state(cylinder())
    assert after != before
    bpy.ops.ed.undo()
    assert mesh_state(cylinder()) == before
    bpy.ops.ed.redo()
    assert mesh_state(cylinder()) == after


def test_a_second_run_after_undo_uses_the_same_surface():
    prepared()
    bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, width=1)
    first = surface()
    bpy.ops.ed.undo()
    bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, width=4)
    assert surface() is first
    assert marked_edges(cylinder(), "select") == edge_set(ring(GROOVE))


def moved_vertex():
    bm = bmesh.from_edit_mesh(cylinder().data)
    bm.verts.ensure_lookup_table()
    bm.verts[5].co.x += 1e-3
    bmesh.update_edit_mesh(cylinder().data)
    bpy.ops.ed.undo_push(message="edited")


@pytest.mark.parametrize("operator", ["optimize_contour", "optimize_seams", "optimize_segmentation"])
def test_redo_builds_no_surface_unless_the_mesh_was_edited(operator, built):
    """The redo panel undoes and runs again. Writing marks and labels does not change the surface."""
    obj = grooved_cylinder()
    for name in ("One", "Two"):
        obj.data.materials.append(bpy.data.materials.new(name))
    obj.data.polygons.foreach_set(
        "material_index", [i >= (GROOVE - 2) * SEGMENTS for i in range(len(obj.data.polygons))]
    )
    edit(obj)
    loop = rough_loop(GROOVE - 3)
    mark_edges(obj, pairs(loop), "seam")
    select(obj, pairs(loop))
    bpy.ops.ed.undo_push(message="prepared")
    run = partial(getattr(bpy.ops.mesh, operator), "EXEC_DEFAULT", True)
    source = {"source": "MATERIAL"} if operator == "optimize_segmentation" else {}
    for expected, edited in ((1, None), (2, moved_vertex)):
        if edited:
            edited()
        before = mesh_state(cylinder())
        for width in (2, 3, 5):
            assert run(width=width, iterations=8, **source) == {"FINISHED"}
            assert len(built) == expected
            bpy.ops.ed.undo()
            assert mesh_state(cylinder()) == before


def test_a_moved_vertex_or_a_hidden_face_makes_a_new_surface():
    obj = grooved_cylinder()
    first = surface()
    assert surface() is first
    obj.data.vertices[5].co.x += 1e-3
    second = surface()
    assert second is not first
    obj.data.polygons[5].hide = True
    assert surface() not in (first, second)


def test_the_surfaces_of_several_objects_are_cached_and_no_others(built):
    objects = [grooved_cylinder("First"), grooved_cylinder("Second")]
    edit(*objects)
    for obj in objects:
        select(obj, pairs(rough_loop(GROOVE - 3)))
    for width in (2, 4):
        bpy.ops.mesh.optimize_contour(width=width)
    assert len(built) == 2
    api.surface_of(objects[0])
    api.surface_of(objects[1])
    assert len(built) == 3
