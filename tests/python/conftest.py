# SPDX-License-Identifier: GPL-3.0-or-later
"""What all tests of the module share: surfaces from test meshes, and realistic contours."""

from functools import cache

import meshes
import mrcontour as mrc
import numpy as np
import pytest


def surface_of(mesh, **keywords):
    return mrc.Surface(*mesh.arguments(), **keywords)


@cache
def realistic_contours():
    """At least 20 jagged loops where tilted planes cut generated meshes: a list of (name, mesh, contour)."""
    rng = np.random.default_rng(2006)
    bumpy = meshes.icosphere(3)
    bumpy = bumpy.moved(bumpy.positions * (1 + 0.2 * np.sin(4 * bumpy.positions[:, [2]] + bumpy.positions[:, [0]])))
    bodies = {
        "peanut": meshes.peanut(rng, 3),
        "bumpy": bumpy,
        "bent": meshes.bent_tube(rng),
        "grooved": meshes.torus(20, 64, rng=rng, split_fraction=0.7, noise=0.02, grooves=0.3),
        "finger": meshes.finger(rng)[0],
    }
    normals = {"peanut": [0, 0, 1], "bumpy": [0, 0, 1], "bent": [-1, 1, 0], "grooved": [0, 1, 0], "finger": [0, 0, 1]}
    offsets = {
        "peanut": [-0.2, 0.15],
        "bumpy": [-0.3, 0.4],
        "bent": [-0.8, 0.4, 1.0],
        "grooved": [-0.6, 0.7],
        "finger": [0.5, 2.5],
    }
    cases = []
    for name, mesh in bodies.items():
        for offset in offsets[name]:
            for _ in range(2):
                normal = np.array(normals[name]) + rng.uniform(-0.25, 0.25, 3)
                loops = meshes.plane_contours(mesh, normal / np.linalg.norm(normal), offset)
                cases += [(name, mesh, loop) for loop in loops if len(loop) >= 8][:2]
    return [(f"{name}-{i}", mesh, loop) for i, (name, mesh, loop) in enumerate(cases)]


def pytest_addoption(parser):
    parser.addoption("--few", type=int, help="run only this many cases of each test, evenly spread")


def pytest_collection_modifyitems(config, items):
    if not (few := config.getoption("--few")):
        return
    cases = {}
    for item in items:
        cases.setdefault(item.nodeid.partition("[")[0], []).append(item)
    kept = {id(group[i * len(group) // few]) for group in cases.values() for i in range(few)}
    config.hook.pytest_deselected(items=[item for item in items if id(item) not in kept])
    items[:] = [item for item in items if id(item) in kept]


def pytest_generate_tests(metafunc):
    if "realistic" in metafunc.fixturenames:
        cases = realistic_contours()
        metafunc.parametrize("realistic", cases, ids=[name for name, _, _ in cases])


@pytest.fixture
def rng():
    return np.random.default_rng(7)
