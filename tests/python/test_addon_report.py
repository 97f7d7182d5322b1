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
    assert report.open_chain([4, 8, 9]) == "an open chain from vertex 4 to 9, only closed loops can be optimized"
    assert "at vertex 7;" in report.branching([7])
    assert "at vertices 1, 2, 3 and 6 more;" in report.branching(list(range(1, 10)))
    assert "(1-2, 2-3)" in report.loose([(1, 2), (2, 3)])
