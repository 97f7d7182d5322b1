# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's example for scripts, in this Blender, and the gallery's files that it and the README name."""

import re
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]


def seams():
    mesh = bpy.data.objects["character"].data
    return {frozenset(edge.vertices) for edge in mesh.edges if edge.use_seam}


def test_the_example_for_scripts_moves_the_seams(monkeypatch):
    monkeypatch.chdir(ROOT)
    (code,) = re.findall(r"```python\n(import bpy\n.*?)```", Path("README.md").read_text(encoding="utf-8"), re.DOTALL)
    bpy.ops.wm.open_mainfile(filepath="blend_samples/character.blend")
    rough, names = seams(), {}
    exec(compile(code, "README.md", "exec"), names)  # noqa: S102
    assert len(names["results"]) == 9
    assert all(seam.ratio < seam.initial_ratio for seam in names["results"])
    sides = [np.stack([seam.vertices, np.roll(seam.vertices, -1)], axis=1) for seam in names["results"]]
    assert seams() == {frozenset(side) for side in np.concatenate(sides).tolist()} != rough
