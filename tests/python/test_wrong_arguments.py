# SPDX-License-Identifier: GPL-3.0-or-later
"""A wrong call is answered with a sentence that names the argument, never with a C++ signature."""

import inspect
import re

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

TUBE = meshes.tube(1 + 0.1 * np.cos(np.arange(9)), 8)
SURFACE = surface_of(TUBE)
RING = 8 * 4 + np.arange(8)
TRIANGLES = np.array([[0, 1, 2]])
FUNCTIONS = [name for name in vars(mrc) if inspect.isroutine(getattr(mrc, name))]
CLASSES = [name for name, value in vars(mrc).items() if inspect.isclass(value) and not issubclass(value, Exception)]
CONSTRUCTORS = [name for name in CLASSES if " -> None" in vars(getattr(mrc, name))["__init__"].__doc__]
CALLS = FUNCTIONS + CONSTRUCTORS + ["Options.recommended"]
FOREIGN = re.compile(r"->|::|\barg\d|incompatible|pybind|std|\n")


class Odd:
    """Nothing that any argument could be."""


def called(name):
    target = mrc
    for part in name.split("."):
        target = getattr(target, part)
    return target


def names_of(name):
    """The arguments of a function or constructor, from its signature."""
    target = called(name)
    text = vars(target)["__init__"].__doc__ if inspect.isclass(target) else target.__doc__
    signature = next(line for line in text.splitlines() if re.search(r"\) -> ", line))
    return [argument for argument in re.findall(r"[(,] ?(\w+):", signature) if argument != "self"]


def answer(name, *positional, **named):
    with pytest.raises((TypeError, ValueError)) as caught:
        called(name)(*positional, **named)
    return str(caught.value)


def right(name):
    """Arguments that each function takes."""
    first = {"surface": SURFACE} if "surface" in names_of(name) else {}
    if name == "Surface":
        return {"positions": np.eye(3), "face_offsets": None, "face_vertices": TRIANGLES}
    if name == "optimize_all":
        return first | {"contours": [RING]}
    if name == "close_contour":
        return first | {"vertices": RING[:5]}
    return first | ({"vertices": RING} if "vertices" in names_of(name) else {})


def test_all_calls_are_asked():
    assert {"optimize", "optimize_all", "measure", "close_contour", "curvature", "band", "search_space"} <= set(CALLS)
    assert {"Surface", "Options", "Contour"} <= set(CALLS)


@pytest.mark.parametrize("name", CALLS)
def test_right_calls_pass(name):
    called(name)(**right(name))


@pytest.mark.parametrize("name", CALLS)
def test_every_wrong_call_is_answered_with_a_sentence(name):
    answers = [
        answer(name, **right(name), nonsense=1),
        answer(name, *[Odd()] * 40),
        answer(name, Odd()),
        answer(name, Odd(), nonsense=Odd()),
    ]
    answers += [
        answer(name, **right(name) | {argument: Odd()}) for argument in names_of(name) if argument != "progress"
    ]
    for message in answers:
        assert not FOREIGN.search(message), message
        assert "object at 0x" not in message or "option" in message or "it must be" in message
        assert len(message) > 20


@pytest.mark.parametrize("name", sorted(set(CLASSES) - set(CONSTRUCTORS)))
def test_what_only_the_module_makes_says_so(name):
    assert answer(name) == answer(name, 1, nonsense=2) == f"mrcontour.{name}: No constructor defined!"


@pytest.mark.parametrize("name", CALLS)
def test_an_unknown_argument_is_named(name):
    assert "'nonsense'" in answer(name, **right(name), nonsense=1)


@pytest.mark.parametrize("name", [name for name in CALLS if not name.startswith("Options")])
def test_a_missing_a_doubled_and_a_superfluous_argument_are_named(name):
    names, given = names_of(name), right(name)
    if name != "Contour":
        assert names[0] in answer(name)
        assert f"{names[0]} twice" in answer(name, given[names[0]], **given)
    assert f"at most {len(names)} arguments, not 40" in answer(name, *[None] * 40)


@pytest.mark.parametrize("name", [name for name in CALLS if "surface" in names_of(name)])
def test_a_wrong_surface_is_named_with_its_type(name):
    assert answer(name, **right(name) | {"surface": [1, 2]}) == "surface must be a mrcontour.Surface, not list"


@pytest.mark.parametrize("name", [name for name in CALLS if "options" in names_of(name)])
def test_an_option_among_the_arguments_is_shown_its_place(name):
    message = answer(name, **right(name), width=4)
    assert message == f"{name} takes no argument 'width'; it is an option: options=Options(width=...)"


SAID = [
    (
        lambda: mrc.Surface(np.eye(3), TRIANGLES),
        r"needs the argument face_vertices: Surface\(positions, None, triangles\)",
    ),
    (lambda: mrc.optimize(SURFACE, RING, "yes"), "closed must be True or False, not str"),
    (lambda: mrc.optimize(SURFACE, RING, options=None), "options must be a mrcontour.Options, not None"),
    (lambda: mrc.optimize(SURFACE, RING, options={"width": 3}), "options must be a mrcontour.Options, not dict"),
    (
        lambda: mrc.optimize(SURFACE, RING, scales=1.0),
        "scales must be the mrcontour.Scales of an earlier result, or None",
    ),
    (lambda: mrc.optimize(SURFACE, RING, attractors=3), "attractors must be a sequence, not int"),
    (lambda: mrc.optimize(SURFACE, RING, progress=3), "progress must be a function or None, not int"),
    (lambda: mrc.optimize_all(SURFACE, 3), "contours must be a sequence, not int"),
    (lambda: mrc.Options(3), r"options are given by name, as in Options\(width=4\)"),
    (lambda: mrc.Options(flow=3), "option flow cannot be 3"),
    (lambda: mrc.Contour([1.5]), "vertices must be whole numbers"),
]


@pytest.mark.parametrize(("call", "message"), SAID)
def test_the_sentence_says_what_is_wanted(call, message):
    with pytest.raises(TypeError, match=message):
        call()


def test_points_on_edges_need_their_parameters():
    with pytest.raises(ValueError, match="edge_vertices need edge_parameters"):
        mrc.Contour(edge_vertices=[[0, 1], [1, 2]])


def test_errors_of_the_callers_own_pass_unchanged():
    def report(share):
        raise TypeError("report(): incompatible")

    with pytest.raises(TypeError, match=r"^report\(\): incompatible$"):
        mrc.optimize(SURFACE, RING, progress=report)


def test_a_refusal_within_the_callers_own_function_passes_unchanged():
    def report(share):
        mrc.Contour.vertices.fget(share)

    with pytest.raises(TypeError, match="incompatible function arguments"):
        mrc.optimize(SURFACE, RING, progress=report)
