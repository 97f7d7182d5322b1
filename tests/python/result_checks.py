# SPDX-License-Identifier: GPL-3.0-or-later
"""What holds for every result, whatever the mesh and the options, checked with nothing but the triangles."""

from dataclasses import dataclass, field
from itertools import combinations, pairwise
from types import SimpleNamespace

import mrcontour as mrc
import numpy as np
from contour_checks import crossings, meetings, on_surface
from contour_energy import edge_of, points_of, vertex


@dataclass
class Task:
    """A contour on a mesh, with its options and constraints."""

    surface: mrc.Surface
    triangles: np.ndarray
    given: list
    closed: bool
    options: mrc.Options
    constraints: dict = field(default_factory=dict)
    hidden: frozenset = frozenset()
    faces: list | None = None  # None if the triangles are the faces


def triangles_near(triangles, *contours):
    """The part of a mesh that the checks need: the triangles at the contours."""
    ends = np.unique([v for points in contours for point in points for v in point[:2]])
    return SimpleNamespace(triangles=triangles[np.isin(triangles, ends).any(axis=1)])


def check_result(task, result):
    points = points_of(result)
    near = triangles_near(task.triangles, points)
    check_numbers(result)
    assert result.closed == task.closed
    assert len(points) >= (3 if result.closed else 2)
    assert on_surface(near, points, result.closed)
    assert crossings(near, points, result.closed) == []
    check_segment_faces(task, result, points)
    check_status(task, result, points)
    if result.status != "cancelled":
        assert passes(points, result.closed, task.constraints)
        check_ends(task, points)
        check_measure(task, result)


def check_finite(result):
    names = ("ratio", "initial_ratio", "objective", "initial_objective", "salience", "lower_bound", "gap")
    scales = [getattr(result.scales, name) for name in ("h", "K", "kappa_0", "L0")]
    assert np.isfinite([*(getattr(result, name) for name in names), *scales]).all()
    assert np.isfinite(result.history).all()
    assert np.isfinite(result.positions).all()
    assert result.gap >= 0


def check_numbers(result):
    check_finite(result)
    assert result.lower_bound <= result.objective
    assert min(result.scales.h, result.scales.K, result.scales.L0) > 0
    assert all(0 <= t < 1 for t in result.edge_parameters)


def check_status(task, result, points):
    """A result is never worse than the given contour, unless that breaks a requirement."""
    meant = passes(task.given, task.closed, task.constraints)
    if result.status == "improved":
        assert meant
        assert result.objective < result.initial_objective
    elif result.status == "constrained":
        assert not meant
    else:
        assert result.status in ("unchanged", "cancelled")
        assert points == task.given
        assert result.status == "cancelled" or meant
        runs = task.options.iterations + task.options.regular_iterations
        assert len(result.reason) >= 10 or runs == 0


def passes(points, closed, constraints):
    """Whether a contour passes all required elements."""
    chords = list(pairwise([*points, points[0]] if closed else points))
    for a, b in constraints.get("required_edges", ()):
        along = [chord for chord in chords if edge_of(*chord) == tuple(sorted((int(a), int(b))))]
        covered = {point for chord in along for point in chord}
        if not {vertex(a), vertex(b)} <= covered or len(along) != len(covered) - 1:
            return False
    return {vertex(v) for v in constraints.get("required_vertices", ())} <= set(points)


def check_ends(task, points):
    """An open contour keeps its ends and, with 'edges', its first and last edge, unless these are chords across a face.
    Only an end on the border may slide."""
    if task.closed or task.options.ends in ("border", "edges_or_border"):
        return
    assert (points[0], points[-1]) == (task.given[0], task.given[-1])
    if task.options.ends == "edges":
        for one, two in ((points[:2], task.given[:2]), (points[:-3:-1], task.given[:-3:-1])):
            assert edge_of(*two) is None or edge_of(*one) == edge_of(*two)


def check_segment_faces(task, result, points):
    """Each segment lies in the face named for it, and none runs across a hidden face."""
    chords = list(pairwise([*points, points[0]] if result.closed else points))
    holding = result.segment_faces.tolist()
    assert len(holding) == len(chords)
    faces = task.triangles.tolist() if task.faces is None else task.faces
    before = set(pairwise([*task.given, task.given[0]]))
    for (one, two), face in zip(chords, holding, strict=True):
        assert {*one[:2], *two[:2]} <= set(faces[face])
        across = edge_of(one, two) is None and (one, two) not in before
        assert not (across and face in task.hidden)


def check_measure(task, result):
    """The ratio of the result is that of its contour. The enclosed integral is relative to the given contour."""
    if "region_density" in task.constraints:
        return
    more = {"attractors": task.constraints.get("attractors", ()), "scales": result.scales}
    measured = mrc.measure(task.surface, result, result.closed, options=task.options, **more)
    size = max(abs(measured.ratio), abs(result.ratio), result.scales.K)
    assert abs(measured.ratio - result.ratio) <= 1e-6 * size


def check_apart(tasks, results):
    """Results meet only where the given contours did, at points or along edges, and cross nowhere."""
    for (one, p), (two, q) in combinations(list(zip(tasks, results, strict=True)), 2):
        found = points_of(p), points_of(q)
        shared = places(one) & places(two)
        near = triangles_near(one.triangles, *found)
        for meeting in meetings(near, *found, (p.closed, q.closed)):
            assert any(vertices_at(meeting) <= place for place in shared), meeting


def places(task):
    """The vertices and edges that the given contour runs along."""
    chords = pairwise([*task.given, task.given[0]] if task.closed else task.given)
    along = [frozenset(v for p in chord for v in p[:2]) for chord in chords]
    return {frozenset(p[:2]) for p in task.given} | {place for place in along if len(place) == 2}


def vertices_at(meeting):
    """The ends of the edges that contain a point or two crossing chords."""
    points = [meeting] if isinstance(meeting[0], int) else [p for chord in meeting for p in chord]
    return {v for p in points for v in p[:2]}
