# SPDX-License-Identifier: GPL-3.0-or-later
"""The entries in Blender's menus and in the search (F3), used by keys and clicks."""

import bpy
from made_meshes import GROOVE, SEGMENTS, edge_set, edit, grooved_cylinder, mark_edges, marked_edges, pairs, ring
from minimum_ratio_contours.mesh import segmentation
from prepared import LOOP, cylinder, now


def message():
    return bpy.context.window_manager.minimum_ratio_contours.message


def opened(window, key, **modifiers):
    """Open a menu in the middle of the viewport."""
    yield from window.move(500, 400)
    yield from window.press(key, **modifiers)
    yield from window.rest()


def test_the_edge_menu(window):
    cylinder()
    yield from opened(window, "E", ctrl=True)
    window.picture("menu-edge")
    yield from window.choose("optimize_contour(output='SELECT')")
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))


def test_the_submenu_of_the_edge_menu_marks_a_seam(window):
    cylinder()
    yield from opened(window, "E", ctrl=True)
    yield from window.press("END")
    yield from window.press("RIGHT_ARROW")
    yield from window.rest()
    window.picture("menu-outputs")
    yield from window.choose("output='SEAM'")
    assert marked_edges(now(), "seam") == edge_set(ring(GROOVE))


def test_after_a_part_was_separated_the_menu_entry_only_selects(window):
    cylinder()
    yield from opened(window, "E", ctrl=True)
    yield from window.press("END")
    yield from window.press("RIGHT_ARROW")
    yield from window.rest()
    yield from window.choose("output='SEPARATE'")
    assert len(bpy.data.objects) == 2
    assert bpy.context.window_manager.operator_properties_last("mesh.optimize_contour").output == "SEPARATE"
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.batch_remove(bpy.data.objects[:])
    cylinder()
    yield from opened(window, "E", ctrl=True)
    yield from window.choose("optimize_contour(output='SELECT')")
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))
    assert len(bpy.data.objects) == 1


def test_the_edge_menu_starts_adjust_contour(window):
    cylinder()
    yield from opened(window, "E", ctrl=True)
    yield from window.choose("mesh.adjust_contour()")
    window.picture("menu-adjust")
    assert marked_edges(now(), "select") == edge_set(LOOP)  # nothing has been applied yet
    yield from window.press("RET")
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))


def test_the_context_menu(window):
    cylinder()
    yield from opened(window, "RIGHTMOUSE")
    window.picture("menu-context")
    yield from window.choose("optimize_contour(output='SELECT')")
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))


def test_the_uv_menu_moves_all_seams(window):
    mark_edges(cylinder(), pairs(LOOP), "seam")
    yield from opened(window, "U")
    window.picture("menu-uv")
    yield from window.choose("mesh.optimize_seams()")
    assert marked_edges(now(), "seam") == edge_set(ring(GROOVE))


def labeled():
    """Make the cylinder with two face sets that meet in a rough loop, in face mode."""
    obj = grooved_cylinder()
    sets = obj.data.attributes.new(segmentation.FACE_SETS, "INT", "FACE")
    sets.data.foreach_set("value", [1 + (face.index >= (GROOVE - 3) * SEGMENTS) for face in obj.data.polygons])
    edit(obj, mode="FACE")
    bpy.ops.ed.undo_push(message="prepared")
    return obj


def test_the_face_menu_moves_the_borders_of_regions(window):
    labeled()
    yield from opened(window, "F", ctrl=True)
    window.picture("menu-face")
    yield from window.choose("mesh.optimize_segmentation()")
    bpy.ops.object.mode_set(mode="OBJECT")
    values = [item.value for item in now().data.attributes[segmentation.FACE_SETS].data]
    assert values == [1 + (face.index >= GROOVE * SEGMENTS) for face in now().data.polygons]


def searched(window, word, entry, take):
    """Search for a word with F3, save a picture, and run the entry at this position in the list."""
    yield from opened(window, "F3")
    yield from window.type(word)
    yield from window.rest()
    window.picture(f"search-{word}")
    for _ in range(take):
        yield from window.press("DOWN_ARROW")
    yield from window.press("RET")
    yield from window.rest()
    operators = bpy.context.window_manager.operators
    assert [operator.bl_idname for operator in operators][-1:] == [entry]


def test_search_finds_contour(window):
    cylinder()
    yield from searched(window, "contour", "MESH_OT_optimize_contour", 1)
    assert marked_edges(now(), "select") == edge_set(ring(GROOVE))


def test_search_finds_seams(window):
    mark_edges(cylinder(), pairs(LOOP), "seam")
    yield from searched(window, "seams", "MESH_OT_optimize_seams", 0)
    assert marked_edges(now(), "seam") == edge_set(ring(GROOVE))


def test_search_finds_segmentation(window):
    labeled()
    yield from searched(window, "segmentation", "MESH_OT_optimize_segmentation", 0)
    assert "1 of 1 borders moved" in message()


def test_search_finds_curvature(window):
    cylinder()
    yield from searched(window, "curvature", "MESH_OT_show_curvature", 0)
    assert now().data.color_attributes.active_color.name == "Curvature"
    window.area.spaces.active.shading.color_type = "MATERIAL"
