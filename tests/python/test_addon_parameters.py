# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's settings table against the native options, and its version against the module's, without Blender."""

import ast
import importlib
import re
import sys
from pathlib import Path

import mrcontour as mrc
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
parameters = importlib.import_module("addon.core.parameters")
native = importlib.import_module("addon.core.native")


def choices(row):
    """Return values of a setting that a user can choose, including the extremes."""
    if "items" in row:
        return [item[0] for item in row["items"]]
    return [row["min"], row.get("max", row.get("soft_max"))] if "min" in row else [False, True]


REACHABLE = [(name, value) for name, row in parameters.SETTINGS.items() for value in choices(row)]


@pytest.mark.parametrize(("name", "value"), REACHABLE)
def test_every_value_of_a_setting_is_a_native_option(name, value):
    mrc.Options(**parameters.native_options(**{name: value}))


@pytest.mark.parametrize("name", parameters.SETTINGS)
def test_no_setting_is_dead(name):
    row = parameters.SETTINGS[name]
    other = next(value for value in choices(row) if value != row["default"])
    others = {} if name == "refinement" else {"refinement": 1}  # without it nothing needs iterations along edges first
    assert parameters.native_options(**{name: other}, **others) != parameters.native_options(**others)


def test_without_refinement_there_are_no_regular_iterations():
    assert parameters.native_options(regular_iterations=5)["regular_iterations"] == 0


def test_the_whole_surface_has_no_width():
    assert parameters.native_options(width=7, whole_surface=True)["width"] is None
    assert parameters.native_options(width=7)["width"] == 7


def test_an_unknown_setting_is_refused_by_name():
    with pytest.raises(TypeError, match="widht"):
        parameters.native_options(widht=4)


def versions(addon):
    """Return the versions in the manifest and in bl_info of a folder."""
    manifest = (addon / "blender_manifest.toml").read_text(encoding="utf-8")
    (version,) = re.findall(r'^version = "(.*)"', manifest, re.MULTILINE)  # Python 3.10 has no tomllib
    (info,) = (
        ast.literal_eval(node.value)
        for node in ast.parse((addon / "__init__.py").read_text(encoding="utf-8")).body
        if isinstance(node, ast.Assign) and node.targets[0].id == "bl_info"
    )
    return {version, ".".join(map(str, info["version"]))}


def test_the_version_has_one_home():
    cmake = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    assert [mrc.__version__] == re.findall(r"^project\(.* VERSION (\S+)", cmake, re.MULTILINE)
    assert versions(ROOT / "addon") == {native.VERSION} == {"0.0.0"}


def test_the_build_lays_out_the_add_on_with_the_version():
    addon = Path(mrc.__file__).parent / "addons" / "minimum_ratio_contours"
    if not addon.exists():
        pytest.skip("the module is a wheel's")
    assert versions(addon) == {mrc.__version__}


def test_the_module_is_found():
    assert native.module() is mrc
    assert native.problem() == ""


def test_a_missing_module_is_reported(monkeypatch):
    monkeypatch.setitem(sys.modules, "mrcontour", None)
    assert "its source, without the compiled library" in native.problem()


def test_a_module_for_another_python_is_reported(monkeypatch, tmp_path):
    (tmp_path / "mrcontour.cpython-399-x86_64-linux-gnu.so").touch()
    monkeypatch.setattr(native, "__file__", str(tmp_path / "core" / "native.py"))
    monkeypatch.setitem(sys.modules, "mrcontour", None)
    assert "cpython-399" in native.problem()


def test_a_module_that_does_not_load_is_reported(monkeypatch, tmp_path):
    (tmp_path / "mrcontour.py").write_text("import a_module_that_is_not_there")
    monkeypatch.delitem(sys.modules, "mrcontour")
    monkeypatch.syspath_prepend(tmp_path)
    assert "a_module_that_is_not_there" in native.problem()


def test_another_version_asks_for_a_restart(monkeypatch):
    monkeypatch.setattr(native, "VERSION", "0.0.1")
    with pytest.raises(native.Unavailable, match="restart Blender"):
        native.module()


def test_the_defaults_are_the_recommended_options():
    assert mrc.Options(**parameters.native_options()) == mrc.Options.recommended()
