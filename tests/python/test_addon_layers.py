# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of imports in the add-on: ui -> mesh -> core, and core without Blender."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ADDON = ROOT / "addon"
SOURCES = sorted(ADDON.rglob("*.py"))
MAY_IMPORT = {
    "core": {"core", "TARGET", "VERSION"},
    "mesh": {"mesh", "core"},
    "ui": {"ui", "mesh", "core"},
    "api": {"mesh", "core"},
    "__init__": {"api", "ui", "mesh"},
}
BLENDER = {"addon_utils", "bgl", "bl_operators", "bl_ui", "blf", "bmesh", "bpy", "bpy_extras", "gpu", "gpu_extras"}
BLENDER |= {"idprop", "mathutils"}
DRAWING = {"bgl", "blf", "gpu", "gpu_extras", "bl_ui", "bl_operators"}


def layer(module):
    """Return the folder of a module, or its own name at the root; modules are tuples of names below the add-on."""
    return module[0] if module else "__init__"


def name_of(path):
    parts = path.relative_to(ADDON).with_suffix("").parts
    return parts[:-1] if parts[-1] == "__init__" and len(parts) > 1 else parts


def imports(path, text=None):
    """Return the add-on's modules that a source imports, as tuples of names, and the foreign packages."""
    package = path.relative_to(ADDON).parts[:-1]
    own, foreign = set(), set()
    for node in ast.walk(ast.parse(text or path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            foreign |= {name.name.partition(".")[0] for name in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            foreign.add(node.module.partition(".")[0])
        elif isinstance(node, ast.ImportFrom):
            assert node.level <= len(package) + 1, "relative imports stay inside the add-on"
            base = package[: len(package) - node.level + 1] + tuple(
                (node.module or "").split(".") if node.module else ()
            )
            is_folder = (ADDON.joinpath(*base) / "__init__.py").is_file()
            own |= {(*base, name.name) for name in node.names} if is_folder else {base}
    return own, foreign


def offenses(path, text=None):
    """Return the imports of a source that break the law."""
    own, foreign = imports(path, text)
    here = layer(name_of(path))
    bad = {".".join(module) for module in own if layer(module) not in MAY_IMPORT[here]}
    no_blender = BLENDER if here == "core" else DRAWING if here == "mesh" else set()
    return sorted(bad | foreign & no_blender | foreign & {"addon", "minimum_ratio_contours"})


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.relative_to(ADDON).as_posix())
def test_imports_go_from_ui_to_mesh_to_core(path):
    assert offenses(path) == []


def test_offenses_are_detected():
    core, mesh, ui = (ADDON / name / "a.py" for name in ("core", "mesh", "ui"))
    assert offenses(core, "from . import native\nimport numpy") == []
    assert offenses(core, "def f():\n    import bpy") == ["bpy"]
    assert offenses(core, "from ..mesh.arrays import read_arrays") == ["mesh.arrays"]
    assert offenses(mesh, "from ..ui import panels\nimport gpu, bpy") == ["gpu", "ui.panels"]
    assert offenses(ui, "from .. import api\nfrom ..mesh import outputs") == ["api"]
    assert offenses(ui, "from ..api import surface_of") == ["api"]
    assert offenses(ADDON / "api.py", "from .ui import panels") == ["ui.panels"]
    assert offenses(ui, "from minimum_ratio_contours import api") == ["minimum_ratio_contours"]


def test_there_are_three_folders_and_none_within_them():
    assert {path.parent.relative_to(ADDON).as_posix() for path in SOURCES} == {".", "core", "mesh", "ui"}
    assert {path.name for path in SOURCES if path.parent == ADDON} == {"__init__.py", "api.py"}
    assert all((ADDON / folder / "__init__.py").is_file() for folder in ("core", "mesh", "ui"))


def test_there_are_no_import_cycles():
    graph = {name_of(path): imports(path)[0] for path in SOURCES}
    done = set()

    def visit(module, above):
        assert module not in above, (*above, module)
        if module not in done:
            for other in graph.get(module, ()):
                visit(other, (*above, module))
            done.add(module)

    for module in graph:
        visit(module, ())


WITHOUT_BLENDER = """
import importlib, sys
for name in {blender!r}:
    sys.modules[name] = None  # importing it raises
importlib.import_module({module!r})
wrong = [name for name in sys.modules if name.startswith(("addon.mesh", "addon.ui", "addon.api"))]
assert not wrong, wrong
"""


@pytest.mark.parametrize("path", [path for path in SOURCES if path.parent.name == "core"], ids=lambda path: path.stem)
def test_core_needs_no_blender(path):
    module = ".".join(("addon", *name_of(path)))
    code = WITHOUT_BLENDER.format(blender=sorted(BLENDER), module=module)
    run = subprocess.run([sys.executable, "-c", code], cwd=ROOT, env=os.environ, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


NEW_AND_OLD = """
import importlib, sys, types
sys.path.insert(0, {folder!r})
package = importlib.import_module("addon")
parameters = importlib.import_module("addon.core.parameters")
library = sys.modules["addon.mrcontour"] = types.ModuleType("addon.mrcontour")
flat = sys.modules["addon.columns"] = types.ModuleType("addon.columns")  # of a version without folders
importlib.reload(package)
assert not hasattr(package, "core") and "addon.core" not in sys.modules and "addon.columns" not in sys.modules
assert sys.modules["addon.mrcontour"] is library
from addon.core import parameters as reloaded
assert reloaded is not parameters
"""


def test_an_upgrade_forgets_all_modules_but_the_compiled_one():
    run = subprocess.run([sys.executable, "-c", NEW_AND_OLD.format(folder=str(ROOT))], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
