# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public name is documented: those of the module, with units, types and defaults, and those of the add-on's
api."""

import ast
import inspect
import re
from pathlib import Path

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

API = Path(__file__).resolve().parents[2] / "addon" / "api.py"
FUNCTIONS = [name for name in vars(mrc) if inspect.isroutine(getattr(mrc, name))]
CLASSES = [name for name in vars(mrc) if inspect.isclass(getattr(mrc, name))]


def words(item):
    """A docstring without the signature line that pybind11 adds."""
    lines = (item.__doc__ or "").splitlines()
    return "\n".join(line for line in lines if not re.match(r"\w*\(.*\) -> ", line)).strip()


def arguments(name):
    signature = getattr(mrc, name).__doc__.splitlines()[0]
    return set(re.findall(r"[(,] ?(\w+):", signature))


def test_public_names_are_found():
    assert {"optimize", "band"} <= set(FUNCTIONS)
    assert {"Surface", "Options", "Result", "Infeasible"} <= set(CLASSES)
    assert "required_edges" in arguments("optimize")


@pytest.mark.parametrize("name", FUNCTIONS + CLASSES)
def test_every_name_of_the_module_is_explained(name):
    assert len(words(getattr(mrc, name)).split()) > 3


@pytest.mark.parametrize("name", CLASSES)
def test_every_attribute_is_explained(name):
    attributes = {key: value for key, value in vars(getattr(mrc, name)).items() if not key.startswith("_")}
    assert not [key for key, value in attributes.items() if not words(value)]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_argument_is_explained_or_refers_to_an_explanation(name):
    said = words(getattr(mrc, name))
    if name != "optimize" and "those of optimize" in said:
        said += words(mrc.optimize)
    assert not [argument for argument in arguments(name) if not re.search(rf"\b{argument}\b", said)]


def test_options_document_their_defaults():
    defaults = mrc.Options()
    for key, value in vars(mrc.Options).items():
        if isinstance(value, property):
            assert words(value).endswith(f"Default: {getattr(defaults, key)!r}.")
            assert f"{key} = {getattr(defaults, key)!r}: " in mrc.Options.__doc__


def test_arrays_document_their_types():
    surface = mrc.Surface(np.eye(3), None, np.array([[0, 1, 2]]))
    curvature = mrc.curvature(surface)
    for key in ("kappa_min", "kappa_max", "direction_min", "direction_max"):
        array, said = getattr(curvature, key), words(getattr(mrc.Curvature, key))
        assert str(array.dtype) in said
        assert ("(V, 3)" if array.ndim == 2 else "(V,)") in said


@pytest.mark.parametrize("closed", [True, False])
def test_results_have_their_documented_shapes_and_types(closed):
    tube, ring = meshes.tube(1 + 0.1 * np.cos(np.arange(9)), 8), 8 * 4 + np.arange(8)
    result = mrc.optimize(surface_of(tube), ring, closed)
    for key in ("vertices", "edge_vertices", "edge_parameters", "positions", "segment_faces"):
        array, said = getattr(result, key), words(getattr(mrc.Result, key))
        shape, dtype = re.match(r"(\(.*?\)) (\w+)", said).groups()
        if not closed:
            shape = (re.search(r"of an open contour (\(.*?\)):", said) or [None, shape])[1]
        assert str(array.shape) == shape.replace("N - 1", str(len(ring) - 1)).replace("N", str(len(ring)))
        assert str(array.dtype) == dtype


def test_signatures_fit_on_a_screen():
    assert max(len(getattr(mrc, name).__doc__.splitlines()[0]) for name in FUNCTIONS) < 600


@pytest.mark.parametrize("name", ["optimize", "optimize_all", "measure", "search_space"])
def test_every_error_is_named_or_refers_to_an_explanation(name):
    said = words(getattr(mrc, name)) + words(mrc.optimize)
    assert {"ValueError", "Infeasible", "TooLarge", "TypeError"} <= set(re.findall(r"\w+", said))


def test_every_function_of_the_api_is_explained():
    functions = [node for node in ast.parse(API.read_text()).body if isinstance(node, ast.FunctionDef)]
    public = {node.name: ast.get_docstring(node) for node in functions if not node.name.startswith("_")}
    assert {"optimize_contour", "optimize_seams", "optimize_segmentation"} <= public.keys()
    assert all(public.values())
