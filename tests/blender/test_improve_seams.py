# SPDX-License-Identifier: GPL-3.0-or-later
"""The example script in this Blender: it reads a file, improves the seams, prints JSON and writes a file, or fails."""

import importlib
import json
import re
import shlex
import sys
from pathlib import Path
from types import SimpleNamespace

import bpy
import pytest
from made_meshes import GROOVE, START, edge_set, edit, grooved_cylinder, mark_edges, pairs, ring

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "blend_samples"))
ROOT = Path(__file__).resolve().parents[2]
improve_seams = importlib.import_module("improve_seams")


@pytest.fixture
def files(tmp_path):
    """A .blend file with a rough seam, a mesh without seams and a second user of the first mesh; and an output path."""
    obj = grooved_cylinder()
    edit(obj)
    mark_edges(obj, pairs(START), "seam")
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Twin", obj.data))
    grooved_cylinder("Plain")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "in.blend"), copy=True)
    return tmp_path / "in.blend", tmp_path / "out.blend"


def run(monkeypatch, capfd, *arguments):
    """Run the script and return its exit code and the printed summary."""
    monkeypatch.setattr(sys, "argv", ["blender", "--", *map(str, arguments)])
    code = improve_seams.main()
    (line,) = (line for line in capfd.readouterr().out.splitlines() if line.startswith("{"))
    return code, json.loads(line)


def seams(path):
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)
    mesh = bpy.data.objects["Cylinder"].data
    return {frozenset(edge.vertices) for edge in mesh.edges if edge.use_seam}


def test_seams_move_in_the_output_file(files, monkeypatch, capfd):
    given, written = files
    code, summary = run(monkeypatch, capfd, given, written, "--width", 10)
    assert code == 0
    assert summary["output"] == str(written)
    found = {entry["object"]: entry["seams"] for entry in summary["objects"]}
    assert found.keys() == {"Cylinder", "Plain"}
    (seam,) = found["Cylinder"]
    assert seam["status"] == "improved"
    assert seam["ratio"] < seam["initial_ratio"]
    assert found["Plain"] == []
    assert seams(written) == edge_set(ring(GROOVE))
    assert seams(given) == edge_set(START)


def test_a_sample_keeps_no_old_seams_for_later_releases(tmp_path, monkeypatch, capfd):
    written = tmp_path / "out.blend"
    assert run(monkeypatch, capfd, ROOT / "blend_samples" / "character.blend", written)[0] == 0
    bpy.ops.wm.open_mainfile(filepath=str(written), load_ui=False)
    mesh = bpy.data.objects["character"].data
    seams = [edge.use_seam for edge in mesh.edges]
    copy = mesh.attributes.get("uv_seam") or mesh.attributes.get(".uv_seam")
    assert any(seams)
    assert not copy or [seam.value for seam in copy.data] == seams


@pytest.mark.parametrize("page", ["README.md", "addon/README.md"])
def test_the_command_line_in_the_manual(page, files, monkeypatch, capfd):
    given, written = files
    text = (ROOT / page).read_text(encoding="utf-8")
    (line,) = re.findall(r"^    (blender .*improve_seams.py.*)$", text, re.MULTILINE)
    words = shlex.split(line)
    assert (ROOT / words[words.index("--python") + 1]).samefile(improve_seams.__file__)
    places = {"in.blend": given, "out.blend": written}
    arguments = [places.get(word, word) for word in words[words.index("--") + 1 :]]
    code, summary = run(monkeypatch, capfd, *arguments)
    assert (code, summary["output"]) == (0, str(written))
    assert seams(written) == edge_set(ring(GROOVE))


def test_only_named_objects_are_changed(files, monkeypatch, capfd):
    code, summary = run(monkeypatch, capfd, *files, "--object", "Plain")
    assert (code, [entry["object"] for entry in summary["objects"]]) == (0, ["Plain"])
    assert seams(files[1]) == edge_set(START)


def test_failures_write_nothing_and_say_why(files, monkeypatch, capfd):
    given, written = files
    for arguments, words in (
        ((given, written, "--object", "Nope"), "no object named Nope"),
        ((given.with_name("missing.blend"), written), "missing.blend"),
    ):
        code, summary = run(monkeypatch, capfd, *arguments)
        assert (code, written.exists()) == (1, False)
        assert words in summary["error"]


def test_nothing_is_written_if_one_mesh_fails(files, monkeypatch, capfd):
    def refuse(obj, **_):
        raise ValueError(f"{obj.name} is refused")

    monkeypatch.setattr("minimum_ratio_contours.api.optimize_seams", refuse)
    code, summary = run(monkeypatch, capfd, *files)
    assert (code, files[1].exists(), summary["output"]) == (1, False, None)
    assert "Cylinder: Cylinder is refused" in summary["error"]


def test_an_unexpected_exception_is_a_failure(files, monkeypatch, capfd):
    monkeypatch.setattr("minimum_ratio_contours.api.optimize_seams", lambda obj, **_: 1 / 0)
    code, summary = run(monkeypatch, capfd, *files)
    assert (code, files[1].exists()) == (1, False)
    assert summary["error"].startswith("ZeroDivisionError")


def test_unknown_settings_are_refused(files, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["blender", "--", *map(str, files), "--widht", "3"])
    with pytest.raises(SystemExit) as caught:
        improve_seams.main()
    assert caught.value.code != 0


@pytest.mark.parametrize("name", ["minimum_ratio_contours", "bl_ext.user_default.minimum_ratio_contours"])
@pytest.mark.parametrize("enabled", [False, True])
def test_both_kinds_of_installation_are_found(name, enabled, monkeypatch):
    enabled_modules = []
    others = [SimpleNamespace(__name__=other) for other in ("io_scene_fbx", name, "not_minimum_ratio_contours")]
    monkeypatch.setattr(improve_seams.addon_utils, "modules", lambda: others)
    monkeypatch.setattr(improve_seams.addon_utils, "check", lambda _: (enabled, enabled))
    monkeypatch.setattr(improve_seams.addon_utils, "enable", lambda module: enabled_modules.append(module) or True)
    assert improve_seams.addon_module() == name
    assert enabled_modules == ([] if enabled else [name])


def test_a_missing_addon_is_reported(monkeypatch, capfd):
    monkeypatch.setattr(improve_seams.addon_utils, "modules", lambda: [])
    code, summary = run(monkeypatch, capfd, "in.blend", "out.blend")
    assert (code, summary["error"]) == (1, "the add-on minimum_ratio_contours is not installed")
