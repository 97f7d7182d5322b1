# SPDX-License-Identifier: GPL-3.0-or-later
"""Searches in background threads. Without a window there are no events, so the tests call the steps of a stand-in for
Blender's operator; its effects on the meshes are real."""

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
    grooved_cylinder,
    mark_edges,
    marked_edges,
    mesh_state,
    pairs,
    ring,
    rough_loop,
    select,
)
from minimum_ratio_contours import api
from minimum_ratio_contours.core import messages, parameters, search
from minimum_ratio_contours.mesh import contour_tasks
from minimum_ratio_contours.ui import background_search, network_operators, operators

LOOP = rough_loop(GROOVE - 3)
TIMER, ESC = SimpleNamespace(type="TIMER", value="NOTHING"), SimpleNamespace(type="ESC", value="PRESS")
RIGHT_CLICK = SimpleNamespace(type="RIGHTMOUSE", value="PRESS")


# ---- a search


def endless(progress):
    while True:
        progress(0.25)


def test_a_search_reports_its_progress_and_ends_when_canceled():
    running = background_search.BackgroundSearch(endless)
    assert not running.wait(0.01)
    assert running.fraction == 0.25
    running.cancel()
    assert running.wait(10)
    with pytest.raises(background_search.Cancelled):
        running.finish()


def test_an_exception_of_a_search_is_raised_by_finish():
    with pytest.raises(ZeroDivisionError):
        background_search.BackgroundSearch(lambda progress: 1 / 0).finish()


def test_a_canceled_native_search_ends_at_its_next_progress_report():
    surface = api.surface_of(grooved_cylinder())
    fractions, results, named = [], [], threading.Event()

    def search_once(progress):
        def leave(fraction):
            fractions.append(fraction)
            running.cancel()
            return progress(fraction)

        named.wait()
        results.append(api.optimize_on(surface, LOOP, progress=leave))

    running = background_search.BackgroundSearch(search_once)
    named.set()
    with pytest.raises(background_search.Cancelled):
        running.finish()
    assert len(fractions) == 1
    assert results == []


def test_canceled_closing_ends_at_its_next_progress_report():
    surface = api.surface_of(grooved_cylinder())
    fractions = []

    def leave(fraction):
        fractions.append(fraction)
        raise background_search.Cancelled

    with pytest.raises(background_search.Cancelled):
        api.optimize_on(surface, LOOP[5:16], close=True, progress=leave)
    assert fractions == [0.0]
    result = api.optimize_on(surface, LOOP[5:16], close=True, progress=lambda done: fractions.append(done) or False)
    assert result.status == "cancelled"
    assert fractions == [0.0, 0.0]


def test_closing_and_searching_share_one_progress():
    obj = grooved_cylinder()
    edit(obj)
    select(obj, pairs(LOOP[5:16], closed=False))
    tasks, fractions = contour_tasks.read_tasks([obj], face_mode=False, close=True), []
    search.optimize_contours(tasks, {}, lambda fraction: fractions.append(fraction) or True)
    assert fractions == sorted(fractions)
    assert (fractions[0], fractions[-1]) == (0.0, 1.0)
    assert 0.5 in fractions
    (outcome,) = tasks[0].outcomes
    whole = api.optimize_on(api.surface_of(obj), LOOP[5:16], close=True)
    np.testing.assert_array_equal(outcome.result.vertices, whole.vertices)


def test_several_searches_share_one_progress():
    fractions = []
    for i in range(4):
        search.fraction_of(fractions.append, i, 4)(0.5)
    assert fractions == [0.125, 0.375, 0.625, 0.875]
    assert search.fraction_of(None, 0, 4) is None


# ---- the operators

MAX_TURN = parameters.SETTINGS["max_turn"]["default"]


class Contour(operators.ContourOutput, operators.InEditMode, background_search.SearchOperator):
    output, keep_old, fill_holes, merge, close, max_turn = "SEAM", False, False, 0.0, False, MAX_TURN

    def constraints(self):
        return {}


class Seams(network_operators.NetworkOperator):
    selected_only, merge, max_turn = False, 0.0, MAX_TURN


class Segmentation(network_operators.NetworkOperator):
    source, attribute, merge, max_turn = "MATERIAL", "", 0.0, MAX_TURN


REAL = {
    Contour: operators.MESH_OT_optimize_contour,
    Seams: network_operators.MESH_OT_optimize_seams,
    Segmentation: network_operators.MESH_OT_optimize_segmentation,
}


def stand_in(kind):
    """Make an object with the methods of the real operator: only Blender can create operators."""
    real = REAL[kind]
    own = {name: value for name, value in vars(real).items() if not name.startswith("__") and callable(value)}
    operator = type(kind.__name__, (kind,), own | {"bl_label": real.bl_label, "nothing": "", "noun": "seams"})()
    operator.settings = dict  # the defaults
    operator.reported = []
    operator.report = lambda level, message: operator.reported.append((level, message))
    return operator


class Manager:
    """A window manager that records what is shown."""

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
    """Run as in a window, with a timer even for short searches."""
    monkeypatch.setattr(background_search, "bpy", SimpleNamespace(app=SimpleNamespace(background=False)))
    kind = background_search.BackgroundSearch
    monkeypatch.setattr(kind, "wait", _waits_only_when_asked(kind.wait))


def _waits_only_when_asked(wait):
    without_timer = background_search._WITHOUT_TIMER
    return lambda running, seconds=None: False if seconds == without_timer else wait(running, seconds)


def prepared():
    """Make a cylinder with a rough loop that is selected, a seam and the border of a material."""
    obj = grooved_cylinder()
    obj.data.materials.append(bpy.data.materials.new("One"))
    obj.data.materials.append(bpy.data.materials.new("Two"))
    rows = GROOVE - 2 + np.random.default_rng(3).integers(-1, 2, SEGMENTS)
    obj.data.polygons.foreach_set("material_index", (np.arange(RINGS - 1)[:, None] >= rows).ravel().astype(int))
    edit(obj)
    select(obj, pairs(LOOP))
    mark_edges(obj, pairs(LOOP), "seam")
    return obj


def until_done(operator, context):
    for _ in range(10**6):
        done = operator.modal(context, TIMER)
        if done != {"RUNNING_MODAL"}:
            return done
    raise AssertionError("the search does not end")


@pytest.mark.parametrize("kind", REAL)
def test_a_search_polled_by_a_timer_gives_the_same_result(kind, impatient):
    obj = prepared()
    name = REAL[kind].bl_idname.split(".")[1]
    given = {Contour: {"output": "SEAM"}, Seams: {}, Segmentation: {"source": "MATERIAL"}}[kind]
    getattr(bpy.ops.mesh, name)(**given)
    expected = mesh_state(obj)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(obj)
    obj, operator, context = prepared(), stand_in(kind), Context()
    assert mesh_state(obj) != expected
    assert operator.invoke(context, None) == {"RUNNING_MODAL"}
    assert until_done(operator, context) == {"FINISHED"}
    assert mesh_state(obj) == expected
    assert (operator._tasks, operator._search) == (None, None)
    fractions = context.window_manager.shown
    assert (fractions[0], fractions[-1], context.window_manager.timers) == ("begin", "end", 0)
    assert all(0 <= fraction <= 100 for fraction in fractions[1:-1])
    assert "ESC: Cancel" in context.status[0]
    assert context.status[-1] is None


@pytest.mark.parametrize("event", [ESC, RIGHT_CLICK])
@pytest.mark.parametrize("kind", REAL)
def test_escape_leaves_the_mesh_unchanged(kind, event, impatient, last):
    obj, operator, context = prepared(), stand_in(kind), Context()
    before = mesh_state(obj)
    operator.invoke(context, None)
    running = operator._search
    assert operator.modal(context, event) == {"CANCELLED"}
    assert running.wait(60)
    assert mesh_state(obj) == before
    assert operator.reported == [({"INFO"}, messages.CANCELLED)]
    assert last.message == messages.CANCELLED
    assert (context.window_manager.timers, context.status[-1]) == (0, None)


@pytest.mark.parametrize("kind", REAL)
def test_blender_can_end_the_operator(kind, impatient):
    """For example because another file is opened."""
    obj, operator, context = prepared(), stand_in(kind), Context()
    before = mesh_state(obj)
    operator.invoke(context, None)
    running = operator._search
    operator.cancel(context)
    assert running.wait(0)
    assert mesh_state(obj) == before
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
def test_nothing_is_written_if_the_mesh_changed_during_the_search(kind, change, impatient):
    obj, operator, context = prepared(), stand_in(kind), Context()
    operator.invoke(context, None)
    change(obj)
    assert until_done(operator, context) == {"CANCELLED"}
    assert operator.reported == [({"WARNING"}, messages.CHANGED_MEANWHILE)]
    if change is move_a_vertex:
        assert marked_edges(obj, "seam") == edge_set(LOOP)


@pytest.mark.parametrize("kind", REAL)
def test_a_fast_search_needs_no_timer(kind, monkeypatch):
    monkeypatch.setattr(background_search, "bpy", SimpleNamespace(app=SimpleNamespace(background=False)))
    monkeypatch.setattr(background_search, "_WITHOUT_TIMER", 60.0)
    prepared()
    operator, context = stand_in(kind), Context()
    assert operator.invoke(context, None) == {"FINISHED"}
    assert (context.window_manager.shown, context.status) == ([], [])


def test_without_a_window_the_operator_does_not_become_modal():
    obj = prepared()
    assert bpy.ops.mesh.optimize_contour("INVOKE_DEFAULT", output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == edge_set(ring(GROOVE))
