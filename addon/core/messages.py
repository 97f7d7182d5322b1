# SPDX-License-Identifier: GPL-3.0-or-later
"""All that the add-on says to the user. Needs no Blender."""

import numpy as np

from . import native
from .parameters import SETTINGS

NOTHING_SELECTED = (
    "Nothing to optimize: select closed loops or open chains of edges, or faces in face mode to use their borders"
)
CANCELLED = "Cancelled: everything is as it was"
CHANGED_MEANWHILE = "The mesh was changed during the search, so that nothing was written; run it again"
NO_BORDER = "the selected faces have no border inside the mesh: deselect some"
TURN_LESS = "Sharpest Turn is below its default: raise Sharpest Turn to let contours turn more"
NO_FACES = "there are no faces, which alone are curved"
NO_VIEW = "Contours are adjusted in a 3D View: move the mouse over one, or use Optimize Contour"
_SALIENCES = (  # from this salience on, in words
    (2.0, "clear boundary"),
    (1.0, "good boundary"),
    (0.5, "faint boundary"),
    (0.25, "hardly concave"),
    (-np.inf, "nothing concave here"),
)
# What the native module cannot do, by its errors' classes, and why it returned the given contour, by its codes: in the
# words of the panel, with what to do.
_PROBLEMS = {
    "TooLarge": "the search would need more memory than there is: lower Refinement or Width, or clear Whole Surface",
    "Infeasible": "no contour in the band passes all required vertices: raise Width, Reach or Sharpest Turn, or take "
    "some vertices out of the group",
}
_REASONS = {
    "already_best": "it is already the best nearby: raise Width or Reach to look farther",
    "not_salient": "there is nothing concave to follow here: lower Least Salience to move it all the same",
    "no_room": "there are no faces around it to search: select fewer contours, or subdivide the mesh",
    "against_flow": "no way in the band leads along it: raise Width or Sharpest Turn",
    "no_neighbour": "no loop of edges beside it is free to search from: move it off borders and from itself",
    "shared_faces": "other contours cross the same faces: optimize one at a time",
    "none_refined": "no better contour was found across faces: set Refinement to 0, or raise it",
    "cancelled": "cancelled",
}
_SAME_ANGLE = 1e-5  # properties are floats of 32 bits
_NAMED = 3  # of several alike, only so many are named


def summary(outcomes, notes=()):
    """One line for the status bar: what improved, what did not and why, the ratios, what was left out, and notes."""
    if not outcomes:
        return NOTHING_SELECTED
    results = [outcome.result for outcome in outcomes if outcome.result is not None and not outcome.problem]
    sentences = []
    if results:
        moved = any(result.ratio != result.initial_ratio for result in results)
        sentences = [_statuses(results), _ratios(results)] if moved else [_statuses(results)]
    left = [outcome for outcome in outcomes if outcome.problem]
    if left:
        sentences.append(_left(outcomes, left))
    return ". ".join([*sentences, *dict.fromkeys(notes)])


def _left(outcomes, left):
    """What was left as it is, and where; alike once."""
    everywhere = len({outcome.place for outcome in outcomes})
    places = {}
    for outcome in left:
        places.setdefault(outcome.problem, {})[outcome.place] = None
    texts = [why if len(at) == everywhere else f"{shortened([*at])}: {why}" for why, at in places.items()]
    return "Left as it is: " + shortened(texts, "; ")


def single_edge(vertices):
    return f"a single edge, {vertices[0]}-{vertices[-1]}, has nothing to move between its ends; select a longer chain"


def meets_another(vertices):
    return (
        f"the open chain from vertex {vertices[0]} to {vertices[-1]}, once closed, would meet another contour; "
        "select one chain or loop for each limb"
    )


def level(outcomes, warnings):
    """How Blender is to report them: as a warning where there is something to warn of, or nothing else."""
    return "WARNING" if warnings or not outcomes or any(outcome.problem for outcome in outcomes) else "INFO"


def turn_notes(outcomes, max_turn):
    """What besides Width and Reach keeps a search from what is better, where nothing better was found."""
    prunes = max_turn < SETTINGS["max_turn"]["default"] - _SAME_ANGLE
    results = [outcome.result for outcome in outcomes if outcome.result is not None]
    return [TURN_LESS] if prunes and any(result.reason_code == "already_best" for result in results) else []


def problem(error):
    """What an error says to the user: the native module's in the panel's words, without the places in its lists."""
    return _PROBLEMS.get(type(error).__name__) or native.message_and_contour(error)[0]


def reason(result):
    """Why the given contour was returned; empty where it was not."""
    if not result.reason_code:
        return ""
    others = len(result.held_back_by)
    beside = "1 other contour" if others == 1 else f"{others} other contours"
    return _REASONS[result.reason_code] + (f"; {beside} beside it kept the search back" if others else "")


def pins_outside(count):
    """What to do about pins that no contour can reach; empty where there are none."""
    if not count:
        return ""
    pins = "1 pinned vertex lies" if count == 1 else f"{count} pinned vertices lie"
    return f"{pins} outside the band: widen it (wheel), or unpin (X)"


def unsearchable(error, count):
    """Why nothing could be searched for with the pins there are, so many of them outside the band."""
    if count:
        return pins_outside(count)
    if type(error).__name__ == "Infeasible":
        return "No contour in the band passes all pinned vertices: click one to unpin it, or widen the band (wheel)"
    return problem(error)


def inseparable(outcome):
    if outcome.closed:
        return (
            f"the loop through vertex {outcome.vertices[0]} does not separate the mesh: it runs round a handle; "
            "select a second loop round it too, or use Cut or Seam"
        )
    return (
        f"the open chain from vertex {outcome.vertices[0]} to {outcome.vertices[-1]} does not separate the mesh; "
        "extend it to the mesh border or to a loop, or use Rip"
    )


def hidden_part(outcome):
    return (
        f"the part beyond the contour through vertex {outcome.vertices[0]} is partly hidden and would not come along; "
        "reveal it first (Alt H)"
    )


def uneven_scale(place):
    return f"{place} is scaled unevenly or mirrored, and is measured without it; to count it, apply it (Ctrl A > Scale)"


def not_mirrored(place):
    return f"X Mirror is on, but {place} is not symmetric here, so that only what is selected moved"


def inside_out(place):
    return (
        f"The normals of {place} point inward, so that grooves count as ridges: "
        "Mesh > Normals > Recalculate Outside (Shift N)"
    )


def linked(obj):
    return (
        f"{obj.name} is linked from another file and read only: make it local first (Object > Relations > Make Local)"
    )


def branching(vertices):
    noun = "vertex" if len(vertices) == 1 else "vertices"
    return f"a selection that branches at {noun} {shortened(vertices)}; select single loops, or faces in face mode"


def no_layer(kind, name):
    if not name:
        return f"no {kind} is named: choose one under Constraints, or none at all"
    return f"there is no {kind} named {name}: choose another one under Constraints, or clear the field"


def open_region():
    return "an open chain encloses no region: set Region to None under Constraints, or select a closed loop"


def curvature_shown(count, problems, values, colors):
    sentences = []
    if count:
        places = "1 mesh" if count == 1 else f"{count} meshes"
        sentences = [f"Curvature of {places} is in the attributes '{values}', in 1 / length, and '{colors}'"]
    if problems:
        sentences.append("Not shown: " + shortened(problems, "; "))
    return ". ".join(sentences)


def directions_shown(count, problems):
    sentences = []
    if count:
        sentences = [f"Directions at {count} concave vertices"]
    elif not problems:
        sentences = ["Nothing is notably concave here: there are no directions to show"]
    if problems:
        sentences.append("Not shown: " + shortened(problems, "; "))
    return ". ".join(sentences)


def name_taken(name):
    return f"another kind of attribute is named '{name}': rename or remove it"


def loose(edges, closed=True):
    noun = "a loop" if closed else "an open chain"
    names = shortened([f"{a}-{b}" for a, b in edges])
    return f"{noun} with loose edges that no face uses ({names}); select edges of faces only"


def shortened(items, separator=", "):
    """The first few items as text, and how many more there are."""
    texts = [str(item) for item in items[:_NAMED]]
    more = len(items) - len(texts)
    return separator.join(texts) + (f" and {more} more" if more else "")


def milliseconds(result):
    return 1000.0 * sum(result.statistics["seconds"].values())


def salience(result):
    """How far to trust a result, in words and as a number; empty where nothing was searched."""
    if not result.statistics["passes"]:
        return ""
    words = next(words for least, words in _SALIENCES if result.salience >= least)
    return f"{words.capitalize()} ({result.salience:.2f})"


def length(result):
    """Of the contour found, in object space."""
    points = np.asarray(result.positions)
    ends = np.roll(points, -1, axis=0) if result.closed else points[1:]
    return float(np.linalg.norm(ends - points[: len(ends)], axis=1).sum())


def _statuses(results):
    improved = sum(result.status == "improved" for result in results)
    others = [result for result in results if result.status != "improved"]
    parts = [f"{_counted(improved)} improved"] if improved else []
    for status in sorted({result.status for result in others}):
        alike = [result for result in others if result.status == status]
        reasons = [why for why in dict.fromkeys(map(reason, alike)) if why]
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


def network_summary(outcomes, noun, notes=()):
    """One line for the status bar: how many moved, the ratios, what was left out and why, and notes."""
    results = [outcome.result for outcome in outcomes if outcome.result is not None]
    left = [outcome for outcome in outcomes if outcome.result is None]
    moved = sum(result.status == "improved" for result in results)
    sentences = []
    if moved:
        sentences = [f"{moved} of {len(outcomes)} {noun} moved", _ratios(results)]
    elif results:
        sentences = [_nothing_better(results, noun)]
    if left:
        sentences.append(_left(outcomes, left))
    return ". ".join([*sentences, *dict.fromkeys(notes)])


def _nothing_better(results, noun):
    """With the reason, where all have the same."""
    reasons = set(map(reason, results))
    why = reasons.pop() if len(reasons) == 1 else ""
    return f"No better place was found for the {noun}" + (f" ({why})" if why else "")


NO_BORDERS = "Nothing to optimize: there are no borders between regions; choose another source, or label some faces"


def no_seams(selected_only):
    seams = "selected seams" if selected_only else "seams"
    hint = ", or clear Selected Only" if selected_only else ""
    return f"Nothing to optimize: there are no {seams} of two edges or more; mark some{hint}"


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
