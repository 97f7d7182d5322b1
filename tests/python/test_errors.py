# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors say what is wrong and where, and one bad contour does not cost the others their results."""

import copy
import pickle

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

COLUMNS = 12


def waisted(count=3):
    rows = np.arange(12 * count + 1)
    return surface_of(meshes.tube(1 - 0.3 * np.cos(2 * np.pi * rows / 12), COLUMNS))


def ring(row):
    return COLUMNS * row + np.arange(COLUMNS)


RINGS = [ring(8), ring(20), ring(32)]
CROSSING = [[ring(8)[0] - COLUMNS, ring(8)[0]], [ring(8)[0], ring(8)[0] + COLUMNS]]


def refused(**arguments):
    """What optimize raises."""
    arguments = {"vertices": RINGS[0], **arguments}
    with pytest.raises(mrc.InvalidInput) as caught:
        mrc.optimize(waisted(), **arguments)
    return caught.value


def fields(result):
    return [
        result.vertices.tobytes(),
        result.status,
        result.reason,
        result.ratio,
        result.objective,
        result.salience,
        result.lower_bound,
        list(result.history),
        list(result.held_back_by),
    ]


FAULTS = {
    "not_simple": ({"vertices": [*ring(8), 99]}, ("vertex", 99)),
    "no_edge": ({"vertices": [96, 97, 120]}, ("edge", (97, 120))),
    "out_of_range": ({"vertices": [96, 97, -4]}, ("vertex", -4)),
    "too_short": ({"vertices": [96]}, ("vertex", 96)),
    "on_border": ({"vertices": ring(0)}, ("edge", (0, 1))),
    "crosses_barrier": ({"barriers": CROSSING}, ("vertex", 96)),
    "invalid_attractor": ({"attractors": [(7, -1, 1)]}, ("vertex", 7)),
    "outside_band": ({"required_vertices": [300]}, ("vertex", 300)),
    "invalid_parameter": (
        {"vertices": None, "edge_vertices": [(96, 97), (97, 98), (98, 99)], "edge_parameters": [0.5, 2.0, 0.5]},
        ("edge", (97, 98)),
    ),
    "infeasible": ({"required_vertices": [100, 110], "options": mrc.Options(iterations=0)}, None),
    "wrong_size": ({"region_density": np.ones(5)}, None),
    "too_large": ({"options": mrc.Options(refinement=10**6)}, None),
}
FAULTS["infeasible"][0]["required_vertices"] = [ring(9)[0]]


@pytest.mark.parametrize("code", FAULTS)
def test_an_error_has_a_code_and_names_its_elements(code):
    arguments, element = FAULTS[code]
    error = refused(**arguments)
    assert error.code == code
    assert error.contour is None
    assert element is None or element in error.elements
    for kind, place in error.elements:
        assert kind in ("vertex", "edge", "face")
        assert isinstance(place, tuple if kind == "edge" else int)
    expected = {"too_large": mrc.TooLarge, "infeasible": mrc.Infeasible}.get(code, mrc.InvalidInput)
    assert type(error) is expected
    assert isinstance(error, ValueError)


@pytest.mark.parametrize("code", FAULTS)
@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda error: pickle.loads(pickle.dumps(error))])
def test_errors_are_copied_and_pickled_whole(code, copied):
    error = refused(**FAULTS[code][0])
    again = copied(error)
    assert type(again) is type(error)
    assert str(again) == str(error)
    assert (again.code, again.elements, again.contour) == (error.code, error.elements, error.contour)


def test_an_error_made_by_hand_has_no_code():
    error = mrc.Infeasible("none")
    assert (str(error), error.code, error.elements, error.contour) == ("none", "", (), None)


def test_attributes_cannot_be_set():
    with pytest.raises(AttributeError):
        refused(**FAULTS["no_edge"][0]).code = "other"


def test_surfaces_and_options_raise_them_too():
    with pytest.raises(mrc.InvalidInput) as caught:
        mrc.Surface(np.eye(3), None, [[0, 1, 5]])
    assert (caught.value.code, caught.value.elements) == ("out_of_range", (("face", 0),))
    with pytest.raises(mrc.InvalidInput) as caught:
        mrc.optimize(waisted(), ring(8), options=mrc.Options(width=0))
    assert caught.value.code == "invalid_option"


@pytest.mark.parametrize("code", FAULTS)
def test_check_contour_refuses_what_optimize_refuses_of_the_contour(code):
    arguments = FAULTS[code][0]
    own = {key: value for key, value in arguments.items() if key in ("vertices", "barriers") or key.startswith("edge_")}
    error = mrc.check_contour(waisted(), **{"vertices": RINGS[0], **own})
    if not own:
        assert error is None
        return
    raised = refused(**own)
    assert (str(error), error.code, error.elements) == (str(raised), raised.code, raised.elements)


def test_check_contour_takes_open_contours():
    assert mrc.check_contour(waisted(), ring(8)[:5], closed=False) is None
    assert mrc.check_contour(waisted(), ring(8)[:5]).code == "no_edge"


def test_without_errors_both_ways_give_the_same_bytes():
    for options in (mrc.Options(width=8), mrc.Options(width=3, refinement=1, iterations=2)):
        raising = mrc.optimize_all(waisted(), RINGS, options=options)
        returning = mrc.optimize_all(waisted(), RINGS, options=options, errors="return")
        assert [fields(r) for r in raising] == [fields(r) for r in returning]


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_a_refused_contour_is_a_barrier_to_the_others(threads):
    options, bad = mrc.Options(width=8, threads=threads), [*ring(10), 120]
    *results, error = mrc.optimize_all(waisted(), [*RINGS, bad], options=options, errors="return")
    assert (type(error), error.contour, error.code) == (mrc.InvalidInput, 3, "not_simple")
    barriers = np.column_stack([ring(10), np.roll(ring(10), -1)])
    walled = mrc.optimize_all(waisted(), RINGS, options=options, barriers=barriers)
    assert [fields(r) for r in results] == [fields(r) for r in walled]
    free = mrc.optimize_all(waisted(), RINGS, options=options)
    assert fields(results[0]) != fields(free[0])


def test_a_failed_contour_keeps_its_place_and_the_others_keep_clear():
    required = [[], [300], []]
    options = mrc.Options(width=8)
    outcomes = mrc.optimize_all(
        waisted(), [ring(14), ring(16), ring(20)], required_vertices=required, options=options, errors="return"
    )
    assert (outcomes[1].code, outcomes[1].contour) == ("outside_band", 1)
    for outcome in (outcomes[0], outcomes[2]):
        assert not set(outcome.vertices) & set(ring(16))


def test_a_raised_error_has_its_contours_place():
    bad = [96, 97, 120]
    with pytest.raises(mrc.InvalidInput, match=r"^contour 1: ") as caught:
        mrc.optimize_all(waisted(), [RINGS[1], bad, bad])
    assert caught.value.contour == 1
    returned = mrc.optimize_all(waisted(), [RINGS[1], bad, bad], errors="return")
    assert [r.contour for r in returned[1:]] == [1, 2]
    assert str(caught.value) == f"contour 1: {returned[1]}"


def test_an_error_of_all_is_given_to_each_and_one_of_the_options_is_raised():
    outcomes = mrc.optimize_all(waisted(), RINGS, attractors=[(3, -1, 1)], errors="return")
    assert [(e.code, e.contour) for e in outcomes] == [("invalid_attractor", i) for i in range(3)]
    with pytest.raises(mrc.InvalidInput):
        mrc.optimize_all(waisted(), RINGS, options=mrc.Options(width=0), errors="return")


UNUSABLE = {
    "a matrix": (np.zeros((3, 2), int), "wrong_size"),
    "beyond int32": ([96, 97, 2**40], "out_of_range"),
    "points of three": (([(96, 97, 98)], [0.5]), "wrong_size"),
    "too few parameters": (([(96, 97), (97, 98)], [0.5]), "wrong_size"),
    "nothing": (None, "wrong_size"),
}


@pytest.mark.parametrize("name", UNUSABLE)
def test_a_contour_of_unusable_arrays_is_an_error_of_that_contour(name):
    bad, code = UNUSABLE[name]
    contours, options = [RINGS[0], bad, RINGS[2]], mrc.Options(width=8)
    first, error, last = mrc.optimize_all(waisted(), contours, options=options, errors="return")
    assert (type(error), error.code, error.contour) == (mrc.InvalidInput, code, 1)
    alone = mrc.optimize_all(waisted(), [RINGS[0], RINGS[2]], options=options)
    assert [r.vertices.tolist() for r in (first, last)] == [r.vertices.tolist() for r in alone]
    with pytest.raises(mrc.InvalidInput) as caught:
        mrc.optimize_all(waisted(), contours)
    assert (str(caught.value), caught.value.code, caught.value.contour) == (f"contour 1: {error}", code, 1)


def test_required_elements_of_unusable_arrays_are_an_error_of_their_contour():
    required = [[], [2**40], []]
    outcomes = mrc.optimize_all(waisted(), RINGS, required_vertices=required, errors="return")
    assert [getattr(outcome, "code", None) for outcome in outcomes] == [None, "out_of_range", None]
    assert outcomes[1].contour == 1


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ({"vertices": RINGS[0][None]}, "wrong_size"),
        ({"vertices": [0, 1, 2**40]}, "out_of_range"),
        ({"vertices": None}, "wrong_size"),
        ({"vertices": None, "edge_vertices": [(0, 1)]}, "wrong_size"),
        ({"barriers": [0, 1]}, "wrong_size"),
        ({"required_edges": [(0, 1, 2)]}, "wrong_size"),
        ({"attractors": [(1, 2)]}, "invalid_attractor"),
        ({"attractors": [(1.5, 2, 3)]}, "invalid_attractor"),
        ({"region_density": np.ones((2, 2))}, "wrong_size"),
    ],
)
def test_unusable_arrays_have_a_code(arguments, code):
    assert refused(**arguments).code == code


@pytest.mark.parametrize(
    "arguments",
    [
        {"positions": np.eye(2)},
        {"face_vertices": [0, 1, 2]},
        {"face_offsets": [], "face_vertices": [0, 1, 2]},
        {"hidden_faces": [True, False]},
    ],
)
def test_unusable_arrays_of_a_surface_have_a_code(arguments):
    with pytest.raises(mrc.InvalidInput) as caught:
        mrc.Surface(**{"positions": np.eye(3), "face_offsets": None, "face_vertices": [[0, 1, 2]], **arguments})
    assert caught.value.code == "wrong_size"


@pytest.mark.parametrize("errors", ["ignore", None, 3])
def test_errors_is_raise_or_return(errors):
    with pytest.raises(ValueError, match="'raise' or 'return'"):
        mrc.optimize_all(waisted(), RINGS, errors=errors)
