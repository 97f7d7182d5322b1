# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages built by `native/package`, and the versions of Blender in which they are tested."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest
from packaging.version import Version

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "native"))
from packages import EXTENSION_PYTHONS, LEGACY_PYTHONS, read_name  # noqa: E402

PYTHON = "cp{}{}".format(*sys.version_info)


class Blender:
    """A Blender whose user settings, add-ons and extensions are all in one folder, and the kind of package to test."""

    def __init__(self, command, python, kind, tool=None, system="Linux"):
        self.command, self.python, self.kind, self.tool, self.system = command, python, kind, tool, system

    @property
    def name(self):
        return f"windows-{self.kind}" if self.system == "Windows" else self.command[0].parents[1].name

    def path(self, path):
        """How this Blender's system writes the path of a file. Under Wine, Z: is the root folder."""
        return "Z:" + str(path).replace("/", "\\") if self.system == "Windows" else str(path)

    @property
    def has_extensions(self):
        if self.tool:
            return True
        printed = subprocess.run([self.command[0], "--version"], capture_output=True, text=True, check=True).stdout
        return Version(re.search(r"Blender ([\d.]+)", printed)[1]) >= Version("4.2")

    def run_steps(self, profile, *steps, before=()):
        """The state after each step of in_blender.py, all in one process.

        before: the start of a command that runs Blender, such as one that takes rights away
        """
        script = Path(__file__).with_name("in_blender.py")
        profile.mkdir(exist_ok=True)
        run = subprocess.run(
            [*before, *map(str, self.command), str(script), "--", *map(str, steps)],
            env=os.environ
            | {
                "HOME": str(profile / "home"),
                "BLENDER_USER_RESOURCES": self.path(profile),
                "BLENDER_USER_CONFIG": self.path(profile / "config"),
                "BLENDER_USER_SCRIPTS": self.path(profile / "scripts"),
            },
            capture_output=True,
            text=True,
            timeout=600,
        )
        states = [json.loads(line[6:]) for line in run.stdout.splitlines() if line.startswith("STATE ")]
        assert run.returncode == 0, run.stdout + run.stderr
        assert len(states) == len(steps), run.stdout + run.stderr
        assert "Traceback" not in run.stdout + run.stderr, run.stdout + run.stderr
        return states


def pytest_addoption(parser):
    parser.addoption(
        "--packages", type=Path, required=True, help="the folder with the packages built by native/package"
    )
    parser.addoption("--blender", type=Path, help="a Blender that has the Python of this run")
    parser.addoption("--bpy", type=Path, action="append", default=[], help="a virtual environment with a bpy wheel")
    parser.addoption("--wine", type=Path, help="a Python for Windows with a bpy wheel, to be run under Wine")


def blenders(config):
    found = []
    if config.getoption("blender"):
        options = ["-b", "--factory-startup", "--python-exit-code", "1", "--python"]
        found.append(Blender([config.getoption("blender"), *options], PYTHON, "legacy"))
    for folder in config.getoption("bpy"):
        tool = only(folder.glob("lib/python*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
        python = "cp" + tool.relative_to(folder).parts[1].removeprefix("python").replace(".", "")
        found.append(Blender([folder / "bin" / "python"], python, "extension", tool))
    if folder := config.getoption("wine"):
        tool = only(folder.glob("Lib/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
        command = [ROOT / "tests" / "under_wine", folder / "python.exe", "-X", "utf8"]
        found += [Blender(command, "cp311", kind, tool, "Windows") for kind in ("extension", "legacy")]
    return found


def pytest_generate_tests(metafunc):
    """Tests in a Blender get the packages for its Python; others run once for each Python."""
    for name, kinds in {"blender": ("legacy", "extension"), "extension_blender": ("extension",)}.items():
        if name in metafunc.fixturenames:
            chosen = [blender for blender in blenders(metafunc.config) if blender.kind in kinds]
            ids = [blender.name for blender in chosen]
            if "packages" not in metafunc.fixturenames:
                metafunc.parametrize(name, chosen, ids=ids)
                return
            values = [(blender, packages_for(metafunc.config, blender.python)) for blender in chosen]
            metafunc.parametrize((name, "packages"), values, ids=ids)
            return
    if "packages" in metafunc.fixturenames:
        tags = sorted(read_name(wheel)[1] for wheel in folder(metafunc.config).glob("*.whl"))
        metafunc.parametrize("packages", [packages_for(metafunc.config, tag) for tag in tags], ids=tags)


def folder(config):
    return config.getoption("packages").resolve()


def packages_for(config, python):
    """The wheel for one Python, and the extension and the legacy add-on for all, by kind."""
    kinds = {
        "wheel": f"*-{python}-{python}-*.whl",
        "extension": "*-extension-*.zip",
        "legacy": "*-legacy-*.zip",
    }
    return {kind: only(folder(config).glob(pattern)) for kind, pattern in kinds.items()}


@pytest.fixture
def blender_tool(pytestconfig):
    """The extension tool of the first release given."""
    return next(blender.tool for blender in blenders(pytestconfig) if blender.tool)


def wheel_of(folder, python, platform):
    """An empty stand-in for a wheel of another system."""
    wheel = folder / f"mrcontour-0.1.0-{python}-{python}-{platform}.whl"
    with ZipFile(wheel, "w") as content:
        content.writestr(f"mrcontour.{python}-{platform}.pyd", b"")
        content.writestr("mrcontour-0.1.0.dist-info/licenses/LICENSE", b"")
    return wheel


def only(paths):
    (path,) = paths
    return path


@pytest.fixture(scope="session")
def own_packages(pytestconfig):
    """The packages for the Python of this run."""
    return packages_for(pytestconfig, PYTHON)


def wheels_for(config, pythons):
    return [wheel for wheel in sorted(folder(config).glob("*.whl")) if read_name(wheel)[1] in pythons]


@pytest.fixture(scope="session")
def extension_wheels(pytestconfig):
    """The wheels for the Pythons of Blender 4.2 and later."""
    return wheels_for(pytestconfig, EXTENSION_PYTHONS)


@pytest.fixture(scope="session")
def legacy_wheels(pytestconfig):
    """The wheels for the Pythons of all releases of Blender."""
    return wheels_for(pytestconfig, LEGACY_PYTHONS)


@pytest.fixture(scope="session")
def version():
    """The version in CMakeLists.txt, where it is defined."""
    source = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return only(re.findall(r"^project\(.* VERSION (\S+)", source, re.MULTILINE))
