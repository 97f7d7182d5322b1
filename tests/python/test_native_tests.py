# SPDX-License-Identifier: GPL-3.0-or-later
"""Every stage of the native library has a test file that bears its name."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
STAGES = {path.stem for path in (ROOT / "native/src").iterdir() if path.suffix in (".cpp", ".h")}
TESTS = {path.name.removesuffix("_test.cpp") for path in (ROOT / "tests/native").glob("*_test.cpp")}
# Files that are a part of a stage, or have no behavior of their own, with the test file that covers them.
PARTS = {
    "band_front": "band",
    "beat": "progress_monitor",
    "checked_contour": "patch",
    "checked_input": "measure",
    "directed_segments": "graph",
    "edge_obstacles": "patch",
    "element_names": "errors",
    "exclude_segments": "graph",
    "exclusion": "partition",
    "graph_input": "graph",
    "incumbent": "ratio",
    "input_range": "options",
    "label_search": "ratio",
    "lens": "ratio",
    "objective": "ratio",
    "open_ends": "graph",
    "plane": "triangulate",
    "relaxation": "ratio",
    "required_chords": "graph",
    "search_space": "line_graph",
    "start_line": "strip_flow",
    "strip": "strip_flow",
    "strip_gates": "strip_flow",
    "strips": "strip_flow",
    "surface_arrays": "surface",
    "topological_order": "graph",
    "types": "surface_point",
}


def test_every_stage_has_a_test_file_of_its_name():
    assert sorted(STAGES - PARTS.keys() - TESTS) == []


def test_parts_are_files_of_the_library_and_are_covered():
    assert PARTS.keys() <= STAGES
    assert set(PARTS.values()) <= TESTS
    assert not PARTS.keys() & TESTS
