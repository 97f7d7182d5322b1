# SPDX-License-Identifier: GPL-3.0-or-later
"""All messages that the add-on shows to the user. Does not need Blender.

A report is one line of sentences: what was found and where; what stays, and why; notes. A reason is "cause: cure", in
the panel's words, and no report gives one twice. Numbers that need explaining are left to the panel.
"""

from collections import Counter

import numpy as np

from .parameters import SETTINGS

NOTHING_SELECTED = (
    "Nothing to optimize: select closed loops or open chains of edges, or faces in face mode to use their borders"
)
CANCELLED = "Cancelled: nothing was changed"
CHANGED_MEANWHILE = "The mesh was changed during the search, so nothing was written; run it again"
NO_BORDER = "the selected faces have no border inside the mesh: deselect some"
TURN_LESS = "Sharpest Turn is below its default: raise it to let contours turn more"
NO_FACES = "it has no faces, and only faces have a curvature"
NO_VIEW = "Contours are adjusted in a 3D Viewport: move the mouse over one, or use Optimize Contour"
_SALIENCES = (  # (least salience, its name, that of several)
    (2.0, "clear boundary", "clear boundaries"),
    (1.0, "good boundary", "good boundaries"),
    (0.5, "faint boundary", "faint boundaries"),
    (0.25, "hardly concave", "hardly concave"),
    (-np.inf, "nothing concave here", "not concave"),
)
# Native errors and the reasons for returning the given contour, by code. The texts name settings as the panel does and
# suggest a fix; errors without a text here have a sentence of their own.
_PROBLEMS = {
    "too_large": "the search would need more memory than there is: lower Refinement or Width, or clear Whole Surface",
    "infeasible": "no contour in the band passes all required vertices: raise Width, Reach or Sharpest Turn, or remove "
    "some vertices from the group",
}
_REASONS = {
    "already_best": "already the best nearby: raise Width or Reach to look farther",
    "not_salient": "nothing concave to follow nearby: start closer to the groove, or raise Width and Reach",
    "no_room": "no faces around it to search: select fewer contours, or subdivide the mesh",
    "against_flow": "no path in the band follows it: raise Width or Sharpest Turn",
    "no_neighbour": "no loop of edges next to it is free to search from: move it away from borders and from itself",
    "shared_faces": "other contours cross the same faces: optimize one at a time",
    "none_refined": "no better contour was found across faces: set Refinement to 0, or raise it",
    "slipped_off": "nothing better nearby: all that was found is the tip, and nothing is concave there",
    "cancelled": "cancelled",
}
_ANGLE_TOLERANCE = 1e-5  # properties are 32-bit floats
_MAX_LISTED = 3  # how many items of a list are named


def summary(outcomes, notes=()):
    """Return one line for the status bar: what was found, what stays and why, problems and notes."""
    if not outcomes:
        return NOTHING_SELECTED
    done = [outcome for outcome in outcomes if outcome.result is not None and not outcome.problem]
    failed = [outcome for outcome in outcomes if outcome.problem]
    sentences = [_statuses(done)] if done else []
    if failed:
        sentences.append(_left_unchanged(outcomes, failed))
    return ". ".join([*sentences, *dict.fromkeys([*_dents(done), *notes])])


def _left_unchanged(outcomes, failed):
    """Return why contours were left unchanged, each problem once, with the objects unless it concerns all of them."""
    everywhere = len({outcome.place for outcome in outcomes})
    alike = {}
    for outcome in failed:
        alike.setdefault(outcome.kind or outcome.problem, []).append(outcome)
    texts = []
    for some in alike.values():
        places = list(dict.fromkeys(outcome.place for outcome in some))
        others = len({outcome.problem for outcome in some}) - 1
        why = some[0].problem + (f" (and {others} more like it)" if others else "")
        texts.append(why if len(places) == everywhere else f"{shortened(places)}: {why}")
    return "Left unchanged: " + shortened(texts, "; ")


def _dents(outcomes):
    """Return the faults of meshes that may have dented contours."""
    faults = [str(outcome.fault) for outcome in outcomes if outcome.fault and outcome.result.status != "unchanged"]
    return [f"A fault of the mesh may have dented a contour: {fault}" for fault in dict.fromkeys(faults)]


def single_edge(vertices, from_faces=False):
    edge = f"a single edge, {vertices[0]}-{vertices[-1]}, has nothing between its ends to move; "
    if from_faces:
        return edge + "select other faces"
    return edge + "turn on Close Chains to take the loop through it around the limb, or select a longer chain"


def meets_another(vertices):
    return (
        f"the open chain from vertex {vertices[0]} to {vertices[-1]}, once closed, would meet another contour; "
        "select only one chain or loop per limb"
    )


def left_out(counts):
    """Return a note on what was selected but hardly meant, given how many there are of each kind; empty if none."""
    parts = [f"{count} {noun}" + "s" * (count != 1) for noun, count in sorted(counts.items()) if count]
    return ["Left out of the selection: " + ", ".join(parts)] if parts else []


def joined(dashes):
    """Return a note that dashes were joined; empty if none were."""
    return [f"{dashes} dashes were joined"] if dashes else []


def level(outcomes, warnings):
    """Return Blender's report level: a warning if there are warnings or problems, or no outcome at all."""
    return "WARNING" if warnings or not outcomes or any(outcome.problem for outcome in outcomes) else "INFO"


def turn_notes(outcomes, max_turn):
    """Return a hint to raise Sharpest Turn if it is low and nothing better was found."""
    prunes = max_turn < SETTINGS["max_turn"]["default"] - _ANGLE_TOLERANCE
    results = [outcome.result for outcome in outcomes if outcome.result is not None]
    return [TURN_LESS] if prunes and any(result.reason_code == "already_best" for result in results) else []


def problem(error):
    """Return an error's message for the user; native errors use the panel's terms."""
    return _PROBLEMS.get(_code(error)) or str(error)


def _code(error):
    """Return a native error's code; empty for other errors."""
    return getattr(error, "code", "")


def reason(result):
    """Return why the given contour was returned; empty if it was not."""
    if not result.reason_code:
        return ""
    return _REASONS[result.reason_code] + _limited(len(result.held_back_by))


def _limited(count):
    """Return that contours nearby limited a search, to follow the reason; empty if there are none."""
    others = "1 other contour" if count == 1 else f"{count} other contours"
    return f"; {others} nearby limited the search" if count else ""


def pins_outside(count):
    """Return what to do about pins that no contour can reach; empty if there are none."""
    if not count:
        return ""
    pins = "1 pinned vertex lies" if count == 1 else f"{count} pinned vertices lie"
    return f"{pins} outside the band: widen it (wheel), or unpin (X)"


def unsearchable(error, count):
    """Return why the search failed, given how many pins lie outside the band."""
    if count:
        return pins_outside(count)
    if _code(error) == "infeasible":
        return "No contour in the band passes all pinned vertices: click one to unpin it, or widen the band (wheel)"
    return problem(error)


def inseparable(outcome):
    if outcome.closed:
        return (
            f"the loop through vertex {outcome.vertices[0]} does not separate the mesh: it runs around a handle; "
            "select a second loop around the handle too, or use Rip"
        )
    return (
        f"the open chain from vertex {outcome.vertices[0]} to {outcome.vertices[-1]} does not separate the mesh; "
        "extend it to the mesh border or to a loop, or use Rip"
    )


def hidden_part(outcome):
    return (
        f"the part beyond the contour through vertex {outcome.vertices[0]} is partly hidden and would be left behind; "
        "reveal it first (Alt H)"
    )


def uneven_scale(place):
    return (
        f"{place} has an uneven or negative scale, which is ignored; to take it into account, apply it (Ctrl A > Scale)"
    )


def not_mirrored(place):
    return f"X Mirror is on, but {place} is not symmetric here, so only the selected contours moved"


def inside_out(place):
    return (
        f"The normals of {place} point inward, so grooves count as ridges: "
        "Mesh > Normals > Recalculate Outside (Shift N)"
    )


def linked(obj):
    return (
        f"{obj.name} is linked from another file and read-only: make it local first (Object > Relations > Make Local)"
    )


def branching(vertices, from_faces=False):
    where = f"{'vertex' if len(vertices) == 1 else 'vertices'} {shortened(vertices)}"
    if from_faces:
        return f"the border of the selected faces branches at {where}; deselect the faces there"
    return f"the selection branches at {where}; select single loops, or faces in face mode"


def no_layer(kind, name):
    if not name:
        return f"no {kind} is chosen: choose one under Constraints, or set Region to None"
    return f"there is no {kind} named {name}: choose another one under Constraints, or clear the field"


def open_region():
    return "an open chain does not enclose a region: set Region to None under Constraints, or select a closed loop"


def curvature_shown(count, problems, values, colors):
    sentences = []
    if count:
        places = "1 mesh" if count == 1 else f"{count} meshes"
        sentences = [f"Curvature of {places} written to the attributes '{values}' (1 / length) and '{colors}'"]
    if problems:
        sentences.append("Not shown: " + shortened(problems, "; "))
    return ". ".join(sentences)


def directions_shown(count, problems):
    sentences = []
    if count:
        sentences = [f"Directions at {count} concave vertices"]
    elif not problems:
        sentences = ["Nothing here is notably concave: there are no directions to show"]
    if problems:
        sentences.append("Not shown: " + shortened(problems, "; "))
    return ". ".join(sentences)


def name_taken(name):
    return f"there is an attribute of another type named '{name}': rename or remove it"


def unsaved_preset(error):
    return f"The preset cannot be saved in {error.filename}: {error.strerror}"


def loose(edges, closed=True):
    noun = "a loop" if closed else "an open chain"
    names = shortened([f"{a}-{b}" for a, b in edges])
    return f"{noun} has loose edges that no face uses ({names}); select edges of faces only"


def shortened(items, separator=", "):
    """Return the first few items as text, and how many more there are."""
    texts = [str(item) for item in items[:_MAX_LISTED]]
    more = len(items) - len(texts)
    return separator.join(texts) + (f" and {more} more" if more else "")


def milliseconds(result):
    return 1000.0 * sum(result.statistics["seconds"].values())


def salience(result):
    """Return how far to trust a result, in words and as a number; empty if nothing was searched."""
    if not result.statistics["passes"]:
        return ""
    words = _SALIENCES[_rank(result)][1]
    return f"{words.capitalize()} ({result.salience:.2f})"


def ratios(result):
    """Return the ratios before and after, without the mesh's unit."""
    before, after = (readable(ratio * result.scales.h) for ratio in (result.initial_ratio, result.ratio))
    return f"Ratio {before} to {after} (per edge)"


def readable(number):
    """Return a number with three digits that count, and without an exponent."""
    return np.format_float_positional(number, precision=3, unique=False, fractional=False, trim="-")


def _rank(result):
    return next(i for i, row in enumerate(_SALIENCES) if result.salience >= row[0])


def _statuses(outcomes):
    improved = [outcome.result for outcome in outcomes if outcome.result.status == "improved"]
    others = [outcome for outcome in outcomes if outcome.result.status != "improved"]
    parts = [f"{_contour_count(len(improved))} improved: {_found(improved)}"] if improved else []
    for status in sorted({outcome.result.status for outcome in others}):
        matching = [outcome for outcome in others if outcome.result.status == status]
        count, why = len(matching) if parts else _contour_count(len(matching)), _reasons(matching)
        parts.append(f"{count} {status}" + (f": {why}" if why else ""))
    return "; ".join(parts)


def _found(results):
    """Return what kinds of boundaries were found, and how far away."""
    several = len(results) > 1
    counts = sorted(Counter(map(_rank, results)).items())
    if len(counts) == 1:
        words = _SALIENCES[counts[0][0]][2 if several else 1]
    else:
        words = ", ".join(f"{count} {_SALIENCES[rank][1 if count == 1 else 2]}" for rank, count in counts)
    return f"{words}, {_away(max(result.statistics['rings'] for result in results), several)}"


def _away(rings, several):
    if rings == 0:
        return "less than a ring away"
    return ("up to " if several else "") + ("1 ring away" if rings == 1 else f"{rings} rings away")


def _reasons(outcomes):
    """Return why contours stay, each reason once: a fault of the mesh before what the search says."""
    reasons = [
        str(outcome.fault) if outcome.fault else _REASONS.get(outcome.result.reason_code) for outcome in outcomes
    ]
    words = shortened([why for why in dict.fromkeys(reasons) if why], "; ")
    return words + _limited(len({other for outcome in outcomes for other in outcome.result.held_back_by}))


def _contour_count(count):
    return f"{count} contour" if count == 1 else f"{count} contours"


# ---- networks


def network_summary(outcomes, noun, notes=()):
    """Return one line for the status bar: how many moved, what they found, problems and notes."""
    done = [outcome for outcome in outcomes if outcome.result is not None]
    failed = [outcome for outcome in outcomes if outcome.result is None]
    moved = [outcome.result for outcome in done if outcome.result.status == "improved"]
    sentences = []
    if moved:
        sentences = [f"{len(moved)} of {len(outcomes)} {noun} moved: {_found(moved)}"]
    elif done:
        sentences = [_nothing_better(done, noun)]
    if failed:
        sentences.append(_left_unchanged(outcomes, failed))
    return ". ".join([*sentences, *dict.fromkeys(notes)])


def _nothing_better(outcomes, noun):
    """Return that nothing better was found, with the reason if it is the same for all."""
    codes = {outcome.result.reason_code for outcome in outcomes}
    why = _reasons(outcomes) if len(codes) == 1 else ""
    return f"No better position was found for the {noun}" + (f": {why}" if why else "")


NO_BORDERS = "Nothing to optimize: there are no borders between regions; choose another source, or label some faces"


def no_seams(selected_only):
    seams = "selected seams" if selected_only else "seams"
    hint = ", or clear Selected Only" if selected_only else ""
    return f"Nothing to optimize: there are no {seams} of two edges or more; mark some{hint}"


def lost_region(labels, region):
    if region < 0:
        return "a border whose move would join or split regions"
    return f"the borders of region {labels[region]}, which is so thin that it would disappear"


def no_face_sets():
    return "there are no face sets: make some in Sculpt Mode, or choose another source"


def no_attribute(name):
    if not name:
        return "no attribute is chosen: choose an integer attribute of the faces"
    return f"there is no integer face attribute '{name}': convert it, or choose another one"
