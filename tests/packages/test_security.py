# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on can reach no network, runs no text as code, unpickles nothing and writes no files of its own."""

import ast
import sys

import pytest
from conftest import ROOT

BLENDER = {"addon_utils", "bl_operators", "bl_ui", "blf", "bmesh", "bpy", "bpy_extras", "gpu", "gpu_extras"}
HARMLESS = {"collections", "contextlib", "dataclasses", "enum", "functools", "heapq", "importlib", "itertools", "math"}
HARMLESS |= {"operator", "pathlib", "queue", "re", "sys", "textwrap", "threading", "time", "types", "typing"}
ALLOWED = BLENDER | HARMLESS | {"mathutils", "numpy"}
FORBIDDEN_CALLS = {"__import__", "compile", "eval", "exec", "fromfile", "load", "mkdir", "open", "popen", "save"}
FORBIDDEN_CALLS |= {"savez", "system", "tofile", "unlink", "url_open", "urlopen", "write_bytes", "write_text"}


def imported(node):
    if isinstance(node, ast.Import):
        return {name.name.partition(".")[0] for name in node.names}
    if isinstance(node, ast.ImportFrom) and node.level == 0:
        return {node.module.partition(".")[0]}
    return set()


def called(node):
    if not isinstance(node, ast.Call):
        return set()
    return {getattr(node.func, "attr", getattr(node.func, "id", ""))}


def offences(text):
    nodes = list(ast.walk(ast.parse(text)))
    foreign = set().union(*map(imported, nodes)) - ALLOWED
    return sorted(foreign) + sorted(set().union(*map(called, nodes)) & FORBIDDEN_CALLS)


@pytest.mark.parametrize("path", sorted((ROOT / "addon").glob("*.py")), ids=lambda path: path.stem)
def test_only_harmless_modules_and_calls(path):
    assert offences(path.read_text(encoding="utf-8")) == []


def test_what_would_be_noticed():
    assert offences("import socket, pickle\nfrom urllib.request import urlopen") == ["pickle", "socket", "urllib"]
    assert offences("eval('1')\nopen('x')\nnumpy.load('y')\nbpy.ops.wm.url_open()") == [
        "eval",
        "load",
        "open",
        "url_open",
    ]
    assert not HARMLESS - sys.stdlib_module_names
