# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples in the documentation run and do what they say, its links lead somewhere, and the files that it names
exist. Examples for Blender are run by tests/blender."""

import re
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
README, WHEEL_PAGE, ADDON_PAGE = ROOT / "README.md", ROOT / "native/python/README.md", ROOT / "addon/README.md"
FOLDERS = (".github", "addon", "blend_samples", "native", "tests")
PAGES = sorted([*ROOT.glob("*.md"), *(page for folder in FOLDERS for page in (ROOT / folder).rglob("*.md"))])
PNG = b"\x89PNG\r\n\x1a\n"


def name(page):
    return page.relative_to(ROOT).as_posix()


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


def examples(page):
    return [code for code in blocks(page, "python") if "import bpy" not in code]


def executed(page, codes, names):
    for code in codes:
        exec(compile(code, name(page), "exec"), names)  # noqa: S102
    return names


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Runs examples of a page one after another, in a temporary folder and without a screen. Returns their
    variables."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    return lambda page, codes: executed(page, codes, {})


def test_every_page_with_examples_is_tested():
    assert {page for page in PAGES if blocks(page, "python")} == {README, WHEEL_PAGE, ADDON_PAGE}
    assert examples(ADDON_PAGE) == []


def test_readme_example_finds_the_waist_and_plots_it(run, tmp_path):
    names = run(README, examples(README))
    assert names["result"].status == "improved"
    assert np.allclose(names["result"].positions[:, 2], 0.2)
    assert (tmp_path / "waist.png").read_bytes().startswith(PNG)


def test_wheel_page_examples_do_what_they_say(run):
    first, several, across, *_ = examples(WHEEL_PAGE)
    names = run(WHEEL_PAGE, [first, several, across])
    assert set(names["result"].vertices // 24) == {11}
    said = re.search(r"# (\S+) (\(.*\))\n", several)
    assert np.isclose(names["near"].positions[0, 2], float(said[1]))
    assert str(names["far"].held_back_by) == said[2]
    assert 24 * 12 + 5 in names["across"].vertices


def test_wheel_page_examples_of_settings_and_errors_run(run, capsys):
    run(WHEEL_PAGE, examples(WHEEL_PAGE))
    said = re.search(r"# (\[.*\])\n", examples(WHEEL_PAGE)[-1])
    assert capsys.readouterr().out.splitlines()[-1] == said[1]


def test_readme_cpp_lines_are_part_of_a_built_program():
    program = (ROOT / "tests/install/main.cpp").read_text(encoding="utf-8")
    (code,) = blocks(README, "cpp")
    assert [line for line in code.splitlines() if line not in [known.strip() for known in program.splitlines()]] == []


def test_cmake_lines_are_part_of_a_built_project():
    project = (ROOT / "tests/install/CMakeLists.txt").read_text(encoding="utf-8").splitlines()
    (code,) = blocks(ROOT / "native/README.md", "cmake")
    assert [line for line in code.splitlines() if line not in project] == []


def test_readme_is_short():
    assert len(README.read_text(encoding="utf-8").splitlines()) <= 150


def anchors(page):
    """The anchors that GitHub generates from headings."""
    titles = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def leads_somewhere(page, link):
    path, _, anchor = link.partition("#")
    target = (page.parent / path).resolve() if path else page
    return target.exists() and (not anchor or anchor in anchors(target))


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_links_lead_somewhere(page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    relative = [link for link in re.findall(r"\]\(([^)]+)\)", text) if "://" not in link]
    assert [link for link in relative if not leads_somewhere(page, link)] == []


def files():
    """The paths of the tree's files, each with a slash before it."""
    listed = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*")]
    return [f"/{name(path)}" for path in [*listed, *ROOT.glob("*")] if path.is_file()]


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_files_that_a_page_names_exist(page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    if page.name == "CHANGELOG.md":
        text = re.sub(r"^\|[^|]*\|", "|", text, flags=re.MULTILINE)  # the columns of old names
    named = re.findall(r"`<?([\w./]+\.(?:py|h|cpp|toml))>?`", text)
    named += re.findall(r"`\./([\w/]+)", text)  # scripts
    known = files()
    assert [file for file in named if not any(path.endswith(f"/{file}") for path in known)] == []


@pytest.mark.parametrize("page", [README, ROOT / "blend_samples/README.md"], ids=name)
def test_pictures_of_a_page_exist(page):
    assert re.findall(r"!\[[^\]]*\]\([^)]+\.png\)", page.read_text(encoding="utf-8"))


def test_handwritten_end_of_the_benchmark_table_is_kept(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "native/bench"))
    table = __import__("table")
    assert table.TABLE.read_text(encoding="utf-8").endswith("\n\n" + table.explanations() + "\n")
    assert "## What the figures mean" in table.explanations()


def test_gallery_files_are_small():
    files = sorted((ROOT / "blend_samples").glob("*.blend"))
    assert "character.blend" in [file.name for file in files]
    assert not [file.name for file in files if file.stat().st_size >= 2**20]
