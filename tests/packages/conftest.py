# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages built by `native/package`, and the versions of Blender in which they are tested."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "native"))


class Blender:
    """A Blender whose user settings, add-ons and extensions are all in one folder."""

    def __init__(self, command, tool=None):
        self.command, self.tool = command, tool

    @property
    def kind(self):
        return "extension" if self.tool else "legacy"

    def run_steps(self, profile, *steps):
        """The state after each step of in_blender.py, all in one process."""
        script = Path(__file__).with_name("in_blender.py")
        profile.mkdir(exist_ok=True)
        run = subprocess.run(
            [*map(str, self.command), str(script), "--", *map(str, steps)],
            env=os.environ
            | {
                "HOME": str(profile / "home"),
                "BLENDER_USER_RESOURCES": str(profile),
                "BLENDER_USER_CONFIG": str(profile / "config"),
                "BLENDER_USER_SCRIPTS": str(profile / "scripts"),
            },
            capture_output=True,
            text=True,
            timeout=120,
        )
        states = [json.loads(line[6:]) for line in run.stdout.splitlines() if line.startswith("STATE ")]
        assert run.returncode == 0, run.stdout + run.stderr
        assert len(states) == len(steps), run.stdout + run.stderr
        return states


def pytest_addoption(parser):
    parser.addoption(
        "--packages", type=Path, required=True, help="the folder with the packages built by native/package"
    )
    parser.addoption("--blender", type=Path, help="a Blender older than 4.2")
    parser.addoption("--bpy", type=Path, action="append", default=[], help="a virtual environment with a bpy wheel")


def blenders(config):
    found = []
    if config.getoption("blender"):
        options = ["-b", "--factory-startup", "--python-exit-code", "1", "--python"]
        found.append(Blender([config.getoption("blender"), *options]))
    for folder in config.getoption("bpy"):
        (tool,) = folder.glob("lib/python*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py")
        found.append(Blender([folder / "bin" / "python"], tool))
    return found


def pytest_generate_tests(metafunc):
    for name, kinds in {"blender": ("legacy", "extension"), "extension_blender": ("extension",)}.items():
        if name in metafunc.fixturenames:
            chosen = [blender for blender in blenders(metafunc.config) if blender.kind in kinds]
            metafunc.parametrize(name, chosen, ids=[blender.command[0].parents[1].name for blender in chosen])


@pytest.fixture
def blender_tool(pytestconfig):
    """The extension tool of the first release given."""
    return next(blender.tool for blender in blenders(pytestconfig) if blender.tool)


def only(paths):
    (path,) = paths
    return path


@pytest.fixture(scope="session")
def packages(pytestconfig):
    """The wheel, the extension and the legacy add-on, by kind."""
    folder = pytestconfig.getoption("packages").resolve()
    kinds = {"wheel": "*.whl", "extension": "*-extension-*.zip", "legacy": "*-legacy-*.zip"}
    return {kind: only(folder.glob(pattern)) for kind, pattern in kinds.items()}


@pytest.fixture(scope="session")
def version():
    """The version in CMakeLists.txt, where it is defined."""
    source = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return only(re.findall(r"^project\(.* VERSION (\S+)", source, re.MULTILINE))
