# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's Python examples do what they say; those for Blender are tests/blender's."""

import re
from pathlib import Path

import numpy as np
import pytest

README = Path(__file__).resolve().parents[2] / "README.md"
PNG = b"\x89PNG\r\n\x1a\n"


def examples():
    code = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    return [example for example in code if "import bpy" not in example]


@pytest.fixture
def run(tmp_path, monkeypatch):
    """The names that the examples leave, one after the other, in a folder of their own and without a screen."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    names = {}
    for code in examples():
        exec(compile(code, "README.md", "exec"), names)  # noqa: S102
    return names


def test_there_are_examples():
    first, second = examples()
    assert "import mrcontour" in first
    assert "optimize_all" in second


def test_the_example_for_the_module_finds_the_waist_and_plots_it(run, tmp_path):
    assert run["result"].status == "improved"
    assert np.allclose(run["result"].positions[:, 2], 0.2)
    assert (tmp_path / "waist.png").read_bytes().startswith(PNG)


def test_the_example_for_several_contours_says_what_comes_out(run):
    said = re.search(r"# (\S+) (\(.*\))\n", examples()[1])
    assert np.isclose(run["near"].positions[0, 2], float(said[1]))
    assert str(run["far"].held_back_by) == said[2]


@pytest.mark.parametrize("page", [README, README.parent / "blend_samples" / "README.md"], ids=["readme", "gallery"])
def test_what_a_page_links_to_is_there(page):
    linked = re.findall(r"\]\(([^)#]+)\)", page.read_text(encoding="utf-8"))
    assert linked
    assert not [link for link in linked if not (page.parent / link).exists()]


def test_the_gallery_s_files_are_small():
    files = sorted((README.parent / "blend_samples").glob("*.blend"))
    assert "character.blend" in [file.name for file in files]
    assert not [file.name for file in files if file.stat().st_size >= 2**20]
