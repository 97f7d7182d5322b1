# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery's jobs do what its page says, in this Blender; only the pictures are left out."""

import importlib
import sys
from pathlib import Path

import pytest
from minimum_ratio_contours import api

SAMPLES = Path(__file__).resolve().parents[2] / "blend_samples"
sys.path.insert(0, str(SAMPLES))
gallery = importlib.import_module("gallery")
report = importlib.import_module("report")


@pytest.mark.parametrize(
    ("job", "contours"), [("character_seams", 9), ("character_printed", 9), ("hand_segmentation", 5)]
)
def test_a_job_passes_its_own_checks_and_all_contours_get_better(job, contours, monkeypatch, tmp_path):
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
