# SPDX-License-Identifier: GPL-3.0-or-later
"""Every mesh file of Debian's libcgal-demo, unchanged and damaged: each call gives a valid result or says what is
wrong.

Outcomes are counted by kind and reported as properties in the JUnit report.
"""

import os
import re
import time
from collections import Counter
from math import pi

import mrcontour as mrc
import numpy as np
import pytest
from contour_energy import points_of, vertex
from random_cases import random_energy
from result_checks import Task, check_apart, check_result
from rough_contours import LONGEST, RoughContours

if not os.environ.get("MRC_LONG"):
    pytest.skip("only with tests/run --full, which installs the meshes and their reader", allow_module_level=True)

import cgal_meshes  # noqa: E402

pytestmark = [pytest.mark.long, pytest.mark.slow]

CALLS = 20  # the minimum number of contours tried on each mesh
SECONDS = 60  # seconds after which a call counts as hung
KINDS = ("face_set", "plane_cut", "chain", "hole", "parallel_cuts")
COUNTS = Counter()


def random_options(rng, small):
    """Sometimes changes each option from its default."""
    often = {
        "width": int(rng.integers(1, 6)) if not small or rng.random() < 0.8 else None,
        "refinement": int(rng.integers(0, 3)),
        "iterations": int(rng.integers(0, 4)),
        "flow": str(rng.choice(["harmonic", "gates", "arc_length"])),
    }
    seldom = {
        "band_distance": 0.5,
        "regular_iterations": 1,
        "length_bias": 0.8,
        "length_floor": 0.5,
        "anchor": 0.7,
        "feature_clamp": 0.9,
        "crease": 0.5,
        "min_salience": 0.5,
        "ends": str(rng.choice(["vertices", "border"])),
        "region_weight": rng.uniform(-2, 2),
        "region_side": "right",
        "threads": 2,
    }
    chosen = often | {name: value for name, value in seldom.items() if rng.random() < 0.25}
    if rng.random() < 0.2:
        chosen |= {"denominator": "arcs", "length_measure": "edges"}
    return mrc.Options(**chosen | random_energy(rng) | ({"max_turn": pi} if rng.random() < 0.2 else {}))


def random_constraints(rng, contour, closed, positions, triangles):
    """Required elements on or beside the contour, barriers beside it, attractors, and a region density."""
    near = triangles[np.isin(triangles, contour).any(axis=1)]
    near = near[rng.integers(len(near), size=4)]
    i = int(rng.integers(len(contour) - 1))
    reach = 3 * np.linalg.norm(positions[contour[i]] - positions[contour[i + 1]]) + 1e-9
    constraints = {
        "required_vertices": [int(rng.choice([contour[i], near[0, 0]]))],
        "required_edges": [contour[i : i + 2].tolist()],
        "attractors": [(int(near[1, 1]), reach, rng.uniform(-2, 2))],
        "barriers": near[2:, :2].tolist(),
    }
    if closed:
        constraints["region_density"] = rng.uniform(0, 1, len(triangles))
    return {name: value for name, value in constraints.items() if rng.random() < 0.2}


def deadline():
    """A progress function that aborts a call that takes too long. Its exception is not a ValueError, so the test
    fails."""
    end = time.monotonic() + SECONDS

    def progress(_):
        if time.monotonic() > end:
            raise TimeoutError("the call hangs")

    return progress


def attempt(counts, call):
    """The result of a call, or None if it says what is wrong. Counts both, and records the slowest call."""
    start, result, message = time.perf_counter(), None, None
    try:
        result = call()
    except ValueError as error:
        message = str(error)
    counts["slowest, in ms"] = max(counts["slowest, in ms"], int(1000 * (time.perf_counter() - start)))
    if message is not None:
        assert len(message) >= 10
        counts["errors"] += 1
        counts["error: " + re.sub(r"[-\d.]+(e[-+]?\d+)?", "#", message)[:90]] += 1
    return result


class Trial:
    """A mesh, and contours of all kinds on it."""

    def __init__(self, positions, triangles, rng, counts):
        self.positions, self.rng, self.counts = positions, rng, counts
        surface = attempt(counts, lambda: mrc.Surface(positions, None, triangles))
        counts["surfaces refused"] += surface is None
        self.triangles = triangles if surface else cgal_meshes.drop_degenerate(triangles)
        share = rng.choice([0.0, 0.0, 0.01])
        self.hidden = np.flatnonzero(rng.random(len(self.triangles)) < share).astype(np.int32)
        self.surface = mrc.Surface(positions, None, self.triangles, hidden_faces=self.hidden)
        self.kinds = RoughContours(positions, self.triangles, rng)
        self.calls = 0

    def run(self, calls):
        """Tries contours until there were enough. Kinds that do not occur on the mesh give none."""
        for attempt in range(10 * calls):
            if self.calls >= calls:
                return
            kind = KINDS[attempt % len(KINDS)]
            contours = getattr(self.kinds, kind)()
            if kind == "parallel_cuts":
                self.optimize_all(contours)
                continue
            for vertices, closed in contours[:2]:
                self.optimize(vertices, closed)

    def task(self, vertices, closed, constraints=True):
        rng, given = self.rng, [vertex(v) for v in vertices]
        chosen = random_constraints(rng, vertices, closed, self.positions, self.triangles) if constraints else {}
        options = random_options(rng, len(self.triangles) < 3000)
        hidden = frozenset(self.hidden.tolist())
        return Task(self.surface, self.triangles, given, closed, options, chosen, hidden)

    def called(self, contours, call):
        self.calls += contours
        self.counts["contours"] += contours
        return attempt(self.counts, call)

    def optimize(self, vertices, closed):
        """Optimizes a contour, and sometimes the result again."""
        task = self.task(vertices, closed)
        more = {"closed": closed, "options": task.options, **task.constraints}
        found = self.called(1, lambda: mrc.optimize(self.surface, vertices, progress=deadline(), **more))
        self.accept([task], found and [found])
        if found and self.rng.random() < 0.2:
            task = self.task(vertices, closed, constraints=False)
            task.given = points_of(found)
            more = {"closed": closed, "options": task.options, "scales": found.scales}
            again = self.called(1, lambda: mrc.optimize(self.surface, found, progress=deadline(), **more))
            self.accept([task], again and [again])
        if not closed or self.rng.random() < 0.2:
            self.close(vertices[: len(vertices) // 2])

    def close(self, chain):
        if len(chain) < 2:
            return
        loop = attempt(self.counts, lambda: mrc.close_contour(self.surface, chain, progress=deadline()))
        if loop is not None:
            assert loop[: len(chain)].tolist() == chain.tolist()
            assert len(set(loop.tolist())) == len(loop)
            self.counts["closed chains"] += 1
            if len(loop) <= 3 * LONGEST:
                self.optimize(loop, True)

    def optimize_all(self, contours):
        if not contours:
            return
        tasks = [self.task(vertices, closed, constraints=False) for vertices, closed in contours]
        options = tasks[0].options
        for task in tasks:
            task.options = options
        vertices, closed = (list(column) for column in zip(*contours, strict=True))
        more = {"closed": closed, "options": options, "progress": deadline()}
        found = self.called(len(tasks), lambda: mrc.optimize_all(self.surface, vertices, **more))
        self.accept(tasks, found)
        if found:
            check_apart(tasks, found)

    def accept(self, tasks, results):
        for task, result in zip(tasks, results or (), strict=bool(results)):
            check_result(task, result)
            self.counts["results"] += 1
            self.counts[result.status] += 1


@pytest.mark.parametrize("name", sorted(cgal_meshes.contents()))
def test_every_call_gives_a_valid_result_or_an_error(name):
    positions, triangles = cgal_meshes.read(name)
    counts = Counter()
    for number, variant in enumerate(cgal_meshes.VARIANTS):
        rng = np.random.default_rng([number, len(positions), len(triangles)])
        if len(triangles):
            trial = Trial(*variant(positions, triangles, rng), rng, counts)
            trial.run(CALLS)
            counts["meshes"] += 1
            assert trial.calls >= CALLS or len(triangles) < 50, f"{variant.__name__}: {trial.calls} contours"
    slowest = max(COUNTS["slowest, in ms"], counts["slowest, in ms"])
    COUNTS.update(counts)
    COUNTS["slowest, in ms"] = slowest


def test_most_contours_give_results(record_testsuite_property):
    for name, count in COUNTS.most_common():
        record_testsuite_property(name, count)
    assert COUNTS["results"] >= 0.5 * COUNTS["contours"]
