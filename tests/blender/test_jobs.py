# SPDX-License-Identifier: GPL-3.0-or-later
"""Searches in a thread of their own. Without a window there are no events, so a stand-in for Blender's operator has its
steps called by hand; what it does to the meshes is real."""

import threading
from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import (
    GROOVE,
    RINGS,
    SEGMENTS,
    edge_set,
    edit,
    everything,
    flagged,
    grooved_cylinder,
    pairs,
    ring,
    rough_loop,
    select,
    set_flag,
)
from minimum_ratio_contours import api, jobs, network_operators, operators, report, selection

LOOP = rough_loop(GROOVE - 3)
TIMER, ESC = SimpleNamespace(type="TIMER", value="NOTHING"), SimpleNamespace(type="ESC", value="PRESS")
RIGHT_CLICK = SimpleNamespace(type="RIGHTMOUSE", value="PRESS")


# ---- a job


def endless(progress):
    while True:
        progress(0.25)


def test_a_job_tells_its_share_and_ends_when_left():
    job = jobs.Job(endless)
    assert not job.wait(0.01)
    assert job.share == 0.25
    job.cancel()
    assert job.wait(10)
    with pytest.raises(jobs.Cancelled):
        job.finish()


def test_what_a_search_raises_is_raised_where_it_is_awaited():
    with pytest.raises(ZeroDivisionError):
        jobs.Job(lambda progress: 1 / 0).finish()


def test_a_native_search_ends_at_the_next_word_of_its_progress():
    surface = api.surface_of(grooved_cylinder())
    shares, results, named = [], [], threading.Event()

    def search(progress):
        def leave(share):
            shares.append(share)
            job.cancel()
            return progress(share)

        named.wait()
        results.append(api.optimize_on(surface, LOOP, progress=leave))

    job = jobs.Job(search)
    named.set()
    with pytest.raises(jobs.Cancelled):
        job.finish()
    assert len(shares) == 1
    assert results == []


def test_closing_a_contour_ends_at_the_next_word_of_its_progress():
    surface = api.surface_of(grooved_cylinder())
    shares = []

    def leave(share):
        shares.append(share)
        raise jobs.Cancelled

    with pytest.raises(jobs.Cancelled):
        api.optimize_on(surface, LOOP[5:16], close=True, progress=leave)
    assert shares == [0.0]
    result = api.optimize_on(surface, LOOP[5:16], close=True, progress=lambda share: shares.append(share) or False)
    assert result.status == "cancelled"
    assert shares == [0.0, 0.0]


def test_closing_and_searching_share_one_progress():
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(LOOP[5:16], closed=False))
    parts, shares = selection.read_parts([obj], face_mode=False, close=True), []
    selection.optimize_parts(parts, {}, lambda share: shares.append(share) or True)
    assert shares == sorted(shares)
    assert (shares[0], shares[-1]) == (0.0, 1.0)
    assert 0.5 in shares
    (outcome,) = parts[0].outcomes
    whole = api.optimize_on(api.surface_of(obj), LOOP[5:16], close=True)
    np.testing.assert_array_equal(outcome.result.vertices, whole.vertices)


def test_several_searches_share_one_progress():
    shares = []
    for i in range(4):
        jobs.share_of(shares.append, i, 4)(0.5)
    assert shares == [0.125, 0.375, 0.625, 0.875]
    assert jobs.share_of(None, 0, 4) is None


# ---- the operators


class Contour(operators.ContourOutput, operators.SearchInEditMode):
    output, keep_old, fill_holes, merge, close = "SEAM", False, False, 0.0, False

    def constraints(self):
        return {}


class Seams(network_operators.NetworkOperator):
    selected_only, merge = False, 0.0


class Segmentation(network_operators.NetworkOperator):
    source, attribute, merge = "MATERIAL", "", 0.0


REAL = {
    Contour: operators.MESH_OT_optimize_contour,
    Seams: network_operators.MESH_OT_optimize_seams,
    Segmentation: network_operators.MESH_OT_optimize_segmentation,
}


def stand_in(kind):
    """With the methods of the real operator, but made by hand: Blender makes operators only itself."""
    real = REAL[kind]
    own = {name: value for name, value in vars(real).items() if not name.startswith("__") and callable(value)}
    operator = type(kind.__name__, (kind,), own | {"bl_label": real.bl_label, "nothing": "", "noun": "seams"})()
    operator.settings = dict  # the defaults
    operator.reported = []
    operator.report = lambda level, message: operator.reported.append((level, message))
    return operator


class Manager:
    """A window manager that notes what is shown."""

    def __init__(self):
        self.minimum_ratio_contours = bpy.context.window_manager.minimum_ratio_contours
        self.shown, self.timers = [], 0

    def progress_begin(self, low, high):
        assert (low, high) == (0.0, 100.0)
        self.shown.append("begin")

    def progress_update(self, value):
        self.shown.append(value)

    def progress_end(self):
        self.shown.append("end")

    def event_timer_add(self, interval, window):
        self.timers += 1
        return "timer"

    def event_timer_remove(self, timer):
        self.timers -= 1

    def modal_handler_add(self, operator):
        pass


class Context:
    """Blender's context with a window."""

    def __init__(self):
        self.window, self.window_manager = "window", Manager()
        self.status = []
        self.workspace = SimpleNamespace(status_text_set=self.status.append)

    def __getattr__(self, name):
        return getattr(bpy.context, name)


@pytest.fixture
def impatient(monkeypatch):
    """As in a window, with a timer for every search however short."""
    monkeypatch.setattr(jobs, "bpy", SimpleNamespace(app=SimpleNamespace(background=False)))
    monkeypatch.setattr(jobs.Job, "wait", _waits_only_when_asked(jobs.Job.wait))


def _waits_only_when_asked(wait):
    return lambda job, seconds=None: False if seconds == jobs._PATIENCE else wait(job, seconds)


def prepared():
    """A cylinder with a rough loop selected, as a seam and as the border of a material."""
    obj = grooved_cylinder()
    obj.data.materials.append(bpy.data.materials.new("One"))
    obj.data.materials.append(bpy.data.materials.new("Two"))
    rows = GROOVE - 2 + np.random.default_rng(3).integers(-1, 2, SEGMENTS)
    obj.data.polygons.foreach_set("material_index", (np.arange(RINGS - 1)[:, None] >= rows).ravel().astype(int))
    edit(obj)
    select(obj, pairs(LOOP))
    set_flag(obj, pairs(LOOP), "seam")
    return obj


def until_done(operator, context):
    for _ in range(10**6):
        done = operator.modal(context, TIMER)
        if done != {"RUNNING_MODAL"}:
            return done
    raise AssertionError("the search does not end")


@pytest.mark.parametrize("kind", REAL)
def test_done_by_a_timer_it_is_the_same_as_at_once(kind, impatient):
    obj = prepared()
    name = REAL[kind].bl_idname.split(".")[1]
    given = {Contour: {"output": "SEAM"}, Seams: {}, Segmentation: {"source": "MATERIAL"}}[kind]
    getattr(bpy.ops.mesh, name)(**given)
    expected = everything(obj)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(obj)
    obj, operator, context = prepared(), stand_in(kind), Context()
    assert everything(obj) != expected
    assert operator.invoke(context, None) == {"RUNNING_MODAL"}
    assert until_done(operator, context) == {"FINISHED"}
    assert everything(obj) == expected
    assert (operator._work, operator._job) == (None, None)
    shares = context.window_manager.shown
    assert (shares[0], shares[-1], context.window_manager.timers) == ("begin", "end", 0)
    assert all(0 <= share <= 100 for share in shares[1:-1])
    assert "ESC: Cancel" in context.status[0]
    assert context.status[-1] is None


@pytest.mark.parametrize("event", [ESC, RIGHT_CLICK])
@pytest.mark.parametrize("kind", REAL)
def test_left_with_escape_the_mesh_is_as_it_was(kind, event, impatient, last):
    obj, operator, context = prepared(), stand_in(kind), Context()
    before = everything(obj)
    operator.invoke(context, None)
    job = operator._job
    assert operator.modal(context, event) == {"CANCELLED"}
    assert job.wait(60)
    assert everything(obj) == before
    assert operator.reported == [({"INFO"}, report.CANCELLED)]
    assert last.message == report.CANCELLED
    assert (context.window_manager.timers, context.status[-1]) == (0, None)


@pytest.mark.parametrize("kind", REAL)
def test_blender_may_end_it(kind, impatient):
    """As when another file is opened."""
    obj, operator, context = prepared(), stand_in(kind), Context()
    before = everything(obj)
    operator.invoke(context, None)
    job = operator._job
    operator.cancel(context)
    assert job.wait(0)
    assert everything(obj) == before
    assert context.window_manager.timers == 0


def move_a_vertex(obj):
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.verts[7].co.x += 0.1
    bmesh.update_edit_mesh(obj.data)


def leave_edit_mode(_):
    bpy.ops.object.mode_set(mode="OBJECT")


def delete_the_object(obj):
    bpy.data.objects.remove(obj)


@pytest.mark.parametrize("change", [move_a_vertex, leave_edit_mode, delete_the_object])
@pytest.mark.parametrize("kind", REAL)
def test_a_mesh_that_was_changed_meanwhile_is_left_alone(kind, change, impatient):
    obj, operator, context = prepared(), stand_in(kind), Context()
    operator.invoke(context, None)
    change(obj)
    assert until_done(operator, context) == {"CANCELLED"}
    assert operator.reported == [({"WARNING"}, report.CHANGED_MEANWHILE)]
    if change is move_a_vertex:
        assert flagged(obj, "seam") == edge_set(LOOP)


@pytest.mark.parametrize("kind", REAL)
def test_what_takes_no_time_needs_no_timer(kind, monkeypatch):
    monkeypatch.setattr(jobs, "bpy", SimpleNamespace(app=SimpleNamespace(background=False)))
    monkeypatch.setattr(jobs, "_PATIENCE", 60.0)
    prepared()
    operator, context = stand_in(kind), Context()
    assert operator.invoke(context, None) == {"FINISHED"}
    assert (context.window_manager.shown, context.status) == ([], [])


def test_without_a_window_it_runs_at_once():
    obj = prepared()
    assert bpy.ops.mesh.optimize_contour("INVOKE_DEFAULT", output="SEAM") == {"FINISHED"}
    assert flagged(obj, "seam") == edge_set(ring(GROOVE))
