# SPDX-License-Identifier: GPL-3.0-or-later
"""Times whole commands on a million triangles against what Blender itself needs to hand over the mesh.

blender -b --factory-startup --python-exit-code 1 --python tests/blender/bench_commands.py [-- REPETITIONS [OUTPUT...]]
python tests/blender/bench_commands.py [-- REPETITIONS]          if the bpy wheel is installed

The add-on must be in BLENDER_USER_SCRIPTS. The unit of the last column is the time of `update_from_editmode` and of
reading the arrays from properties. Commands that do not change faces should take at most 1.5 of it. "first" builds the
Surface, "redo" finds it in the cache. Everything is measured in turn, so many times; the mesh is restored before each
measurement. If outputs are named, only these are measured.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
bpy.ops.preferences.addon_enable(module="minimum_ratio_contours")

from bench_meshes import GROOVE, grooved_tube, milliseconds, square  # noqa: E402
from made_meshes import edit, mark_edges, pairs, select  # noqa: E402
from minimum_ratio_contours import api  # noqa: E402
from minimum_ratio_contours.mesh.arrays import read_arrays, synchronize  # noqa: E402

REPETITIONS = 5
LOOP = square(GROOVE - 10, 100, 25)
SETTINGS = {"width": 1, "reach": 0.0, "min_salience": 0.0}  # a band of some 1,000 faces
HAND_OVER = ("update_from_editmode", "the arrays")


def plain_arrays(mesh):
    """Read points, faces, triangles and hidden flags from properties into arrays of exactly their type."""
    mesh.calc_loop_triangles()
    for elements, name, dtype, width in (
        (mesh.vertices, "co", np.float32, 3),
        (mesh.polygons, "loop_start", np.uint32, 1),
        (mesh.polygons, "hide", bool, 1),
        (mesh.loops, "vertex_index", np.uint32, 1),
        (mesh.loop_triangles, "vertices", np.uint32, 3),
    ):
        elements.foreach_get(name, np.empty(len(elements) * width, dtype=dtype))


class Bench:
    """Return the commands by name, each with the preparation that is not timed."""

    def __init__(self):
        self.obj = grooved_tube()
        self.given = self.obj.data
        self.renew()
        self.cases = {
            HAND_OVER[0]: (self._select, self.obj.update_from_editmode),
            HAND_OVER[1]: (self._synchronize, lambda: plain_arrays(self.obj.data)),
            "the add-on's arrays": (self._synchronize, lambda: read_arrays(self.obj)),
        }
        for output in ("SELECT", "SEAM", "SHARP"):
            self._add(output, self._select, lambda output=output: self._optimize(output))
        self._add("optimize_seams", self._mark, self._optimize_seams)
        for output in ("CUT", "RIP", "SEPARATE"):
            self._add(output, self.renew, lambda output=output: self._optimize(output, refinement=1))

    def _add(self, name, prepare, run):
        self.cases[f"{name}, first"] = (lambda: (prepare(), api.forget()), run)
        self.cases[f"{name}, redo"] = (lambda: (prepare(), self._keep()), run)

    def measure(self, name):
        prepare, run = self.cases[name]
        prepare()
        return milliseconds(run)[0]

    def _select(self):
        self._clear()
        select(self.obj, pairs(LOOP))

    def _synchronize(self):
        self._select()
        self.obj.update_from_editmode()

    def _mark(self):
        self._clear()
        mark_edges(self.obj, pairs(LOOP), "seam")

    def _clear(self):
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.mark_seam(clear=True)
        bpy.ops.mesh.mark_sharp(clear=True)
        bpy.ops.mesh.select_all(action="DESELECT")

    def renew(self):
        """Restore the mesh from before the cut."""
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        for other in bpy.data.objects:
            if other is not self.obj:
                bpy.data.objects.remove(other)
        self.obj.data = self.given.copy()
        bpy.data.batch_remove([mesh for mesh in bpy.data.meshes if mesh not in (self.given, self.obj.data)])
        bpy.context.view_layer.update()
        edit(self.obj)
        select(self.obj, pairs(LOOP))

    def _keep(self):
        synchronize(self.obj)
        api.surface_of(self.obj)

    def _optimize(self, output, **settings):
        assert bpy.ops.mesh.optimize_contour(output=output, **SETTINGS, **settings) == {"FINISHED"}

    def _optimize_seams(self):
        assert bpy.ops.mesh.optimize_seams(**SETTINGS) == {"FINISHED"}


def run(repetitions=REPETITIONS, *outputs):
    bench = Bench()
    names = [
        name
        for name in bench.cases
        if "," not in name and name != "optimize_seams" or not outputs or name.split(",")[0] in outputs
    ]
    for name in names:  # loading and first allocations are not counted
        bench.measure(name)
    times = {name: [] for name in names}
    for _ in range(int(repetitions)):
        bench.renew()
        for name in names:
            times[name].append(bench.measure(name))
    print_table(len(bench.given.polygons), times)


def print_table(triangles, times):
    whole = sum(np.median(times[name]) for name in HAND_OVER)
    repetitions = len(times[HAND_OVER[0]])
    print(f"\nBlender {bpy.app.version_string}, {triangles} triangles, {repetitions} repetitions, milliseconds")
    print(f"{'':24}{'median':>8}{'minimum':>9}{'maximum':>9}{'ratio':>7}")
    for name, taken in {**times, "both together": [whole]}.items():
        ratio = "" if name in HAND_OVER else f"{np.median(taken) / whole:7.2f}"
        print(f"{name:24}{np.median(taken):8.0f}{min(taken):9.0f}{max(taken):9.0f}{ratio}")


run(*(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []))
