# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the API reference of the module mrcontour and of the add-on's module api, from their docstrings, as HTML.

Fails on warnings and broken links.
"""

import argparse
import importlib.util
import re
import sys
import warnings
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from pathlib import Path
from unittest.mock import MagicMock

import mrcontour
import pdoc

ADDON = Path(__file__).resolve().parents[1] / "addon"
ID = "minimum_ratio_contours"


class BlenderStandIns(MetaPathFinder, Loader):
    """Stand-ins for Blender's modules; none of their functions is called while docstrings are read."""

    def find_spec(self, name, path=None, target=None):
        found = name.partition(".")[0] in {"bpy", "bmesh", "gpu", "gpu_extras", "mathutils"}
        return ModuleSpec(name, self, is_package=True) if found else None

    def create_module(self, spec):
        return None

    def exec_module(self, module):
        module.__getattr__ = lambda name: MagicMock(name=name)
        if module.__name__ == "bpy":
            module.app = MagicMock(version=(4, 2, 0))


def load_addon():
    """Imports the add-on under its name in Blender before 4.2."""
    sys.meta_path.append(BlenderStandIns())
    place = {"location": ADDON / "__init__.py", "submodule_search_locations": [str(ADDON)]}
    spec = importlib.util.spec_from_file_location(ID, **place)
    package = sys.modules[ID] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(package)
    return importlib.import_module(f"{ID}.api")


def broken_links(folder):
    """The links on the pages of a folder to pages or anchors that do not exist."""
    pages = {page: page.read_text(encoding="utf-8") for page in folder.rglob("*.html")}
    places = {page: set(re.findall(r'\bid="([^"]+)"', text)) for page, text in pages.items()}
    broken = []
    for page, text in pages.items():
        for target in re.findall(r'<a\b[^>]*\bhref="([^":$]+)"', text):
            name, _, place = target.partition("#")
            file = (page.parent / name).resolve() if name else page
            if not file.exists() or (place and place not in places[file]):
                broken.append(f"{page.name}: {target}")
    return broken


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("output", type=Path, help="the folder for the pages")
    output = parser.parse_args().output.resolve()
    warnings.simplefilter("error")
    modules = [mrcontour, load_addon()]
    pdoc.render.configure(docformat="markdown", show_source=False, footer_text=f"version {mrcontour.__version__}")
    pdoc.render_helpers.markdown_extensions["breaks"] = {"on_newline": True}  # each argument is on a line of its own
    pdoc.pdoc(*(module.__name__ for module in modules), output_directory=output)
    if broken := broken_links(output):
        sys.exit("\n".join(["broken links:", *broken]))


if __name__ == "__main__":
    main()
