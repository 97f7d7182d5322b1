# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the documents' example scripts and the README's first contour in this Blender, with the files they name."""

import re
from pathlib import Path

import bpy
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


def run_example(page):
    """Run the only Blender script of a page and return its variables."""
    (code,) = re.findall(r"```python\n(import bpy\n.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)
    names = {}
    exec(compile(code, page, "exec"), names)  # noqa: S102
    return names


@pytest.fixture(autouse=True)
def _from_the_repository(monkeypatch):
    monkeypatch.chdir(ROOT)


def seams():
    mesh = bpy.data.objects["character"].data
    return {frozenset(edge.vertices) for edge in mesh.edges if edge.use_seam}


def materials():
    mesh = bpy.context.view_layer.objects.active.data
    return [polygon.material_index for polygon in mesh.polygons]


def test_the_example_for_scripts_moves_the_seams():
    bpy.ops.wm.open_mainfile(filepath="blend_samples/character.blend")
    rough, names = seams(), run_example("README.md")
    assert len(names["results"]) == 9
    assert all(seam.ratio < seam.initial_ratio for seam in names["results"])
    sides = [np.stack([seam.vertices, np.roll(seam.vertices, -1)], axis=1) for seam in names["results"]]
    assert seams() == {frozenset(side) for side in np.concatenate(sides).tolist()} != rough


def test_the_example_in_the_manual_moves_the_borders_of_materials():
    bpy.ops.wm.open_mainfile(filepath="blend_samples/hand_parts.blend")
    ragged, names = materials(), run_example("addon/README.md")
    assert [border.status for border in names["borders"]] == ["improved"] * 5
    assert materials() != ragged


def test_the_first_contour_moves():
    (file,) = re.findall(r"open `(\S+\.blend)`", (ROOT / "README.md").read_text(encoding="utf-8"))
    bpy.ops.wm.open_mainfile(filepath=file)
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.mesh.optimize_contour() == {"FINISHED"}
    assert bpy.context.window_manager.minimum_ratio_contours.contours[0].status == "improved"
