# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery's jobs and files do what its page says, in this Blender. The pictures are not drawn."""

import importlib
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from minimum_ratio_contours import api
from minimum_ratio_contours.core.parameters import preset_values

SAMPLES = Path(__file__).resolve().parents[2] / "blend_samples"
sys.path.insert(0, str(SAMPLES))
blender_meshes = importlib.import_module("blender_meshes")
gallery = importlib.import_module("gallery")
report = importlib.import_module("report")
FAR = preset_values("FAR")


@pytest.mark.parametrize(
    ("job", "contours"), [("character_seams", 9), ("character_printed", 9), ("hand_segmentation", 5)]
)
def test_a_job_passes_its_own_checks_and_all_contours_improve(job, contours, monkeypatch, tmp_path):
    drawn = []
    monkeypatch.setattr(gallery.drawing, "draw_if_changed", lambda path, *_: drawn.append(path.name))
    rows = getattr(gallery, job)(SAMPLES / f"{gallery.JOBS[job]}.blend", tmp_path, api)
    lines = [dict(zip(report.COLUMNS, row)) for row in rows]
    assert [line["status"] for line in lines] == ["improved"] * contours
    assert all(float(line["ratio after"]) < float(line["ratio before"]) for line in lines)
    assert drawn == [f"{job}.png"]


def test_every_job_is_tested_and_on_the_page():
    page = (SAMPLES / "README.md").read_text(encoding="utf-8")
    assert set(gallery.JOBS) == {"character_seams", "character_printed", "hand_segmentation"}
    assert all(f"(pictures/{job}.png)" in page for job in gallery.JOBS)


def test_the_page_links_every_file_and_all_but_one_have_their_loops_selected():
    page = (SAMPLES / "README.md").read_text(encoding="utf-8")
    files = sorted(SAMPLES.glob("*.blend"))
    assert [path.name for path in files if f"]({path.name})" not in page] == []
    assert [path.stem for path in files if not has_selection(path)] == ["hand_parts"]


def has_selection(path):
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return any(edge.select for edge in bpy.context.view_layer.objects.active.data.edges)


@pytest.mark.parametrize("path", sorted(SAMPLES.glob("*.blend")), ids=lambda path: path.stem)
def test_a_sample_opens_with_everything_saved_in_it(path):
    """Blender 3.4 saved them; later releases store flags, selections and materials in other ways."""
    bpy.ops.wm.open_mainfile(filepath=str(path))
    mesh = bpy.context.view_layer.objects.active.data
    loops = blender_meshes.stored_loops(mesh, blender_meshes.ROUGH).values()
    rough = np.any([blender_meshes.edge_mask(mesh, loop) for loop in loops] or [np.zeros(len(mesh.edges))], axis=0)
    selected, seams, sharp = (flags(mesh.edges, name) for name in ("select", "use_seam", "use_edge_sharp"))
    assert (selected == rough).all()
    assert (seams == (selected if path.stem == "character" else False)).all()
    assert not sharp.any()
    assert flags(mesh.polygons, "use_smooth").all()
    materials = blender_meshes.read(mesh.polygons, "material_index", 1, np.int32)
    assert len(set(materials)) == (6 if path.stem == "hand_parts" else 1)


def flags(elements, name):
    return blender_meshes.read(elements, name, 1, bool)


@pytest.mark.parametrize(
    ("sample", "settings", "stay"),
    [
        ("hand", {}, {"index", "middle", "ring", "little", "thumb"}),
        ("hand", FAR, {"index", "middle", "little"}),
        ("hand", FAR | {"reach": 1.0}, {"index", "little"}),
        ("head", {}, {"ear", "neck"}),
        ("head", FAR, set()),
        ("torso", {}, set()),
        ("torso", FAR, {"shoulder"}),
    ],
)
def test_the_selected_loops_give_what_the_page_says(sample, settings, stay):
    """The loops named here do not end where the pictures show them: they stay, or stop earlier."""
    bpy.ops.wm.open_mainfile(filepath=str(SAMPLES / f"{sample}.blend"))
    ob = bpy.context.view_layer.objects.active
    pictured = {name: pictured_contour(ob, name) for name in blender_meshes.stored_loops(ob.data, blender_meshes.ROUGH)}
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.mesh.optimize_contour(**settings) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    found = positions(ob)[[vertex.index for vertex in ob.data.vertices if vertex.select]]
    near = 2 * blender_meshes.mean_edge_length(ob.data)
    assert {name for name, points in pictured.items() if mean_gap(points, found) > near} == stay


def pictured_contour(ob, name):
    """Return the contour for the settings stored with the loop, as in the pictures."""
    stored = ob.get(blender_meshes.SETTINGS + name)
    loop = blender_meshes.stored_loops(ob.data, blender_meshes.ROUGH)[name]
    return positions(ob)[list(api.optimize_contour(ob, loop, **(stored.to_dict() if stored else {})).vertices)]


def positions(ob):
    return blender_meshes.read(ob.data.vertices, "co", 3, np.float32)


def mean_gap(points, others):
    """Return the mean distance from each point to the nearest of the others."""
    return np.linalg.norm(points[:, None] - others[None], axis=2).min(axis=1).mean()
