# SPDX-License-Identifier: GPL-3.0-or-later
"""The selection of the C++ files that the usual lint checks."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from clang_tidy import Includes, chosen_units, report  # noqa: E402


@pytest.fixture
def files(tmp_path):
    texts = {
        "low.h": "#include <vector>\n",
        "high.h": '#include "low.h"\n',
        "low.cpp": '#include "low.h"\n',
        "high.cpp": '#include "sub/../high.h"\n#include "high.h"\n',
        "other.cpp": "#include <lower.h>\n",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def chosen(files, *changed):
    units, includes = sorted(files.glob("*.cpp")), Includes(files.glob("*.h"))
    return [unit.name for unit in chosen_units(units, includes, {files / name for name in changed})]


def test_changed_header_selects_all_includers_its_own_source_first(files):
    assert chosen(files, "low.h") == ["low.cpp", "high.cpp"]
    assert chosen(files, "high.h") == ["high.cpp"]


def test_changed_files_come_first(files):
    assert chosen(files, "high.cpp") == ["high.cpp"]
    assert chosen(files, "low.h", "high.cpp") == ["high.cpp", "low.cpp"]


def test_no_changes_select_no_files(files):
    assert chosen(files) == chosen(files, "README.md") == []


def test_files_left_for_another_run_count_as_skipped(tmp_path):
    report(tmp_path / "a.xml", {"good.cpp": None, "bad.cpp": "a finding", "left.cpp": ""}, "abc")
    text = (tmp_path / "a.xml").read_text()
    assert 'tests="3" failures="1" skipped="1"' in text
    report(tmp_path / "a.xml", {}, "abc")
    assert 'tests="1" failures="0" skipped="0"' in (tmp_path / "a.xml").read_text()
