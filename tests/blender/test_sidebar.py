# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets, preferences, menus and the last result."""

from pathlib import Path
from types import SimpleNamespace
from unittest.mock import MagicMock

import bpy
import minimum_ratio_contours
import pytest
from made_meshes import (
    GROOVE,
    OUTPUTS,
    SEGMENTS,
    START,
    edit,
    grooved_cylinder,
    mark_edges,
    marked_edges,
    pairs,
    ring,
    select,
)
from minimum_ratio_contours.core import parameters
from minimum_ratio_contours.mesh import segmentation
from minimum_ratio_contours.ui import menus, panels, preferences, presets

WINDOW_ONLY = "mesh.show_curvature_directions"  # the tests of the window run it


class Layout:
    """Stands in for a layout and records the operators drawn, as (idname, text, properties)."""

    def __init__(self):
        self.drawn, self.menus = [], []

    def separator(self):
        pass

    def menu(self, name):
        self.menus.append(name)

    def operator(self, idname, text=""):
        properties = type("Properties", (), {})()
        self.drawn.append((idname, text, properties))
        return properties


class Drawn:
    def __init__(self):
        self.layout = Layout()


@pytest.fixture
def own():
    """The user's preferences, which are restored afterwards."""
    found = bpy.context.preferences.addons[minimum_ratio_contours.__name__].preferences
    yield found
    bpy.ops.mesh.contour_defaults()


def remembered(operator=panels.OPERATOR):
    return bpy.context.window_manager.operator_properties_last(operator)


def ready_for_all():
    """Make a mesh in Edit Mode whose selection, seams and face sets can all be optimized."""
    obj = grooved_cylinder()
    sets = obj.data.attributes.new(segmentation.FACE_SETS, "INT", "FACE")
    sets.data.foreach_set("value", [face.index >= (GROOVE - 3) * SEGMENTS for face in obj.data.polygons])
    edit(obj)
    select(obj, pairs(START))
    mark_edges(obj, pairs(START), "seam")


def test_every_menu_entry_runs():
    seen = set()
    drawers = [draw for _, draw in menus._ENTRIES] + [menus.VIEW3D_MT_minimum_ratio_contours.draw]
    for draw in drawers:
        menu = Drawn()
        draw(menu, bpy.context)
        assert menu.layout.drawn
        for idname, _, properties in menu.layout.drawn:
            ready_for_all()
            if idname == WINDOW_ONLY:
                assert not bpy.ops.mesh.show_curvature_directions.poll()
                continue
            category, name = idname.split(".")
            assert getattr(getattr(bpy.ops, category), name)(**vars(properties)) == {"FINISHED"}
            seen.add((idname, *vars(properties).values()))
            bpy.ops.object.mode_set(mode="OBJECT")
    assert {output for _, *outputs in seen for output in outputs} == set(OUTPUTS)
    names = {idname for idname, *_ in seen}
    assert names == {f"mesh.{name}" for name in dir(bpy.ops.mesh) if "optimize" in name} | {
        "mesh.adjust_contour",
        "mesh.show_curvature",
    }


def test_every_menu_entry_says_its_output_instead_of_repeating_the_last():
    """In a window, Blender gives an operator the properties of its last run where an entry sets none."""
    for menu_name, draw in menus._ENTRIES:
        menu = Drawn()
        draw(menu, bpy.context)
        entries = {text: vars(properties) for idname, text, properties in menu.layout.drawn if idname == menus.OPERATOR}
        assert all("output" in properties for properties in entries.values())
        for text in ("", "Optimize Contour of Faces"):
            assert entries.get(text, {"output": "SELECT"}) == {"output": "SELECT"}
        if menu_name != "VIEW3D_MT_uv_map" and entries:
            assert menu.layout.menus == [menus.VIEW3D_MT_minimum_ratio_contours.bl_idname]


def test_the_panel_shows_the_last_result(last):
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(START))
    bpy.ops.mesh.optimize_contour()
    (numbers,) = last.contours
    circumference = sum((obj.data.vertices[a].co - obj.data.vertices[b].co).length for a, b in pairs(ring(GROOVE)))
    assert numbers.length == pytest.approx(circumference, rel=1e-5)
    assert numbers.salience.startswith("Clear boundary (")
    assert numbers.reason == ""
    bpy.ops.mesh.optimize_contour()
    (numbers,) = last.contours
    assert numbers.status == "unchanged"
    assert numbers.reason == "already the best nearby: raise Width or Reach to look farther"
    assert numbers.reason in last.message


def test_a_flat_surface_is_reported_in_words(last):
    obj = grooved_cylinder(depth=0)
    edit(obj)
    select(obj, pairs(ring(8)))
    bpy.ops.mesh.optimize_contour()
    assert last.contours[0].salience.startswith("Nothing concave here (")


def drawn(draw, settings):
    """Return the names of the properties that a function draws, using a layout that only records them."""
    layout = MagicMock()
    draw(layout, settings)
    calls = [args for name, args, _ in layout.mock_calls if name.split(".")[-1] in ("prop", "prop_search")]
    return [args[1] for args in calls if args[0] is settings]


@pytest.mark.parametrize("source", ["NONE", "GROUP", "ATTRIBUTE", "COLOR"])
def test_the_panels_show_every_setting_once(source):
    """The redo panel draws an operator, and the sidebar its last properties; a plain object stands in for both."""
    obj = grooved_cylinder()
    rna = [prop for prop in bpy.ops.mesh.optimize_contour.get_rna_type().properties[1:] if not prop.is_hidden]
    settings = SimpleNamespace(**{prop.identifier: getattr(remembered(), prop.identifier) for prop in rna})
    settings.region_source = source
    shown = drawn(panels.draw_settings, settings) + drawn(panels.draw_more_settings, settings)
    shown += drawn(lambda layout, of: panels.draw_constraints(layout, of, obj), settings)
    assert sorted(shown) == sorted(prop.identifier for prop in rna)


# ---- presets


@pytest.mark.parametrize("name", parameters.PRESETS)
def test_the_next_run_from_the_panel_uses_the_preset(name):
    settings = remembered()
    settings.width, settings.crease, settings.output = 33, 7.0, "SHARP"
    assert bpy.ops.mesh.contour_preset(preset=name) == {"FINISHED"}
    for key, value in parameters.preset_values(name).items():
        assert getattr(settings, key) == (pytest.approx(value) if isinstance(value, float) else value)
    assert settings.output == "SHARP"
    assert presets.MESH_OT_contour_preset.description(bpy.context, type("P", (), {"preset": name}))


def test_user_presets_are_saved_and_found_again(tmp_path, monkeypatch):
    monkeypatch.setattr(bpy.utils, "user_resource", lambda *_, path="", create=False: _made(tmp_path / path, create))
    settings = remembered()
    settings.width, settings.length_bias, settings.flow = 21, 0.75, "GATES"
    assert bpy.ops.mesh.contour_preset_add(name="My Own") == {"FINISHED"}
    (file,) = tmp_path.rglob("*.py")
    assert file.parent.name == presets.VIEW3D_PT_minimum_ratio_contours_presets.preset_subdir
    bpy.ops.mesh.contour_preset(preset="DEFAULT")
    assert settings.width != 21
    exec(compile(file.read_text(), str(file), "exec"), {})
    assert (settings.width, settings.length_bias, settings.flow) == (21, 0.75, "GATES")


def test_a_preset_that_cannot_be_saved_says_where_and_why(tmp_path, monkeypatch):
    monkeypatch.setattr(bpy.utils, "user_resource", lambda *_, path="", create=False: _made(tmp_path / path, create))
    taken = tmp_path / "presets" / presets.MESH_OT_contour_preset_add.preset_subdir / "My_Own.py"
    taken.mkdir(parents=True)
    with pytest.raises(RuntimeError, match=r"The preset cannot be saved in .*My_Own\.py: \w") as raised:
        bpy.ops.mesh.contour_preset_add(name="My Own")
    assert "Traceback" not in str(raised.value)


def _made(path, create):
    if create:
        Path(path).mkdir(parents=True, exist_ok=True)
    return str(path)


# ---- preferences


def test_preferences_are_the_defaults_of_all_settings(own):
    assert preferences.values(bpy.context).keys() >= parameters.SETTINGS.keys() | {"output", "merge"}
    for name, row in parameters.SETTINGS.items():
        value = row["default"]
        assert getattr(own, name) == (pytest.approx(value) if isinstance(value, float) else value)


def test_a_preference_takes_effect_immediately_but_not_for_scripts(own):
    own.output, own.width = "SEAM", 13
    assert (remembered().output, remembered().width) == ("SEAM", 13)
    remembered().width = 5
    bpy.ops.mesh.contour_preset(preset="DEFAULT")
    assert remembered().width == 13
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(START))
    bpy.ops.mesh.optimize_contour()
    assert not marked_edges(obj, "seam")
    bpy.ops.mesh.contour_defaults()
    assert (remembered().output, remembered().width) == ("SELECT", parameters.SETTINGS["width"]["default"])


@pytest.mark.parametrize("operator", panels.NETWORK_OPERATORS)
def test_preferences_apply_to_networks_too(operator, own):
    own.width, own.merge = 3, 0.25
    properties = remembered(operator)
    assert (properties.width, properties.merge) == (3, 0.25)


def test_a_preference_does_not_change_other_settings_in_the_sidebar(own):
    remembered().width, remembered().output = 20, "RIP"
    own.anchor = 1.0
    assert (remembered().width, remembered().output, remembered().anchor) == (20, "RIP", 1.0)


def test_the_buttons_for_networks_take_the_settings_of_the_sidebar():
    """They take every setting that the panels above show and the operator has."""
    obj = grooved_cylinder()
    edit(obj)
    layout = MagicMock()
    button = layout.operator.return_value = SimpleNamespace()
    panels.VIEW3D_PT_minimum_ratio_contours_networks.draw(SimpleNamespace(layout=layout), bpy.context)
    own, others = ({*remembered(name).bl_rna.properties.keys()} for name in (panels.OPERATOR, "mesh.optimize_seams"))
    assert vars(button).keys() == own & others - {"rna_type"}


def test_a_new_session_starts_from_the_preferences(own):
    own.width = 13
    remembered().width = 5
    preferences.unregister()
    preferences.register()
    assert remembered().width == 13
