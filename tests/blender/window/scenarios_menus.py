# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user finds in Blender's menus and by F3, by keys and clicks."""

import bpy
from made_meshes import GROOVE, SEGMENTS, edge_set, edit, flagged, grooved_cylinder, pairs, ring, set_flag
from minimum_ratio_contours.mesh import segmentation
from prepared import LOOP, cylinder, now


def message():
    return bpy.context.window_manager.minimum_ratio_contours.message


def opened(window, key, **modifiers):
    """A menu in the middle of the view."""
    yield from window.move(500, 400)
    yield from window.press(key, **modifiers)
    yield from window.rest()


def test_the_edge_menu(window):
    cylinder()
    yield from opened(window, "E", ctrl=True)
    window.picture("menu-edge")
    yield from window.choose("mesh.optimize_contour()")
    assert flagged(now(), "select") == edge_set(ring(GROOVE))


def test_the_edge_menus_own_menu_marks_a_seam_at_once(window):
    cylinder()
    yield from opened(window, "E", ctrl=True)
    yield from window.press("END")
    yield from window.press("RIGHT_ARROW")
    yield from window.rest()
    window.picture("menu-outputs")
    yield from window.choose("output='SEAM'")
    assert flagged(now(), "seam") == edge_set(ring(GROOVE))


def test_the_edge_menu_starts_the_live_one(window):
    cylinder()
    yield from opened(window, "E", ctrl=True)
    yield from window.choose("mesh.adjust_contour()")
    window.picture("menu-adjust")
    assert flagged(now(), "select") == edge_set(LOOP)  # nothing has been applied yet
    yield from window.press("RET")
    assert flagged(now(), "select") == edge_set(ring(GROOVE))


def test_the_context_menu(window):
    cylinder()
    yield from opened(window, "RIGHTMOUSE")
    window.picture("menu-context")
    yield from window.choose("mesh.optimize_contour()")
    assert flagged(now(), "select") == edge_set(ring(GROOVE))


def test_the_uv_menu_moves_all_seams(window):
    set_flag(cylinder(), pairs(LOOP), "seam")
    yield from opened(window, "U")
    window.picture("menu-uv")
    yield from window.choose("mesh.optimize_seams()")
    assert flagged(now(), "seam") == edge_set(ring(GROOVE))


def labeled():
    """The cylinder with two face sets that meet in a rough loop, in face mode."""
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
    """What F3 finds for a word: a picture, and the run of the entry that stands at that place of the list."""
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
    assert flagged(now(), "select") == edge_set(ring(GROOVE))


def test_search_finds_seam(window):
    set_flag(cylinder(), pairs(LOOP), "seam")
    yield from searched(window, "seam", "MESH_OT_optimize_seams", 2)
    assert flagged(now(), "seam") == edge_set(ring(GROOVE))


def test_search_finds_segmentation(window):
    labeled()
    yield from searched(window, "segmentation", "MESH_OT_optimize_segmentation", 0)
    assert "1 of 1 borders moved" in message()


def test_search_finds_curvature(window):
    cylinder()
    yield from searched(window, "curvature", "MESH_OT_show_curvature", 0)
    assert now().data.color_attributes.active_color.name == "Curvature"
    window.area.spaces.active.shading.color_type = "MATERIAL"
