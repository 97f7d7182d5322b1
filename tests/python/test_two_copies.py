# SPDX-License-Identifier: GPL-3.0-or-later
"""Two copies of the module work in one process, as where Blender has loaded two copies of the add-on."""

import importlib.util
import shutil
import sys
from pathlib import Path

import meshes
import mrcontour as mrc
import numpy as np
import pytest

MESH = meshes.icosphere(2)


@pytest.fixture
def copy(tmp_path, monkeypatch):
    file = shutil.copy(mrc.__file__, tmp_path)
    spec = importlib.util.spec_from_file_location("another.mrcontour", file)
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)
    spec.loader.exec_module(module)
    return module


def test_both_copies_search_and_agree(copy, rng):
    (loop, *_) = meshes.plane_contours(MESH, np.array([0.0, 0.0, 1.0]), 0.3)
    results = [module.optimize(module.Surface(*MESH.arguments()), loop) for module in (mrc, copy)]
    assert Path(copy.__file__) != Path(mrc.__file__)
    assert [type(result) for result in results] == [mrc.Result, copy.Result]
    assert mrc.Result is not copy.Result
    assert results[0].positions.tobytes() == results[1].positions.tobytes()
