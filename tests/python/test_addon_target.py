# SPDX-License-Identifier: GPL-3.0-or-later
"""A package for another platform or Python says so in one sentence, and what to install instead."""

import importlib
import platform
import sys
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
native = importlib.import_module("addon.core.native")
target = importlib.import_module("addon.core.target")

# What a package for this system and this Python would be for.
HERE = target.mismatch("vax-vms-cp27").partition("whose name has ")[2].replace(" and ", "-")


@pytest.fixture
def on(monkeypatch):
    """Pretends to be another system with another Python."""

    def pretend(system, machine, python):
        monkeypatch.setattr(sys, "platform", system)
        monkeypatch.setattr(platform, "machine", lambda: machine)
        monkeypatch.setattr(sys, "version_info", type("Version", (), {"major": 3, "minor": python}))

    return pretend


def test_package_for_another_system_names_both_and_what_to_install(on):
    on("linux", "x86_64", 13)
    assert target.mismatch("windows-x64-cp311") == (
        "This package is for Windows x64 and Python 3.11, this Blender runs on Linux x64 with Python 3.13: "
        "install the package whose name has linux-x64 and cp313"
    )


def test_package_for_two_pythons_names_both(on):
    on("darwin", "arm64", 13)
    assert "is for macOS x64 and Python 3.10 or 3.11, this Blender runs on macOS arm64 with Python 3.13" in (
        target.mismatch("macos-x64-cp310-cp311")
    )


@pytest.mark.parametrize(
    ("system", "machine", "name"),
    [
        ("linux", "x86_64", "linux-x64"),
        ("linux", "aarch64", "linux-arm64"),
        ("win32", "AMD64", "windows-x64"),
        ("win32", "ARM64", "windows-arm64"),
        ("darwin", "x86_64", "macos-x64"),
        ("darwin", "arm64", "macos-arm64"),
    ],
)
def test_platforms_have_the_names_in_package_files(on, system, machine, name):
    on(system, machine, 11)
    assert target.mismatch(f"{name}-cp310-cp311") == ""
    assert f"whose name has {name} and cp311" in target.mismatch(f"{name}-cp310-cp313")
    assert f"whose name has {name} and cp311" in target.mismatch("plan9-mips-cp311")


def without_module(monkeypatch, tmp_path, made_for):
    monkeypatch.setitem(sys.modules, "mrcontour", None)
    monkeypatch.setattr(native, "__file__", str(tmp_path / "core" / "native.py"))
    monkeypatch.setattr(native, "TARGET", made_for)


def test_the_module_of_another_system_is_reported_when_it_is_missing(monkeypatch, tmp_path):
    without_module(monkeypatch, tmp_path, "plan9-mips-cp311")
    assert native.problem() == target.mismatch("plan9-mips-cp311") != ""


def test_a_module_missing_from_the_right_package_asks_to_install_it_again(monkeypatch, tmp_path):
    without_module(monkeypatch, tmp_path, HERE)
    assert native.problem() == "The compiled library is missing from this package: install it again"


@pytest.fixture
def broken(monkeypatch, tmp_path):
    """A file that is found, but is no library: as a Mac finds that of the other processor."""
    (tmp_path / f"mrcontour{EXTENSION_SUFFIXES[-1]}").write_bytes(b"no library")
    monkeypatch.delitem(sys.modules, "mrcontour")
    monkeypatch.syspath_prepend(tmp_path)


def test_a_module_of_the_other_processor_is_reported_when_it_does_not_load(monkeypatch, broken):
    monkeypatch.setattr(native, "TARGET", "macos-x64-cp311")
    assert native.problem() == target.mismatch("macos-x64-cp311")


def test_a_module_that_does_not_load_is_reported_in_one_line(monkeypatch, broken):
    for made_for in ("", HERE):
        monkeypatch.setattr(native, "TARGET", made_for)
        assert native.problem().startswith("The compiled library does not load: ")
        assert "\n" not in native.problem()
