# SPDX-License-Identifier: GPL-3.0-or-later
"""What the module makes can be pickled and copied, and nothing is lost on the way."""

import copy
import math
import pickle

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

TUBE = meshes.tube(1 + 0.1 * np.cos(np.arange(9)), 8)
RING = 8 * 4 + np.arange(8)
WAYS = {
    "pickle": lambda value: pickle.loads(pickle.dumps(value)),
    "old pickle": lambda value: pickle.loads(pickle.dumps(value, protocol=2)),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
}


def result(**options):
    return mrc.optimize(surface_of(TUBE), RING, options=mrc.Options(**options))


def values():
    surface = surface_of(TUBE)
    refined = result(refinement=2, iterations=2)
    return {
        "Options": mrc.Options(width=None, flow="gates", feature_clamp=0.1 + 0.2, max_turn=1.1),
        "recommended": mrc.Options.recommended(),
        "Scales": refined.scales,
        "clamped Scales": result(feature_clamp=0.9).scales,
        "Contour": refined.contour,
        "open Contour": mrc.Contour([3, 4], closed=False),
        "Result": refined,
        "unchanged": mrc.optimize(surface, RING, options=mrc.Options(min_salience=50.0)),
        "cancelled": mrc.optimize(surface, RING, progress=lambda share: False),
        "held back": mrc.optimize_all(surface, [RING, RING + 8])[0],
        "Measure": mrc.measure(surface, RING),
        "Curvature": mrc.curvature(surface),
    }


def content(value):
    """All attributes, in words that show every bit."""
    if type(value).__module__ == "mrcontour":
        names = [name for name in dir(value) if not name.startswith("_") and name != "recommended"]
        assert names
        return {name: content(getattr(value, name)) for name in names}
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    return repr(value)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", values())
def test_a_round_trip_keeps_every_bit(kind, way):
    value = values()[kind]
    other = WAYS[way](value)
    assert type(other) is type(value)
    assert content(other) == content(value)
    if type(value).__eq__ is not object.__eq__:
        assert other == value
        assert hash(other) == hash(value)


@pytest.mark.parametrize("name", ["Options", "Scales", "Contour", "Result", "Measure", "Curvature", "Surface"])
def test_every_class_is_asked(name):
    kinds = {type(value).__name__ for value in values().values()} | {"Surface"}
    assert name in kinds
    assert {
        key for key, value in vars(mrc).items() if isinstance(value, type) and not issubclass(value, Exception)
    } == kinds


SURFACES = {
    "quads": lambda: surface_of(TUBE),
    "triangles": lambda: surface_of(meshes.icosphere(2)),
    "hidden": lambda: surface_of(TUBE, hidden_faces=[0, 7, 20]),
    "polygons": lambda: mrc.Surface(
        [[0, 0, 0], [2, 0, 0], [2, 2, 0], [1, 0.5, 0], [0, 2, 0], [9, 9, 9]], [0, 5], [0, 1, 2, 3, 4]
    ),
    "own triangles": lambda: mrc.Surface(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [0, 4], [0, 1, 2, 3], [[1, 2, 3], [1, 3, 0]]
    ),
    "nothing": lambda: mrc.Surface(np.zeros((0, 3)), None, np.zeros((0, 3), int)),
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", SURFACES)
def test_a_surface_stays_the_same_surface(kind, way):
    surface = SURFACES[kind]()
    other = WAYS[way](surface)
    assert pickle.dumps(other) == pickle.dumps(surface)
    assert repr(other) == repr(surface)
    assert other.edge_count == surface.edge_count
    assert content(mrc.curvature(other)) == content(mrc.curvature(surface))


@pytest.mark.parametrize("way", WAYS)
def test_a_search_finds_the_same_on_a_copy(realistic, way):
    _, mesh, loop = realistic
    surface = surface_of(mesh)
    options = mrc.Options.recommended(refinement=1, band_distance=0.3)
    before, after = (mrc.optimize(s, loop, options=options) for s in (surface, WAYS[way](surface)))
    timed = {"statistics"}
    assert {k: v for k, v in content(before).items() if k not in timed} == {
        k: v for k, v in content(after).items() if k not in timed
    }


def test_a_deep_copy_of_arrays_is_their_own():
    curvature = mrc.curvature(surface_of(TUBE))
    other = copy.deepcopy(curvature)
    other.kappa_min[:] = 7.0
    assert not (curvature.kappa_min == 7.0).any()


def test_options_are_values_that_say_how_they_are_made():
    options = mrc.Options(width=None, length_bias=0.1, flow="arc_length")
    assert eval(repr(options), {"Options": mrc.Options}) == options
    assert options == mrc.Options(flow="arc_length", length_bias=0.1, width=None)
    assert options != mrc.Options()
    assert options != "Options()"
    assert len({options, copy.copy(options), mrc.Options(), mrc.Options(width=4)}) == 2


def test_recommended_options_take_changes():
    assert mrc.Options.recommended(width=3).width == 3
    assert mrc.Options.recommended(width=3) != mrc.Options.recommended()
    assert mrc.Options.recommended(width=8) == mrc.Options.recommended()
    assert mrc.Options.recommended().max_turn == math.radians(100)
    with pytest.raises(ValueError, match="width"):
        mrc.Options.recommended(width=0)
