# SPDX-License-Identifier: GPL-3.0-or-later
"""The redo panels show every property of their operator exactly once."""

from collections import Counter

import bpy
import pytest
from minimum_ratio_contours.ui import adjust, network_operators, operators

OPERATORS = (
    operators.MESH_OT_optimize_contour,
    adjust.MESH_OT_adjust_contour,
    network_operators.MESH_OT_optimize_seams,
    network_operators.MESH_OT_optimize_segmentation,
)


FOLDS = Counter(operators.Folds.__annotations__.keys())


class Layout:
    """A layout that records what is drawn into it and its rows."""

    def __init__(self):
        self.drawn = Counter()

    def row(self, **_):
        return self

    column = row

    def separator(self):
        pass

    label = row

    def prop(self, _, name, **__):
        self.drawn[name] += 1

    def prop_search(self, _, name, *others):
        self.drawn[name] += 1


class Shown:
    """Stands in for the operator, which only Blender can create."""

    def __init__(self, operator, unfolded=True):
        self.layout = Layout()
        self.methods = operator
        self.show_more = self.show_constraints = unfolded
        self.properties = bpy.context.window_manager.operator_properties_last(operator.bl_idname)

    def __getattr__(self, name):
        if hasattr(self.methods, name) and callable(getattr(self.methods, name)):
            return getattr(self.methods, name).__get__(self)
        return getattr(self.properties, name)


@pytest.mark.parametrize("operator", OPERATORS, ids=lambda operator: operator.__name__)
def test_every_property_is_shown_once(operator):
    bpy.ops.mesh.primitive_cube_add()
    shown = Shown(operator)
    operator.draw(shown, bpy.context)
    names = {prop.identifier for prop in shown.properties.bl_rna.properties if not prop.is_hidden} - {"rna_type"}
    assert {"width", "min_salience"} < names
    assert shown.layout.drawn - FOLDS == Counter(names)


@pytest.mark.parametrize("operator", OPERATORS[:2], ids=lambda operator: operator.__name__)
def test_the_folded_panel_shows_only_the_main_settings(operator):
    bpy.ops.mesh.primitive_cube_add()
    folded, unfolded = Shown(operator, unfolded=False), Shown(operator)
    for shown in (folded, unfolded):
        operator.draw(shown, bpy.context)
    assert {"output", "width", *FOLDS} < folded.layout.drawn.keys()
    assert len(folded.layout.drawn) <= 15 < len(unfolded.layout.drawn)


@pytest.mark.parametrize("operator", OPERATORS, ids=lambda operator: operator.__name__)
def test_every_property_has_a_tooltip(operator):
    shown = Shown(operator)
    for prop in shown.properties.bl_rna.properties:
        assert prop.description or prop.identifier == "rna_type", prop.identifier
