# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's search for all selected contours of a mesh, without Blender: what becomes of contours in error."""

import importlib
import sys
from pathlib import Path

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
search = importlib.import_module("addon.core.search")
native_constraints = importlib.import_module("addon.core.native_constraints")
outcomes_module = importlib.import_module("addon.core.outcomes")
refusals = importlib.import_module("addon.core.refusals")

COLUMNS = 12
SETTINGS = {"width": 3, "reach": 0.0, "min_salience": 0.0}


def tube():
    """Three waists: around rows 0, 12, 24 and 36."""
    return meshes.tube(1 - 0.3 * np.cos(2 * np.pi * np.arange(37) / 12), COLUMNS)


def ring(row):
    return COLUMNS * row + np.arange(COLUMNS)


BAD = np.array([*ring(18), ring(19)[11]])  # its last edge is no edge of the mesh


def constraints(mesh, **fields):
    _, offsets, vertices, *_ = mesh.arguments()
    return native_constraints.Constraints(mesh.positions, np.asarray(offsets), np.asarray(vertices), **fields)


def started(mesh, *contours, closed=True, layers=None):
    outcomes = [outcomes_module.Outcome.of("Tube", np.asarray(contour), closed) for contour in contours]
    return search.ContourSearch(outcomes, surface=surface_of(mesh), constraints=layers)


class Counting:
    """The native module, which notes what is asked of it."""

    def __init__(self):
        self.calls = []

    def __getattr__(self, name):
        return getattr(mrc, name)

    def optimize_all(self, surface, contours, **more):
        self.calls.append(len(contours))
        return mrc.optimize_all(surface, contours, **more)

    def optimize(self, *_, **__):
        raise AssertionError("one contour by itself is never searched")

    measure = search_space = optimize


@pytest.fixture
def counting(monkeypatch):
    module = Counting()
    monkeypatch.setattr(search.native, "module", lambda: module)
    return module


def run(*searches, **settings):
    search.optimize_contours(list(searches), SETTINGS | settings)


@pytest.mark.parametrize("painted", [False, True])
def test_one_native_call_gives_each_contour_its_result_or_its_problem(counting, painted):
    mesh = tube()
    layers = constraints(mesh, pulls=np.ones(len(mesh.positions)), strength=1.0) if painted else None
    task = started(mesh, ring(10), BAD, ring(26), ring(0), layers=layers)
    run(task)
    assert counting.calls == [4]
    first, bad, third, border = task.outcomes
    assert task.done() == [first, third]
    assert [outcome.result.status for outcome in task.done()] == ["improved", "improved"]
    assert bad.problem == str(mrc.check_contour(task.surface, BAD))
    assert border.problem == str(mrc.check_contour(task.surface, ring(0)))
    assert bad.result is border.result is None


def test_a_contour_in_error_does_not_change_what_the_others_find_elsewhere():
    task, alone = started(tube(), ring(10), BAD, ring(26)), started(tube(), ring(10), ring(26))
    run(task)
    run(alone)
    found = [outcome.result.contour for outcome in task.done()]
    assert found == [outcome.result.contour for outcome in alone.done()]


def test_contours_that_no_search_can_help_fail_alone(counting):
    """No contour passes two vertices of a column, which lie in the band of the first alone, without sharp turns."""
    mesh = tube()
    column = np.array([ring(11)[4], ring(12)[4]])
    task = started(mesh, ring(11), ring(26), layers=constraints(mesh, required=column))
    run(task, max_turn=0.3)
    assert counting.calls == [2]
    stuck, free = task.outcomes
    assert stuck.problem.startswith("no contour in the band passes all required vertices")
    assert free.result.status == "improved"
    assert not task.outside


def test_required_vertices_outside_keep_all_contours_from_a_search(counting):
    mesh = tube()
    outside = [ring(34)[3], ring(34)[7]]
    task = started(mesh, ring(10), BAD, layers=constraints(mesh, required=np.array([ring(11)[1], *outside])))
    run(task)
    assert counting.calls == []
    sound, bad = task.outcomes
    assert sound.problem.startswith("2 required vertices lie outside the band")
    assert bad.problem == search.problem_on(task.surface, BAD)
    assert task.outside == outside


def test_painted_sides_turn_the_contours_that_have_sides(counting):
    mesh = tube()
    density = np.array([float(min(face) >= 18 * COLUMNS) for face in mesh.faces])
    loops = [ring(17), ring(17)[::-1].copy()]
    turned = []
    for loop in loops:
        task = started(mesh, loop, BAD, layers=constraints(mesh, density=density, region_strength=5.0))
        run(task)
        good, bad = task.outcomes
        turned.append(good.vertices.tolist())
        assert good.result is not None
        assert bad.problem == search.problem_on(task.surface, BAD)
    assert turned[0] == turned[1]
    chain = started(mesh, ring(17)[:5], closed=False, layers=constraints(mesh, density=density))
    run(chain)
    assert "an open chain does not enclose a region" in chain.outcomes[0].problem


def test_bad_settings_are_a_problem_of_all(counting):
    task = started(tube(), ring(10), BAD)
    run(task, width=0)
    assert len({outcome.problem for outcome in task.outcomes}) == 1
    assert "width" in task.outcomes[0].problem


def test_a_problem_is_what_keeps_a_contour_from_a_search():
    surface = surface_of(tube())
    assert search.problem_on(surface, ring(10)) == ""
    assert "twice" in search.problem_on(surface, [*ring(10), ring(10)[0]])
    crossing = [(ring(9)[2], ring(10)[2]), (ring(10)[2], ring(11)[2])]
    assert search.problem_on(surface, ring(10), barriers=crossing)
    assert search.problem_on(surface, ring(10)[:4], closed=False) == ""


def test_results_and_contours_are_taken_beside_vertices():
    mesh = tube()
    surface, layers = surface_of(mesh), constraints(mesh, pulls=np.ones(len(mesh.positions)), strength=1.0)
    result = search.optimize_on(surface, ring(10), constraints=layers, **SETTINGS)
    for given in (ring(10), mrc.Contour(ring(10))):
        assert search.optimize_on(surface, given, constraints=layers, **SETTINGS).contour == result.contour
    onward = search.optimize_all_on(surface, [result], constraints=layers, **SETTINGS)[0]
    assert onward.closed
    across = search.optimize_on(surface, ring(10), refinement=1, **SETTINGS)
    assert len(search.optimize_all_on(surface, [across], refinement=1, constraints=layers, **SETTINGS)) == 1
    arrays = across.edge_vertices, across.edge_parameters
    again = [search.optimize_on(surface, given, refinement=1, **SETTINGS) for given in (across, arrays)]
    assert again[0].contour == again[1].contour


@pytest.mark.parametrize("asked", [{"around_limb": True}, {"close": True}, {"closed": False, "close": True}])
def test_a_part_of_a_loop_is_closed_around_the_limb(asked):
    """`close` is the earlier name of `around_limb`."""
    surface = surface_of(tube())
    loop = mrc.close_contour(surface, ring(10)[:4])
    expected = search.optimize_on(surface, loop, **SETTINGS)
    assert search.optimize_on(surface, ring(10)[:4], **asked, **SETTINGS).contour == expected.contour
    open_chain = search.optimize_on(surface, ring(10)[:4], closed=False, close=False, **SETTINGS)
    assert not open_chain.closed


def test_the_number_of_closed_flags_is_checked_with_and_without_constraints():
    mesh = tube()
    for layers in (None, constraints(mesh, pulls=np.ones(len(mesh.positions)), strength=1.0)):
        with pytest.raises(ValueError, match="closed has 1 entries for 2 contours"):
            search.optimize_all_on(surface_of(mesh), [ring(10), ring(26)], closed=[True], constraints=layers)


def test_a_contour_in_error_says_where():
    """Errors carry the elements that they name from the search to whoever shows them."""
    task = started(tube(), ring(10), BAD)
    run(task)
    sound, bad = task.outcomes
    assert sound.culprits == ()
    assert set(bad.culprits) >= {("vertex", BAD[0]), ("vertex", BAD[-1])}
    again = started(tube(), BAD)
    search.find_problems(again, again.outcomes)
    assert again.outcomes[0].culprits == bad.culprits


def test_a_refusal_names_its_vertices_once_and_in_order():
    refusal = refusals.Refusal("why", np.array([[7, 3], [3, 5]]))
    assert str(refusal) == "why"
    assert refusals.culprits(refusal) == (("vertex", 3), ("vertex", 5), ("vertex", 7))
    assert refusals.culprits(ValueError("elsewhere")) == ()
    outcome = outcomes_module.Outcome("Tube", None)
    outcome.refuse(refusal)
    assert (outcome.problem, outcome.culprits) == ("why", refusal.elements)
