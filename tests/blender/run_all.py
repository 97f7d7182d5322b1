# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the add-on's tests inside Blender, with the add-on in the user's folders or in BLENDER_USER_SCRIPTS:

blender -b --factory-startup --python-exit-code 1 --python tests/blender/run_all.py [-- PYTEST ARGUMENT...]
python tests/blender/run_all.py [-- PYTEST ARGUMENT...]          if the bpy wheel is installed
"""

import sys
from pathlib import Path

import bpy
import pytest

sys.path.insert(0, str(Path(__file__).parent))
import addon_module  # noqa: E402

package = addon_module.enable()
print(f"Blender {bpy.app.version_string}, Python {sys.version.split()[0]}, {package.__file__}", flush=True)
arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
sys.exit(int(pytest.main(["-q", "-p", "no:cacheprovider", str(Path(__file__).parent), *arguments])))
