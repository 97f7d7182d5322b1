# SPDX-License-Identifier: GPL-3.0-or-later
"""The colors of curvatures, without Blender."""

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
colors = importlib.import_module("addon.core.curvature_colors").colors


def test_valleys_are_blue_ridges_red_and_flat_places_nearly_white():
    valley, flat, ridge = colors([-2.0, 0.0, 2.0], 1.0)
    assert valley[2] > 5 * valley[0]
    assert ridge[0] > 5 * ridge[2]
    assert flat[:3].min() == flat[:3].max() > 0.9


def test_a_more_concave_color_is_never_redder_or_brighter():
    shades = colors(np.linspace(-3, 0, 50), 1.0)
    assert (np.diff(shades[:, 0]) > 0).all()
    assert (np.diff(shades[:, :3].sum(axis=1)) > 0).all()


@pytest.mark.parametrize("quantile", [0.5, 0.9])
def test_one_spike_does_not_fade_the_other_colors(quantile, rng):
    values = rng.normal(size=500)
    plain = colors(values, quantile)
    spiked = colors(np.append(values, -1e6), quantile)
    assert np.abs(spiked[:-1] - plain).max() < 0.05
    assert np.array_equal(spiked[-1], colors([-1.0], 1.0)[0])


def test_colors_do_not_depend_on_size(rng):
    values = rng.normal(size=100)
    np.testing.assert_allclose(colors(values, 0.9), colors(1000 * values, 0.9))


def test_nothing_curved_and_no_numbers():
    flat = colors([0.0, 0.0], 0.9)
    assert np.array_equal(colors([0.0, np.nan], 0.9), flat)
    assert colors([], 0.9).shape == (0, 4)
