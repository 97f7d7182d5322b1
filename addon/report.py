# SPDX-License-Identifier: GPL-3.0-or-later
"""What became of the selected contours, in the user's words. Needs no Blender."""

from dataclasses import dataclass

import numpy as np

from . import contours

NOTHING_SELECTED = "Nothing to optimize: select a closed loop of edges, or faces in face mode to use their borders"
_NAMED = 3  # of several alike, only so many are named


@dataclass(frozen=True)
class Outcome:
    """One contour of the selection: its native result, or the problem for which it was left as it is."""

    place: str  # the object's name
    edges: np.ndarray  # as selected, (n, 2) vertex pairs
    result: object = None
    problem: str = ""


def summary(outcomes):
    """One line for the status bar: what improved, what did not and why, the ratios, and what was left out."""
    results = [outcome.result for outcome in outcomes if outcome.result is not None]
    sentences = []
    if results:
        sentences = [_statuses(results), _ratios(results)]
    left = [outcome for outcome in outcomes if outcome.result is None]
    if left:
        sentences.append(_left(outcomes, left))
    return ". ".join(sentences)


def _left(outcomes, left):
    """What was left as it is, and where; alike once."""
    several_places = len({outcome.place for outcome in outcomes}) > 1
    texts = [f"{outcome.place}: {outcome.problem}" if several_places else outcome.problem for outcome in left]
    return "Left as it is: " + shortened(list(dict.fromkeys(texts)), "; ")


def open_chain(vertices):
    return f"an open chain from vertex {vertices[0]} to {vertices[-1]}, only closed loops can be optimized"


def branching(vertices):
    noun = "vertex" if len(vertices) == 1 else "vertices"
    return f"a selection that branches at {noun} {shortened(vertices)}; select single loops, or faces in face mode"


def loose(edges):
    return f"a loop with loose edges that no face uses ({shortened([f'{a}-{b}' for a, b in edges])})"


def shortened(items, separator=", "):
    """The first few items as text, and how many more there are."""
    texts = [str(item) for item in items[:_NAMED]]
    more = len(items) - len(texts)
    return separator.join(texts) + (f" and {more} more" if more else "")


def milliseconds(result):
    return 1000.0 * sum(result.statistics["seconds"].values())


def _statuses(results):
    improved = sum(result.status == "improved" for result in results)
    others = [result for result in results if result.status != "improved"]
    parts = [f"{_counted(improved)} improved"] if improved else []
    for status in sorted({result.status for result in others}):
        alike = [result for result in others if result.status == status]
        reasons = list(dict.fromkeys(result.reason for result in alike if result.reason))
        count = len(alike) if parts else _counted(len(alike))
        parts.append(f"{count} {status}" + (f" ({shortened(reasons, '; ')})" if reasons else ""))
    return ", ".join(parts)


def _counted(count):
    return f"{count} contour" if count == 1 else f"{count} contours"


def _ratios(results):
    before = np.mean([result.initial_ratio for result in results])
    after = np.mean([result.ratio for result in results])
    return f"{'Ratio' if len(results) == 1 else 'Mean ratio'} {before:.4g} to {after:.4g}"


# ---- networks


def network_outcomes(place, plan, why_lost):
    """What became of each chain of a network that could have moved; why_lost explains a region that would be lost."""
    taken = plan.taken_results()
    outcomes = []
    for i, chain in enumerate(plan.chains):
        edges = contours.contour_edges(chain.vertices, chain.closed)
        if i in taken:
            outcomes.append(Outcome(place, edges, result=taken[i]))
        elif chain.movable:
            problem = plan.problems.get(i) or why_lost(plan.settlement.lost.get(i, -1))
            outcomes.append(Outcome(place, edges, problem=problem))
    return outcomes


def network_summary(outcomes, noun):
    """One line for the status bar: how many moved, the ratios, and what was left out and why."""
    results = [outcome.result for outcome in outcomes if outcome.result is not None]
    left = [outcome for outcome in outcomes if outcome.result is None]
    moved = sum(result.status == "improved" for result in results)
    sentences = []
    if moved:
        sentences = [f"{moved} of {len(outcomes)} {noun} moved", _ratios(results)]
    elif results:
        sentences = [f"No better place was found for the {noun}"]
    if left:
        sentences.append(_left(outcomes, left))
    return ". ".join(sentences)


def lost_region(labels, region):
    if region < 0:
        return "a border whose move would join or split regions"
    return f"the borders of region {labels[region]}, which is too thin to keep otherwise"


def no_face_sets():
    return "there are no face sets: make some in Sculpt Mode, or choose another source"


def no_attribute(name):
    if not name:
        return "no attribute is named: choose an integer attribute of the faces"
    return f"there is no integer attribute '{name}' of the faces: convert it, or choose another one"
