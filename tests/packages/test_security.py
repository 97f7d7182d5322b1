# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on does not use the network, run text as code, unpickle data, or write files of its own."""

import ast
import re
import sys

import pytest
from conftest import ROOT

SOURCES = sorted((ROOT / "addon").rglob("*.py"))
BLENDER = {"addon_utils", "bl_operators", "bl_ui", "blf", "bmesh", "bpy", "bpy_extras", "gpu", "gpu_extras"}
HARMLESS = {"collections", "contextlib", "dataclasses", "enum", "functools", "heapq", "importlib", "itertools", "math"}
HARMLESS |= {
    "operator",
    "pathlib",
    "platform",
    "queue",
    "re",
    "sys",
    "textwrap",
    "threading",
    "time",
    "types",
    "typing",
}
ALLOWED = BLENDER | HARMLESS | {"mathutils", "numpy"}
FORBIDDEN = {"__import__", "compile", "eval", "exec", "execfile", "fromfile", "genfromtxt", "memmap", "popen", "rename"}
FORBIDDEN |= {"as_module", "chmod", "python_file_run", "run_script", "screenshot"}
FORBIDDEN |= {"render", "rmdir", "symlink_to", "hardlink_to", "system", "tofile", "touch", "unlink", "urlopen"}
FORBIDDEN_STARTS = ("dump", "export", "load", "makedirs", "mkdir", "open", "save", "url_", "write")
FORBIDDEN_ENDS = ("_export", "_install", "_render")
# The add-on's own functions, which write to meshes, and harmless ones with similar names.
KNOWN = {"cut.write", "outputs.write", "seam_network.write", "write_labels", "write_seams"}
KNOWN |= {"gpu.matrix.load_projection_matrix", "re.compile", "messages.open_region", "segmentation.write"}


def imported(node):
    if isinstance(node, ast.Import):
        return {name.name.partition(".")[0] for name in node.names}
    if isinstance(node, ast.ImportFrom) and node.level == 0:
        return {node.module.partition(".")[0]}
    return set()


def called(node):
    """The dotted name that a call refers to, if a part of it is forbidden."""
    if not isinstance(node, ast.Call):
        return set()
    call = ast.unparse(node.func)
    return {call} - KNOWN if any(map(forbidden, re.findall(r"\w+", call))) else set()


def forbidden(name):
    return name in FORBIDDEN or name.startswith(FORBIDDEN_STARTS) or name.endswith(FORBIDDEN_ENDS)


def offenses(text):
    nodes = list(ast.walk(ast.parse(text)))
    foreign = set().union(*map(imported, nodes)) - ALLOWED
    return sorted(foreign) + sorted(set().union(*map(called, nodes)))


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.stem)
def test_add_on_uses_only_harmless_modules_and_calls(path):
    assert offenses(path.read_text(encoding="utf-8")) == []


NOTICED = ["__import__", "eval", "exec", "file.write", "numpy.load", "numpy.savetxt", "open", "path.unlink"]
NOTICED += ["bpy.ops.export_scene.gltf", "bpy.ops.render.render", "bpy.ops.wm.obj_export", "bpy.ops.wm.save_userpref"]
NOTICED += ["bpy.ops.wm.save_as_mainfile", "bpy.ops.wm.url_open", "bpy.utils.execfile", "image.save_render"]
NOTICED += ["bpy.ops.extensions.package_install", "bpy.ops.text.run_script", "path.chmod"]
HARMLESS_CALLS = [
    "outputs.write",
    "importlib.import_module",
    "self.execute",
    "parts.append",
    "old.touches",
    "re.compile",
]


def test_forbidden_modules_and_calls_are_detected():
    assert offenses("import socket, pickle\nfrom urllib.request import urlopen") == ["pickle", "socket", "urllib"]
    assert offenses("\n".join(f"{call}('x')" for call in NOTICED + HARMLESS_CALLS)) == sorted(NOTICED)
    assert not HARMLESS - sys.stdlib_module_names
