# SPDX-License-Identifier: GPL-3.0-or-later
"""The words in which the add-on reports, without Blender."""

import importlib
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
messages = importlib.import_module("addon.core.messages")
outcomes_module = importlib.import_module("addon.core.outcomes")
Outcome, network_outcomes = outcomes_module.Outcome, outcomes_module.network_outcomes
parameters = importlib.import_module("addon.core.parameters")


def done(status="improved", before=0.5, after=-1.0, code="", place="Hand", held_back_by=()):
    result = SimpleNamespace(
        status=status, initial_ratio=before, ratio=after, reason_code=code, held_back_by=held_back_by
    )
    return Outcome(place, np.empty((0, 2)), result=result)


def left(problem, place="Hand"):
    return Outcome(place, np.empty((0, 2)), problem=problem)


STAYED = done("unchanged", -2, -2, "cancelled")
BEST = done("unchanged", -2, -2, "already_best")


@pytest.mark.parametrize(
    ("outcomes", "expected"),
    [
        ([done()], "1 contour improved. Ratio 0.5 to -1"),
        ([STAYED], "1 contour unchanged (cancelled)"),
        ([done(), STAYED, done()], "2 contours improved, 1 unchanged (cancelled). Mean ratio -0.3333 to -1.333"),
        ([STAYED, STAYED], "2 contours unchanged (cancelled)"),
        ([done(), left("it branches")], "1 contour improved. Ratio 0.5 to -1. Left as it is: it branches"),
        (
            [done(), left("it branches", "Foot"), left("it is open")],
            "1 contour improved. Ratio 0.5 to -1. Left as it is: Foot: it branches; Hand: it is open",
        ),
        (
            [left("it is open"), left("it is open", "Foot"), left("it branches")],
            "Left as it is: it is open; Hand: it branches",
        ),
        ([left(word) for word in "abcde"], "Left as it is: a; b; c and 2 more"),
    ],
)
def test_summary(outcomes, expected):
    assert messages.summary(outcomes) == expected


def test_every_native_reason_has_words_of_its_own():
    codes = set(re.findall(r"'(\w+)'", mrc.Result.reason_code.__doc__))
    assert len(codes) > 5
    assert codes == messages._REASONS.keys()
    assert len(set(messages._REASONS.values())) == len(codes)
    assert messages.reason(done().result) == ""


@pytest.mark.parametrize(("held_back_by", "words"), [((4,), "1 other contour"), ((2, 0, 7), "3 other contours")])
def test_contours_in_the_way_are_counted_not_numbered(held_back_by, words):
    why = messages.reason(done("unchanged", code="already_best", held_back_by=held_back_by).result)
    assert why.endswith(f"; {words} beside it kept the search back")


def test_words_name_settings_as_the_panel_shows_them():
    texts = [*messages._REASONS.values(), *messages._PROBLEMS.values()]
    shown = {row["name"] for row in parameters.SETTINGS.values()}
    named = [name for text in texts for name in re.findall(r"(?<!^)\b[A-Z]\w+(?: [A-Z]\w+)*", text)]
    assert len(named) > 5
    assert set(named) <= shown
    assert not [text for text in texts if "_" in text]


def large_torus():
    return meshes.torus(160, 400)


@pytest.mark.parametrize(("outcome", "turn", "noted"), [(BEST, 0.5, True), (BEST, 3.0, False), (done(), 0.5, False)])
def test_a_turn_below_the_default_is_named_where_nothing_better_is_found(outcome, turn, noted):
    assert messages.turn_notes([outcome], turn) == [messages.TURN_LESS] * noted
    default = np.float32(parameters.SETTINGS["max_turn"]["default"])
    assert messages.turn_notes([outcome], default) == []


def test_native_errors_are_put_into_the_panels_words():
    mesh = large_torus()
    ring = [400 * row for row in range(160)]
    options = mrc.Options(refinement=16, width=250, flow="arc_length")
    with pytest.raises(mrc.TooLarge, match="lower refinement") as caught:
        mrc.optimize(surface_of(mesh), ring, options=options)
    assert "lower Refinement or Width" in messages.problem(caught.value)
    assert issubclass(mrc.TooLarge, ValueError)


def test_the_place_in_a_list_is_left_out():
    mesh = meshes.torus(14, 30)
    with pytest.raises(ValueError, match=r"^contour 1: ") as caught:
        mrc.optimize_all(surface_of(mesh), [[30 * row for row in range(14)], [3, 4, 4]])
    assert messages.problem(caught.value) == str(caught.value).removeprefix("contour 1: ")
    assert messages.problem(ValueError("contour lines: none")) == "contour lines: none"


def test_problems_name_their_elements():
    assert "a single edge, 4-8," in messages.single_edge([4, 8])
    assert "at vertex 7;" in messages.branching([7])
    assert "at vertices 1, 2, 3 and 6 more;" in messages.branching(list(range(1, 10)))
    assert "(1-2, 2-3)" in messages.loose([(1, 2), (2, 3)])
    assert "from vertex 4 to 9, once closed, would meet another" in messages.meets_another([4, 5, 9])
    ring, strand = Outcome.of("Ring", [3, 4, 5], True), Outcome.of("Ring", [3, 4, 5], False)
    assert "the loop through vertex 3 does not separate" in messages.inseparable(ring)
    assert "from vertex 3 to 5 does not separate" in messages.inseparable(strand)


TORN = "a border whose move would join or split regions"


@pytest.mark.parametrize(
    ("outcomes", "expected"),
    [
        ([done(), STAYED, done()], "2 of 3 seams moved. Mean ratio -0.3333 to -1.333"),
        ([STAYED, STAYED], "No better place was found for the seams (cancelled)"),
        ([STAYED, BEST], "No better place was found for the seams"),
        ([done(), left(TORN), left(TORN)], f"1 of 3 seams moved. Ratio 0.5 to -1. Left as it is: {TORN}"),
        ([STAYED, left("no", "Foot")], "No better place was found for the seams (cancelled). Left as it is: Foot: no"),
        ([left("there are no face sets")], "Left as it is: there are no face sets"),
    ],
)
def test_summary_of_a_network(outcomes, expected):
    assert messages.network_summary(outcomes, "seams") == expected


def chain(*vertices, movable=True):
    return SimpleNamespace(vertices=np.array(vertices), closed=False, movable=movable)


def test_each_chain_that_could_move_has_a_result_or_a_problem():
    result, labels = done().result, np.array([4, 4, 7])
    chains = [chain(0, 1, 2), chain(2, 3, movable=False), chain(3, 4, 5), chain(5, 6, 7), chain(7, 8, 9)]
    region_check = SimpleNamespace(lost={3: 2, 4: -1})
    plan = SimpleNamespace(
        chains=chains, problems={2: "beside a hole"}, region_check=region_check, taken_results=lambda: {0: result}
    )
    outcomes = network_outcomes("Hand", plan, lambda region: messages.lost_region(labels, region))
    assert [outcome.edges[0].tolist() for outcome in outcomes] == [[0, 1], [3, 4], [5, 6], [7, 8]]
    assert [outcome.result for outcome in outcomes] == [result, None, None, None]
    thin = "the borders of region 7, which is too thin to keep otherwise"
    assert [outcome.problem for outcome in outcomes] == ["", "beside a hole", thin, TORN]


def test_warnings_follow_once_each():
    warning = messages.inside_out("Hand")
    assert "Recalculate Outside (Shift N)" in warning
    message = messages.summary([done(), left("it branches")], [warning, warning])
    assert message == f"1 contour improved. Ratio 0.5 to -1. Left as it is: it branches. {warning}"


def test_a_contour_that_cannot_be_output_counts_as_left():
    refused = done()
    refused.problem = "it separates nothing"
    assert messages.summary([refused]) == "Left as it is: it separates nothing"


@pytest.mark.parametrize("value", [-1.0, 0.0, 0.3, 0.7, 1.5, 2.0, 9.0])
def test_salience_in_words_from_nothing_to_a_clear_boundary(value):
    words = ["Nothing concave here", "Hardly concave", "Faint boundary", "Good boundary", "Clear boundary"]
    place = np.searchsorted([0.25, 0.5, 1.0, 2.0], value, side="right")
    result = SimpleNamespace(salience=value, statistics={"passes": 3})
    assert messages.salience(result) == f"{words[place]} ({value:.2f})"


def test_where_nothing_was_searched_there_is_no_salience():
    assert messages.salience(SimpleNamespace(salience=0.0, statistics={"passes": 0})) == ""


@pytest.mark.parametrize(("closed", "expected"), [(True, 14.0), (False, 11.0)])
def test_length(closed, expected):
    square = np.array([(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0)], dtype=float)
    assert messages.length(SimpleNamespace(positions=square, closed=closed)) == expected


def test_of_nothing_the_summary_says_what_to_select():
    assert messages.summary([]) == messages.NOTHING_SELECTED


def test_what_was_left_and_what_is_odd_is_a_warning():
    assert messages.level([done(), STAYED], []) == "INFO"
    assert messages.level([done(), left("it branches")], []) == "WARNING"
    assert messages.level([done()], [messages.inside_out("Hand")]) == "WARNING"
    assert messages.level([], []) == "WARNING"


def test_alike_problems_are_said_once():
    assert messages.summary([left("it branches"), left("it branches")]) == "Left as it is: it branches"
