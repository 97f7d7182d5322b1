# SPDX-License-Identifier: GPL-3.0-or-later
"""Rough contours on real meshes: cut from those of Debian's libcgal-demo, or read from a benchmark folder."""

import gzip
import importlib
import io
import json
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import mrcontour as mrc
import numpy as np
import trimesh

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "blend_samples"))
from real_meshes import open_archive  # noqa: E402
from rough_loops import Cut, Polygons, rough_loop  # noqa: E402

CLOSED_MESHES = [
    "armadillo",
    "bear",
    "bull",
    "bunny00",
    "camel",
    "cow",
    "dino",
    "diplodocus",
    "elephant",
    "femur",
    "hand",
    "homer",
    "man",
    "retinal",
    "triceratops",
]
SHORTEST, LONGEST = 16, 120  # edges of a rough loop: shorter ones are specks, longer ones do not go around a limb
PLANES = 4  # planes tried through each point


@dataclass(frozen=True)
class Body:
    """A real triangle mesh, as arrays and as a surface."""

    name: str
    positions: np.ndarray
    triangles: np.ndarray
    surface: mrc.Surface


@dataclass(frozen=True)
class RealContour:
    """A rough loop of vertices on a body."""

    body: Body
    vertices: np.ndarray

    def band_faces(self, width):
        return len(mrc.band(self.body.surface, self.vertices, options=mrc.Options(width=width)))

    def width_for(self, faces):
        """The width, at most 64, whose band is closest to this many faces; None if it is off by more than a third."""
        found = []
        while len(found) < 64 and max(found, default=0) < faces:
            found.append(self.band_faces(len(found) + 1))
        best = int(np.argmin(np.abs(np.log(np.array(found) / faces))))
        return best + 1 if 3 / 4 < found[best] / faces < 4 / 3 else None


def make_body(name, positions, triangles):
    positions = np.ascontiguousarray(positions, dtype=np.float64)
    triangles = np.ascontiguousarray(triangles, dtype=np.int32)
    return Body(name, positions, triangles, mrc.Surface(positions, None, triangles))


@cache
def demo_bodies(scratch):
    """The closed meshes of libcgal-demo. `scratch` is a folder for the package if the system installs no documents."""
    with open_archive(Path(scratch)) as archive:
        return [demo_body(archive, name) for name in CLOSED_MESHES]


def demo_body(archive, name):
    data = io.BytesIO(archive.extractfile(f"data/meshes/{name}.off").read())
    mesh = trimesh.load(data, file_type="off", process=False)
    return make_body(name, mesh.vertices, mesh.faces)


def demo_contours(scratch, each=10):
    """Rough loops around limbs of all sizes, `each` on every mesh."""
    return [contour for body in demo_bodies(scratch) for contour in random_loops(body, each)]


def random_loops(body, count):
    """Loops roughly across limbs: the shortest of those cut by a few random planes through a vertex."""
    rng = np.random.default_rng(2006)
    polygons = Polygons(body.positions, 3 * np.arange(len(body.triangles) + 1), body.triangles.ravel())
    loops = []
    for _ in range(10 * count):
        point = body.positions[rng.integers(len(body.positions))]
        cuts = [loop_near(polygons, point, normal) for normal in rng.normal(size=(PLANES, 3))]
        fit = [loop for loop in cuts if SHORTEST <= len(loop) <= LONGEST]
        if fit and usable(body, shortest := min(fit, key=len)):
            loops.append(RealContour(body, shortest))
        if len(loops) == count:
            break
    return loops


def loop_near(polygons, point, normal):
    try:
        return np.array(rough_loop(polygons, Cut("", tuple(point), tuple(normal))), dtype=np.int32)
    except ValueError:  # the plane misses the mesh
        return np.empty(0, np.int32)


def usable(body, loop):
    try:
        mrc.optimize(body.surface, loop)
    except ValueError:
        return False
    return True


def folder_contours(folder):
    """The closed contours on which several people nearly agreed, from a folder with cases.jsonl.gz and the module npzx.

    The meshes are in ../data/psb, relative to the folder.
    """
    folder = Path(folder).resolve()
    sys.path.insert(0, str(folder))
    load = importlib.import_module("npzx").loadx
    with gzip.open(folder / "cases.jsonl.gz", "rt") as lines:
        cases = [case for case in map(json.loads, lines) if case["closed"] and case["supported"]]

    @cache
    def body(model):
        return make_body(str(model), *load(folder.parent / "data" / "psb" / f"{model}.npz")[:2])

    return [RealContour(body(case["model"]), np.array(case["verts"], np.int32)) for case in cases]


def spread(items, count):
    """`count` items of a list, evenly spaced."""
    if len(items) <= count:
        return list(items)
    return [items[i] for i in np.linspace(0, len(items) - 1, count).astype(int)]
