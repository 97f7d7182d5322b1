# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages contain the right files, Blender's own tools accept them, and they need nothing else."""

import ast
import re
import subprocess
import sys
from zipfile import ZipFile

import packages as maker
import pytest
import tomllib
from conftest import PYTHON, ROOT, only, wheel_of
from packaging.utils import parse_wheel_filename

ADDON = ROOT / "addon"
SOURCES = {path.relative_to(ADDON).as_posix() for path in ADDON.rglob("*.py")}
LICENSES = {"LICENSE", "THIRD_PARTY.txt"}
MODULE = r"mrcontour\.cpython-3\d+-[\w-]+\.so"


def names(package):
    with ZipFile(package) as content:
        return sorted(name for name in content.namelist() if not name.endswith("/"))


def contents(package):
    with ZipFile(package) as content:
        return {name: content.read(name) for name in content.namelist()}


def manifest(package):
    return tomllib.loads(contents(package)["blender_manifest.toml"].decode())


def rest(found, patterns):
    """The names without those that match a pattern; each pattern must match exactly one."""
    for pattern in patterns:
        found = set(found) - {only(name for name in found if re.fullmatch(pattern, name))}
    return found


def test_wheel_contains_module_stubs_and_licenses(packages, version):
    info = f"mrcontour-{version}.dist-info"
    wanted = [MODULE, "mrcontour-stubs/__init__.pyi", *(f"{info}/licenses/{name}" for name in LICENSES)]
    own = {f"{info}/{name}" for name in ("METADATA", "WHEEL", "RECORD")}
    assert rest(names(packages["wheel"]), wanted) == own
    assert "manylinux" in packages["wheel"].name


def test_wheel_metadata_contains_its_page(packages, version):
    metadata = contents(packages["wheel"])[f"mrcontour-{version}.dist-info/METADATA"].decode()
    assert "Description-Content-Type: text/markdown" in metadata
    assert (ROOT / "native" / "python" / "README.md").read_text(encoding="utf-8").strip() in metadata


def test_extension_contains_sources_manifest_and_wheels(own_packages, extension_wheels):
    found = contents(own_packages["extension"])
    copies = {f"wheels/{maker.name_inside(wheel)}": wheel.read_bytes() for wheel in extension_wheels}
    assert {name for name in found if not name.endswith("/")} == SOURCES | {"blender_manifest.toml"} | copies.keys()
    assert {name: found[name] for name in copies} == copies


def test_legacy_add_on_contains_sources_modules_and_licenses(own_packages, legacy_wheels):
    found = names(own_packages["legacy"])
    assert all(name.startswith("minimum_ratio_contours/") for name in found)
    modules = {name for wheel in legacy_wheels for name in names(wheel) if re.fullmatch(MODULE, name)}
    assert len(modules) == len(legacy_wheels)
    assert {name.partition("/")[2] for name in found} == SOURCES | LICENSES | modules


def test_manifest_requests_no_permissions_and_declares_its_platform(own_packages, extension_wheels, version):
    found = manifest(own_packages["extension"])
    assert "permissions" not in found
    assert (found["version"], found["wheels"]) == (
        version,
        [f"./wheels/{maker.name_inside(wheel)}" for wheel in extension_wheels],
    )
    assert (found["blender_version_min"], found.get("blender_version_max")) == ("4.2.0", None)
    assert len(found["platforms"]) == 1
    assert found["platforms"][0].startswith("linux-")


def test_manifest_keeps_the_rules_of_the_extensions_platform(packages):
    """Those that Blender's tool does not check or checks only when it builds."""
    found = manifest(packages["extension"])
    assert len(found["tagline"]) <= 64
    assert found["tagline"][-1].isalnum()
    assert "blender" not in found["name"].lower()
    assert "" not in found.values()
    third_party = (ROOT / "native/python/THIRD_PARTY.txt").read_text(encoding="utf-8")
    holders = re.findall(r"^ *Copyright \([cC]\) ([\d-]+),? (?:by )?([^<,\n]*\w)", third_party, re.MULTILINE)
    assert len(holders) == third_party.count("Copyright (")
    assert {" ".join(holder) for holder in holders} <= set(found["copyright"])


def test_versions_agree_everywhere(packages, version):
    for kind, folder in (("extension", ""), ("legacy", "minimum_ratio_contours/")):
        init = contents(packages[kind])[f"{folder}__init__.py"].decode()
        assert f'"version": {tuple(map(int, version.split(".")))}' in init
    assert manifest(packages["extension"])["version"] == version
    assert all(version in package.name for package in packages.values())


ADDRESS = "https://contours.example"


@pytest.mark.parametrize("address", ["", ADDRESS])
def test_packages_have_the_links_that_blender_shows_if_there_is_an_address(
    monkeypatch, blender_tool, tmp_path, address
):
    monkeypatch.setattr(maker, "homepage", lambda: address)
    wheel = wheel_of(tmp_path, "cp311", "win_amd64")
    assert manifest(maker.build_extension([wheel], tmp_path, blender_tool)).get("website", "") == address
    init = contents(maker.build_legacy([wheel], tmp_path))["minimum_ratio_contours/__init__.py"].decode()
    info = ast.literal_eval(re.search(r"^bl_info = (\{.*?^\})", init, re.MULTILINE | re.DOTALL)[1])
    assert (info["doc_url"], info["tracker_url"]) == ((address, f"{address}/issues") if address else ("", ""))


def test_the_address_is_that_in_cmakelists(packages):
    source = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    assert f'HOMEPAGE_URL "{maker.homepage()}"' in source
    assert manifest(packages["extension"]).get("website", "") == maker.homepage()


def test_extension_tools_of_all_releases_accept_and_reproduce_the_extension(
    extension_blender, packages, extension_wheels, tmp_path
):
    validate = [sys.executable, extension_blender.tool, "validate", packages["extension"]]
    subprocess.run(validate, check=True, capture_output=True)
    built = maker.build_extension(extension_wheels, tmp_path, extension_blender.tool)
    assert contents(built) == contents(packages["extension"])


def test_legacy_add_on_is_reproducible(own_packages, legacy_wheels, tmp_path):
    assert maker.build_legacy(legacy_wheels, tmp_path).read_bytes() == own_packages["legacy"].read_bytes()


@pytest.mark.parametrize("zone", ["America/New_York", "Asia/Tokyo"])
def test_extension_is_reproducible_in_every_time_zone(
    monkeypatch, own_packages, extension_wheels, blender_tool, tmp_path, zone
):
    monkeypatch.setenv("TZ", zone)
    built = maker.build_extension(extension_wheels, tmp_path, blender_tool)
    assert built.read_bytes() == own_packages["extension"].read_bytes()
    with ZipFile(built) as content:
        assert content.namelist() == sorted(content.namelist())


def test_nothing_is_loaded_but_the_module_and_the_c_library(own_packages, tmp_path):
    with ZipFile(own_packages["legacy"]) as content:
        content.extractall(tmp_path)
    folder = tmp_path / "minimum_ratio_contours"
    code = """import numpy
def loaded():
    return {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}
before = loaded()
import mrcontour
print(*(loaded() - before))"""
    found = subprocess.run([sys.executable, "-c", code], cwd=folder, check=True, capture_output=True, text=True).stdout
    others = [path for path in found.split() if not re.search(r"/lib(dl|m|pthread)\.so", path)]  # of the C library
    assert others == [str(only(folder.glob(f"mrcontour.cpython-{PYTHON.removeprefix('cp')}-*.so")))]


def test_every_module_is_packaged(packages):
    """A package without one fails only when that module is first imported."""
    assert {"__init__.py", "core/search.py", "mesh/outputs.py", "ui/operators.py"} <= SOURCES
    for kind, folder in (("extension", ""), ("legacy", "minimum_ratio_contours/")):
        shipped = {name.removeprefix(folder) for name in names(packages[kind]) if name.endswith(".py")}
        assert shipped == SOURCES


@pytest.mark.parametrize(
    ("python", "platform", "wanted"),
    [
        ("cp311", "win_amd64", "windows-x64"),
        ("cp313", "macosx_11_0_arm64", "macos-arm64"),
        ("cp313", "manylinux_2_27_x86_64.manylinux_2_28_x86_64", "linux-x64"),
    ],
)
def test_extensions_for_other_systems(blender_tool, tmp_path, python, platform, wanted):
    built = maker.build_extension([wheel_of(tmp_path, python, platform)], tmp_path, blender_tool)
    found = manifest(built)
    assert built.name.endswith(f"-extension-{wanted}-{python}.zip")
    assert found["platforms"] == [wanted]
    assert len(found["wheels"]) == 1


def test_in_an_extension_the_wheel_for_python_311_comes_last(blender_tool, tmp_path):
    """Blender 4.2.0, which has this Python, takes the last, whatever its Python."""
    wheels = [wheel_of(tmp_path, python, "win_amd64") for python in ("cp311", "cp313")]
    found = manifest(maker.build_extension(wheels, tmp_path, blender_tool))["wheels"]
    assert len(found) == 2
    assert "-cp311-" in max(found)
    assert {tag.interpreter for name in found for tag in parse_wheel_filename(name.removeprefix("./wheels/"))[3]} == {
        "cp311",
        "cp313",
    }


def test_wheels_for_two_platforms_make_no_package(tmp_path):
    wheels = [wheel_of(tmp_path, "cp311", platform) for platform in ("win_amd64", "macosx_11_0_x86_64")]
    command = [sys.executable, maker.__file__, *wheels, "--extension-tool", "unused", "--output", tmp_path / "output"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 2
    assert "several platforms: macos-x64, windows-x64" in run.stderr
    assert not list(tmp_path.glob("output/*"))


def test_legacy_add_on_for_two_pythons(tmp_path):
    wheels = [wheel_of(tmp_path, python, "win_amd64") for python in ("cp310", "cp311")]
    built = maker.build_legacy(wheels, tmp_path)
    assert built.name.endswith("-legacy-windows-x64-cp310-cp311.zip")
    modules = {name for name in names(built) if name.endswith(".pyd")}
    assert modules == {f"minimum_ratio_contours/mrcontour.{python}-win_amd64.pyd" for python in ("cp310", "cp311")}
