# SPDX-License-Identifier: GPL-3.0-or-later
"""The redo panels show every property of their operator, once."""

from collections import Counter

import bpy
import pytest
from minimum_ratio_contours import adjust, network_operators, operators

OPERATORS = (
    operators.MESH_OT_optimize_contour,
    adjust.MESH_OT_adjust_contour,
    network_operators.MESH_OT_optimize_seams,
    network_operators.MESH_OT_optimize_segmentation,
)


class Layout:
    """Notes what is drawn into it and into its rows."""

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
    """Stands in for the operator: Blender makes those only itself."""

    def __init__(self, operator):
        self.layout = Layout()
        self.methods = operator
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
    assert shown.layout.drawn == Counter(names)


@pytest.mark.parametrize("operator", OPERATORS, ids=lambda operator: operator.__name__)
def test_every_property_has_a_tooltip(operator):
    shown = Shown(operator)
    for prop in shown.properties.bl_rna.properties:
        assert prop.description or prop.identifier == "rna_type", prop.identifier
