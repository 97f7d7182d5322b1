# SPDX-License-Identifier: GPL-3.0-or-later
"""The words in which the add-on reports, without Blender."""

import importlib
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
report = importlib.import_module("addon.report")


def done(status="improved", before=0.5, after=-1.0, reason="", place="Hand"):
    result = SimpleNamespace(status=status, initial_ratio=before, ratio=after, reason=reason)
    return report.Outcome(place, np.empty((0, 2)), result=result)


def left(problem, place="Hand"):
    return report.Outcome(place, np.empty((0, 2)), problem=problem)


STAYED = done("unchanged", -2, -2, "nothing better")


@pytest.mark.parametrize(
    ("outcomes", "expected"),
    [
        ([done()], "1 contour improved. Ratio 0.5 to -1"),
        ([STAYED], "1 contour unchanged (nothing better). Ratio -2 to -2"),
        ([done(), STAYED, done()], "2 contours improved, 1 unchanged (nothing better). Mean ratio -0.3333 to -1.333"),
        ([STAYED, STAYED], "2 contours unchanged (nothing better). Mean ratio -2 to -2"),
        ([done(), left("it branches")], "1 contour improved. Ratio 0.5 to -1. Left as it is: it branches"),
        (
            [done(), left("it branches", "Foot"), left("it is open")],
            "1 contour improved. Ratio 0.5 to -1. Left as it is: Foot: it branches; Hand: it is open",
        ),
        ([left(word) for word in "abcde"], "Left as it is: a; b; c and 2 more"),
    ],
)
def test_summary(outcomes, expected):
    assert report.summary(outcomes) == expected


def test_problems_name_their_elements():
    assert "a single edge, 4-8," in report.single_edge([4, 8])
    assert "at vertex 7;" in report.branching([7])
    assert "at vertices 1, 2, 3 and 6 more;" in report.branching(list(range(1, 10)))
    assert "(1-2, 2-3)" in report.loose([(1, 2), (2, 3)])
    ring, chain = report.Outcome.of("Ring", [3, 4, 5], True), report.Outcome.of("Ring", [3, 4, 5], False)
    assert "the loop through vertex 3 does not separate" in report.inseparable(ring)
    assert "from vertex 3 to 5 does not separate" in report.inseparable(chain)


def test_warnings_follow_once_each():
    warning = report.inside_out("Hand")
    assert "Recalculate Outside (Shift N)" in warning
    message = report.summary([done(), left("it branches")], [warning, warning])
    assert message == f"1 contour improved. Ratio 0.5 to -1. Left as it is: it branches. {warning}"


def test_a_contour_that_cannot_be_output_counts_as_left():
    refused = done()
    refused.problem = "it separates nothing"
    assert report.summary([refused]) == "Left as it is: it separates nothing"


@pytest.mark.parametrize("value", [-1.0, 0.0, 0.3, 0.7, 1.5, 2.0, 9.0])
def test_salience_in_words_from_nothing_to_a_clear_boundary(value):
    words = ["Nothing concave here", "Hardly concave", "Faint boundary", "Good boundary", "Clear boundary"]
    place = np.searchsorted([0.25, 0.5, 1.0, 2.0], value, side="right")
    result = SimpleNamespace(salience=value, statistics={"passes": 3})
    assert report.salience(result) == f"{words[place]} ({value:.2f})"


def test_where_nothing_was_searched_there_is_no_salience():
    assert report.salience(SimpleNamespace(salience=0.0, statistics={"passes": 0})) == ""


@pytest.mark.parametrize(("closed", "expected"), [(True, 14.0), (False, 11.0)])
def test_length(closed, expected):
    square = np.array([(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0)], dtype=float)
    assert report.length(SimpleNamespace(positions=square, closed=closed)) == expected


def test_alike_problems_are_said_once():
    assert report.summary([left("it branches"), left("it branches")]) == "Left as it is: it branches"
