# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages as users handle them: installing, disabling, enabling, upgrading and removing; installing the source."""

import io
from zipfile import ZIP_DEFLATED, ZipFile

import pytest
from conftest import ROOT

OLD = "0.0.9"  # the same length as the current version, so that replacing it in a compiled library is safe


def works(state, version):
    return state["problem"] == state["says"] == "" and state["version"] == state["library"] == version


def traces(profile):
    """The files in a profile that belong to the add-on, or to anything but Blender."""
    files = [path.relative_to(profile) for path in profile.rglob("*") if not path.is_dir()]
    own = ("extensions/.cache/", "extensions/user_default/.blender_ext/", "home/.cache/")
    return [str(path) for path in files if not str(path).startswith(own) or "contour" in path.name]


def test_package_installs_toggles_restarts_and_uninstalls_without_a_trace(blender, packages, version, tmp_path):
    installed, disabled, enabled = blender.run_steps(tmp_path, packages[blender.kind], "disable", "enable")
    assert works(installed, version)
    assert installed["library_file"].startswith(str(tmp_path))
    assert (disabled["installed"], disabled["enabled"], disabled["operator"]) == (True, False, False)
    assert works(enabled, version)
    assert traces(tmp_path)

    restarted, removed = blender.run_steps(tmp_path, "enable", "uninstall")
    assert works(restarted, version)
    assert (removed["installed"], removed["enabled"], removed["operator"]) == (False, False, False)
    assert traces(tmp_path) == []


def outdated(package, version):
    """The content of a package changed to an older version, including its compiled library and its wheel."""
    numbers = [str(tuple(map(int, text.split(".")))).encode() for text in (version, OLD)]
    content = io.BytesIO()
    with ZipFile(package) as given, ZipFile(content, "w", ZIP_DEFLATED) as made:
        for name in given.namelist():
            data = given.read(name)
            data = outdated(io.BytesIO(data), version) if name.endswith(".whl") else data.replace(*numbers)
            made.writestr(name.replace(version, OLD), data.replace(version.encode(), OLD.encode()))
    return content.getvalue()


def test_upgrade_while_the_old_library_is_loaded_asks_for_a_restart(blender, packages, version, tmp_path):
    old = tmp_path / packages[blender.kind].name.replace(version, OLD)
    old.write_bytes(outdated(packages[blender.kind], version))
    profile = tmp_path / "profile"

    before, upgraded = blender.run_steps(profile, old, packages[blender.kind])
    assert works(before, OLD)
    assert (upgraded["version"], upgraded["library"]) == (version, OLD)
    assert "restart Blender" in upgraded["problem"]
    assert upgraded["problem"] in upgraded["says"]

    assert works(blender.run_steps(profile, "enable")[0], version)
    assert not [path for path in profile.rglob("*") if OLD in path.name]


@pytest.fixture
def source(tmp_path):
    """The folder addon of the repository, zipped as users might do."""
    package = tmp_path / "minimum_ratio_contours.zip"
    with ZipFile(package, "w") as content:
        for path in (ROOT / "addon").rglob("*"):
            if path.is_file() and "__pycache__" not in path.parts:
                content.write(path, f"minimum_ratio_contours/{path.relative_to(ROOT / 'addon').as_posix()}")
    return package


def test_source_installed_by_mistake_says_what_to_do_and_the_package_fixes_it(
    blender, packages, version, source, tmp_path
):
    # Blender 4.2 and later take the source for an extension, which a legacy add-on does not replace.
    remove = ["uninstall"] if blender.has_extensions and blender.kind == "legacy" else []
    mistaken, *_, fixed = blender.run_steps(tmp_path / "profile", source, *remove, packages[blender.kind])
    assert mistaken["enabled"]
    assert "install the package made for your system and Python 3." in mistaken["problem"]
    assert ". " not in mistaken["problem"], "one sentence"
    assert mistaken["problem"] in mistaken["says"]
    assert works(fixed, version)
