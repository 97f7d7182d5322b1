# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages as users handle them: installing, disabling, enabling, upgrading and removing; installing the source."""

import io
import os
from zipfile import ZIP_DEFLATED, ZipFile

import packages as maker
import pytest
from conftest import ROOT, wheel_of

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
    assert installed["library_file"].removeprefix("Z:").startswith(str(tmp_path))  # under Wine, Z: is the root folder
    assert (disabled["installed"], disabled["enabled"], disabled["operator"]) == (True, False, False)
    assert works(enabled, version)
    assert traces(tmp_path)

    restarted, removed = blender.run_steps(tmp_path, "enable", "uninstall")
    assert works(restarted, version)
    assert (removed["installed"], removed["enabled"], removed["operator"]) == (False, False, False)
    if blender.system == "Windows":  # where a library in use is removed when Blender starts the next time
        blender.run_steps(tmp_path, "look")
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


@pytest.fixture
def old(blender, packages, version, tmp_path):
    """The package, as an older version."""
    package = tmp_path / packages[blender.kind].name.replace(version, OLD)
    package.write_bytes(outdated(packages[blender.kind], version))
    return package


def test_upgrade_while_the_old_library_is_loaded_asks_for_a_restart(blender, packages, version, old, tmp_path):
    if blender.name == "windows-extension":
        pytest.skip("Blender's extensions cannot replace a library in use on Windows: see the next test")
    profile = tmp_path / "profile"

    before, upgraded = blender.run_steps(profile, old, packages[blender.kind])
    assert works(before, OLD)
    assert (upgraded["version"], upgraded["library"]) == (version, OLD)
    assert "restart Blender" in upgraded["problem"]
    assert upgraded["problem"] in upgraded["says"]

    assert works(blender.run_steps(profile, "enable")[0], version)
    assert not [path for path in profile.rglob("*") if OLD in path.name]


def test_upgrade_while_the_old_library_is_loaded_works_after_a_restart_or_when_repeated_then(
    blender, packages, version, old, tmp_path
):
    profile = tmp_path / "profile"
    assert works(blender.run_steps(profile, old, f"attempt:{packages[blender.kind]}")[0], OLD)

    (restarted,) = blender.run_steps(profile, "enable")
    missing = "The compiled library is missing from this package: install it again"
    assert works(restarted, version) or restarted["problem"] == missing
    assert restarted["problem"] in restarted["says"]

    assert works(*blender.run_steps(profile, packages[blender.kind]), version)


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


# For each system another: the tag of its wheels, and its name.
FOREIGN = {"Linux": ("win_amd64", "Windows"), "Windows": ("manylinux_2_28_x86_64", "Linux")}


def test_legacy_add_on_of_another_system_says_what_to_install(blender, tmp_path):
    platform, system = FOREIGN[blender.system]
    foreign = maker.build_legacy([wheel_of(tmp_path, "cp310", platform)], tmp_path)
    (state,) = blender.run_steps(tmp_path / "profile", foreign)
    wanted = f"This package is for {system} x64 and Python 3.10, this Blender runs on {blender.system} "
    assert state["problem"].startswith(wanted)
    assert f": install the package whose name has {blender.system.lower()}-" in state["problem"]
    assert ". " not in state["problem"], "one sentence"
    assert state["problem"] in state["says"]


@pytest.mark.parametrize("python", ["cp311", "cp313"])
def test_blender_itself_refuses_an_extension_of_another_system(extension_blender, tmp_path, python):
    platform, _ = FOREIGN[extension_blender.system]
    foreign = maker.build_extension([wheel_of(tmp_path, python, platform)], tmp_path, extension_blender.tool)
    (state,) = extension_blender.run_steps(tmp_path / "profile", foreign)
    assert not state["installed"]


ANOTHER = "another_copy"


@pytest.fixture
def another(packages, tmp_path):
    """A legacy add-on with the same files in a folder of another name."""
    package = tmp_path / "another.zip"
    with ZipFile(packages["legacy"]) as given, ZipFile(package, "w") as made:
        for name in given.namelist():
            made.writestr(name.replace(maker.ID, ANOTHER, 1), given.read(name))
    return package


def test_second_copy_waits_until_the_first_is_disabled(blender, packages, version, another, tmp_path):
    steps = [another, f"disable:{ANOTHER}", f"enable:{ANOTHER}", "disable", "enable", f"disable:{ANOTHER}"]
    states = blender.run_steps(tmp_path / "profile", packages[blender.kind], *steps)
    assert {state["problem"] or state["says"] for state in states} == {""}
    assert all(works(state, version) for state in states)

    first = states[0]["module"]
    assert [state["module"] for state in states] == [first, first, first, first, ANOTHER, ANOTHER, first]
    alone, both, one, again, other, changed, last = (state["notes"] for state in states)
    assert list(map(len, (alone, both, one, again, other, changed, last))) == [1, 2, 1, 2, 1, 2, 1]
    for notes in (alone, one, other, last):
        assert set(notes.values()) == {""}
    for notes, active in ((both, first), (again, first), (changed, ANOTHER)):
        for name, note in notes.items():
            idle = "the other" if name == active else "this"
            assert note.startswith(
                f"This add-on is enabled twice, and {idle} copy does nothing: disable one of the two"
            )


def test_profile_with_spaces_and_letters_of_any_language(blender, packages, version, tmp_path):
    profile = tmp_path / "Mein Größen-Ordner 輪郭 (it's 1)"
    states = blender.run_steps(profile, packages[blender.kind], "disable", "enable")
    assert works(states[0], version)
    assert works(states[2], version)
    assert works(*blender.run_steps(profile, "enable"), version)


@pytest.fixture
def read_only():
    """Takes the right to write away from a folder and everything in it, until the end of the test."""
    changed = []

    def protect(folder):
        for path in [folder, *folder.rglob("*")]:
            if not path.is_symlink():
                changed.append((path, path.stat().st_mode))
                path.chmod(path.stat().st_mode & 0o555)

    yield protect
    for path, mode in changed:
        path.chmod(mode)


def test_profile_that_may_only_be_read(blender, packages, version, read_only, tmp_path):
    profile = tmp_path / "profile"
    blender.run_steps(profile, packages[blender.kind])
    read_only(profile)
    # Root writes everywhere unless it gives up that right.
    before = () if os.geteuid() else ("setpriv", "--bounding-set=-dac_override,-dac_read_search")
    enabled, disabled = blender.run_steps(profile, "enable", "disable", before=before)
    assert works(enabled, version)
    assert not disabled["operator"]
