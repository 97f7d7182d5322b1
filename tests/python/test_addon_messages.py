# SPDX-License-Identifier: GPL-3.0-or-later
"""The messages of the add-on, without Blender."""

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
refusals = importlib.import_module("addon.core.refusals")


def done(status="improved", salience=2.5, rings=4, code="", place="Hand", held_back_by=(), fault=None):
    result = SimpleNamespace(
        status=status,
        salience=salience,
        statistics={"rings": rings, "passes": 3},
        reason_code=code,
        held_back_by=held_back_by,
    )
    return Outcome(place, np.empty((0, 2)), result=result, fault=fault)


def unmoved(problem, place="Hand"):
    return Outcome(place, np.empty((0, 2)), problem=problem)


UNCHANGED = done("unchanged", code="cancelled")
BEST = done("unchanged", code="already_best")
CLEAR = "1 contour improved: clear boundary, 4 rings away"


@pytest.mark.parametrize(
    ("outcomes", "expected"),
    [
        ([done()], CLEAR),
        ([done(salience=0.6, rings=1)], "1 contour improved: faint boundary, 1 ring away"),
        ([done(salience=-1.0, rings=0)], "1 contour improved: nothing concave here, less than a ring away"),
        ([UNCHANGED], "1 contour unchanged: cancelled"),
        (
            [done(), UNCHANGED, done(rings=6)],
            "2 contours improved: clear boundaries, up to 6 rings away; 1 unchanged: cancelled",
        ),
        (
            [done(), done(salience=0.7), done(rings=2)],
            "3 contours improved: 2 clear boundaries, 1 faint boundary, up to 4 rings away",
        ),
        ([UNCHANGED, UNCHANGED], "2 contours unchanged: cancelled"),
        ([done(), unmoved("it branches")], CLEAR + ". Left unchanged: it branches"),
        (
            [done(), unmoved("it branches", "Foot"), unmoved("it is open")],
            CLEAR + ". Left unchanged: Foot: it branches; Hand: it is open",
        ),
        (
            [unmoved("it is open"), unmoved("it is open", "Foot"), unmoved("it branches")],
            "Left unchanged: it is open; Hand: it branches",
        ),
        ([unmoved(word) for word in "abcde"], "Left unchanged: a; b; c and 2 more"),
    ],
)
def test_summary(outcomes, expected):
    assert messages.summary(outcomes) == expected


def test_every_native_reason_has_its_own_text():
    codes = set(re.findall(r"'(\w+)'", mrc.Result.reason_code.__doc__))
    assert len(codes) > 5
    assert codes == messages._REASONS.keys()
    assert len(set(messages._REASONS.values())) == len(codes)
    assert messages.reason(done().result) == ""


@pytest.mark.parametrize(("held_back_by", "words"), [((4,), "1 other contour"), ((2, 0, 7), "3 other contours")])
def test_limiting_contours_are_counted_not_numbered(held_back_by, words):
    why = messages.reason(done("unchanged", code="already_best", held_back_by=held_back_by).result)
    assert why.endswith(f"; {words} nearby limited the search")


def test_no_reason_is_given_twice():
    """Whatever else differs between contours: the elements that a problem names, and who was in the way."""
    held = [done("unchanged", code="already_best", held_back_by=others) for others in ((), (1,), (2, 1))]
    message = messages.summary([*held, BEST])
    assert message.count("already the best") == 1
    assert message.endswith("; 2 other contours nearby limited the search")
    single = [Outcome("Hand", np.empty((0, 2))) for _ in range(46)]
    for i, outcome in enumerate(single):
        outcome.refuse(refusals.Refusal(messages.single_edge([i, i + 1]), [i], code="single_edge"))
    message = messages.summary(single)
    assert message.count("nothing between its ends") == 1
    assert message.endswith(" (and 45 more like it)")
    native = mrc.optimize_all(surface_of(meshes.torus(14, 30)), [[3, 4, 4], [7, 8, 8]], errors="return")
    refused = [Outcome("Hand", np.empty((0, 2))) for _ in native]
    for outcome, error in zip(refused, native, strict=True):
        outcome.refuse(error)
    assert messages.summary(refused).count("twice") == 1


def test_a_fault_of_the_mesh_comes_before_what_the_search_says_of_it():
    fault = refusals.Refusal("faces are not joined here", [3])
    stays = done("unchanged", code="already_best", fault=fault)
    assert messages.summary([stays, stays]) == "2 contours unchanged: faces are not joined here"
    moved = messages.summary([done(fault=fault), done(fault=fault)])
    assert moved.endswith(". A fault of the mesh may have dented a contour: faces are not joined here")
    assert moved.count("joined") == 1


def test_nothing_advises_to_lower_what_keeps_contours_off_tips():
    for text in [*messages._REASONS.values(), *messages._PROBLEMS.values()]:
        assert "Least Salience" not in text
        assert "Whole Surface" not in text or "clear Whole Surface" in text


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (848912.0, "849000"),
        (-0.33333, "-0.333"),
        (1.0, "1"),
        (0.0, "0"),
        (2.5e-7, "0.00000025"),
        (1e15, "1" + 15 * "0"),
    ],
)
def test_numbers_have_three_digits_and_no_exponent(number, text):
    assert messages.readable(number) == text


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_ratios_are_shown_without_the_mesh_s_unit(scale):
    result = SimpleNamespace(initial_ratio=0.5 / scale, ratio=-1.25 / scale, scales=SimpleNamespace(h=0.2 * scale))
    assert messages.ratios(result) == "Ratio 0.1 to -0.25 (per edge)"


def test_messages_name_settings_as_the_panel_does():
    texts = [*messages._REASONS.values(), *messages._PROBLEMS.values()]
    shown = {row["name"] for row in parameters.SETTINGS.values()}
    named = [name for text in texts for name in re.findall(r"(?<!^)\b[A-Z]\w+(?: [A-Z]\w+)*", text)]
    assert len(named) > 5
    assert set(named) <= shown
    assert not [text for text in texts if "_" in text]


def large_torus():
    return meshes.torus(160, 400)


@pytest.mark.parametrize(("outcome", "turn", "noted"), [(BEST, 0.5, True), (BEST, 3.0, False), (done(), 0.5, False)])
def test_a_turn_below_the_default_is_named_if_nothing_better_is_found(outcome, turn, noted):
    assert messages.turn_notes([outcome], turn) == [messages.TURN_LESS] * noted
    default = np.float32(parameters.SETTINGS["max_turn"]["default"])
    assert messages.turn_notes([outcome], default) == []


def test_native_errors_are_reworded_in_terms_of_the_panel():
    mesh = large_torus()
    ring = [400 * row for row in range(160)]
    options = mrc.Options(refinement=16, width=250, flow="arc_length")
    with pytest.raises(mrc.TooLarge, match="lower refinement") as caught:
        mrc.optimize(surface_of(mesh), ring, options=options)
    assert "lower Refinement or Width" in messages.problem(caught.value)
    assert issubclass(mrc.TooLarge, ValueError)


def test_a_problem_is_the_sentence_without_the_index_of_the_contour():
    contours = [[30 * row for row in range(14)], [3, 4, 4]]
    with pytest.raises(ValueError, match=r"^contour 1: ") as caught:
        mrc.optimize_all(surface_of(meshes.torus(14, 30)), contours)
    error = mrc.optimize_all(surface_of(meshes.torus(14, 30)), contours, errors="return")[1]
    assert messages.problem(error) == str(caught.value).removeprefix("contour 1: ")
    assert messages.problem(ValueError("contour lines: none")) == "contour lines: none"


def test_texts_go_by_codes_and_not_by_classes():
    assert messages._PROBLEMS.keys() == {"too_large", "infeasible"}
    for code, text in messages._PROBLEMS.items():
        assert messages.problem(SimpleNamespace(code=code)) == text
    assert messages.unsearchable(SimpleNamespace(code="infeasible"), 0).startswith("No contour in the band")


def test_nothing_in_the_add_on_matches_patterns_in_messages():
    addon = Path(messages.__file__).resolve().parents[1]
    sources = {path: path.read_text(encoding="utf-8") for path in addon.glob("*/*.py")}
    assert len(sources) > 30
    assert not [path for path, text in sources.items() if re.search(r"^\s*(import|from) re\b", text, re.MULTILINE)]
    assert not [path for path, text in sources.items() if re.search(r" in str\(error\)|str\(error\)\.", text)]


def test_problems_name_their_elements():
    assert "a single edge, 4-8," in messages.single_edge([4, 8])
    assert "at vertex 7;" in messages.branching([7])
    assert "at vertices 1, 2, 3 and 6 more;" in messages.branching(list(range(1, 10)))
    assert "(1-2, 2-3)" in messages.loose([(1, 2), (2, 3)])
    assert "from vertex 4 to 9, once closed, would meet another" in messages.meets_another([4, 5, 9])
    ring, strand = Outcome.of("Ring", [3, 4, 5], True), Outcome.of("Ring", [3, 4, 5], False)
    assert "the loop through vertex 3 does not separate" in messages.inseparable(ring)
    assert "from vertex 3 to 5 does not separate" in messages.inseparable(strand)


SPLIT = "a border whose move would join or split regions"


@pytest.mark.parametrize(
    ("outcomes", "expected"),
    [
        ([done(), UNCHANGED, done()], "2 of 3 seams moved: clear boundaries, up to 4 rings away"),
        ([UNCHANGED, UNCHANGED], "No better position was found for the seams: cancelled"),
        ([UNCHANGED, BEST], "No better position was found for the seams"),
        (
            [done(), unmoved(SPLIT), unmoved(SPLIT)],
            f"1 of 3 seams moved: clear boundary, 4 rings away. Left unchanged: {SPLIT}",
        ),
        (
            [UNCHANGED, unmoved("no", "Foot")],
            "No better position was found for the seams: cancelled. Left unchanged: Foot: no",
        ),
        ([unmoved("there are no face sets")], "Left unchanged: there are no face sets"),
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
    thin = "the borders of region 7, which is so thin that it would disappear"
    assert [outcome.problem for outcome in outcomes] == ["", "beside a hole", thin, SPLIT]


def test_warnings_follow_without_repetition():
    warning = messages.inside_out("Hand")
    assert "Recalculate Outside (Shift N)" in warning
    message = messages.summary([done(), unmoved("it branches")], [warning, warning])
    assert message == f"{CLEAR}. Left unchanged: it branches. {warning}"


def test_a_contour_without_output_counts_as_unchanged():
    refused = done()
    refused.problem = "it separates nothing"
    assert messages.summary([refused]) == "Left unchanged: it separates nothing"


@pytest.mark.parametrize("value", [-1.0, 0.0, 0.3, 0.7, 1.5, 2.0, 9.0])
def test_salience_is_named_from_nothing_to_a_clear_boundary(value):
    words = ["Nothing concave here", "Hardly concave", "Faint boundary", "Good boundary", "Clear boundary"]
    place = np.searchsorted([0.25, 0.5, 1.0, 2.0], value, side="right")
    result = SimpleNamespace(salience=value, statistics={"passes": 3})
    assert messages.salience(result) == f"{words[place]} ({value:.2f})"


def test_without_a_search_there_is_no_salience():
    assert messages.salience(SimpleNamespace(salience=0.0, statistics={"passes": 0})) == ""


def test_the_summary_of_nothing_says_what_to_select():
    assert messages.summary([]) == messages.NOTHING_SELECTED


def test_problems_and_warnings_are_reported_as_warnings():
    assert messages.level([done(), UNCHANGED], []) == "INFO"
    assert messages.level([done(), unmoved("it branches")], []) == "WARNING"
    assert messages.level([done()], [messages.inside_out("Hand")]) == "WARNING"
    assert messages.level([], []) == "WARNING"


def test_equal_problems_are_reported_once():
    assert messages.summary([unmoved("it branches"), unmoved("it branches")]) == "Left unchanged: it branches"


def test_what_was_left_out_is_one_clause():
    counts = {"spur": 2, "doubled edge": 1, "island": 0}
    assert messages.left_out(counts) == ["Left out of the selection: 1 doubled edge, 2 spurs"]
    assert messages.left_out({"island": 0}) == messages.joined(0) == []
    assert messages.joined(12) == ["12 dashes were joined"]


def test_advice_on_branching_fits_the_mode():
    assert messages.branching([3]) == "the selection branches at vertex 3; select single loops, or faces in face mode"
    assert "face mode" not in messages.branching([3, 4], from_faces=True)
