# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input to refinement, open contours, constraints and weights gives an error that names what is wrong."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

COLUMNS = 8


def tube(rows=9):
    return meshes.tube(1 + 0.1 * np.cos(np.arange(rows)), COLUMNS, rng=np.random.default_rng(3), noise=0.02)


def ring(row):
    return row * COLUMNS + np.arange(COLUMNS, dtype=np.int32)


def optimize(contour=None, closed=True, options=None, mesh=None, **constraints):
    options = mrc.Options(**{"flow": "harmonic", "width": 2, **(options or {})})
    contour = ring(4) if contour is None else contour
    return mrc.optimize(surface_of(mesh or tube()), contour, closed=closed, options=options, **constraints)


def diagonal(mesh):
    """A diagonal in the band, between rows 4 and 5."""
    real = {tuple(edge) for edge in mesh.real_edges().tolist()}
    for triangle in mesh.triangles.tolist():
        for a, b in zip(triangle, triangle[1:] + triangle[:1], strict=True):
            if {a // COLUMNS, b // COLUMNS} == {4, 5} and tuple(sorted((a, b))) not in real:
                return a, b
    raise AssertionError("no diagonal")


BAD_CONSTRAINTS = {
    "required vertex out of range": ({"required_vertices": [72]}, "72"),
    "required vertex negative": ({"required_vertices": [-1]}, "-1"),
    "required vertex outside the band": ({"required_vertices": [70]}, "70"),
    "fractional required vertices": ({"required_vertices": [33.5]}, "required_vertices"),
    "required edge outside the band": ({"required_edges": [(64, 65)]}, "6[45]"),
    "required edge out of range": ({"required_edges": [(33, 100)]}, "100"),
    "required edge with equal ends": ({"required_edges": [(33, 33)]}, "33"),
    "required edge that does not exist": ({"required_edges": [(33, 36)]}, "33.*36|36.*33"),
    "required edge that is a diagonal": (
        {"required_edges": [diagonal(tube())]},
        "{}".format("|".join(map(str, diagonal(tube())))),
    ),
    "required edge with three vertices": ({"required_edges": [(33, 34, 35)]}, "required_edges"),
    "attractor out of range": ({"attractors": [(72, 1.0, 1.0)]}, "72"),
    "attractor with negative radius": ({"attractors": [(33, -1.0, 1.0)]}, "radius"),
    "attractor with radius NaN": ({"attractors": [(33, np.nan, 1.0)]}, "radius"),
    "attractor with infinite strength": ({"attractors": [(33, 1.0, np.inf)]}, "strength"),
    "attractor with strength NaN": ({"attractors": [(33, 1.0, np.nan)]}, "strength"),
    "attractor with negative sigma": ({"attractors": [(33, 1.0, 1.0, -1.0)]}, "sigma"),
    "attractor with only two numbers": ({"attractors": [(33, 1.0)]}, "attractor"),
    "barrier that is not an edge": ({"barriers": [(33, 36)]}, "33.*36|36.*33"),
    "barrier out of range": ({"barriers": [(33, 100)]}, "100"),
}


@pytest.mark.parametrize("name", BAD_CONSTRAINTS)
def test_bad_constraints_are_named(name):
    constraints, pattern = BAD_CONSTRAINTS[name]
    with pytest.raises((ValueError, TypeError), match=pattern):
        optimize(**constraints)


OPTIONS = {
    "negative k": {"refinement": -1},
    "clamp 0": {"feature_clamp": 0.0},
    "clamp 1": {"feature_clamp": 1.0},
    "clamp above 1": {"feature_clamp": 1.5},
    "clamp NaN": {"feature_clamp": np.nan},
    "negative anchor": {"anchor": -0.1},
    "infinite anchor": {"anchor": np.inf},
    "negative crease": {"crease": -1.0},
    "negative length_bias": {"length_bias": -1.0},
    "length_bias NaN": {"length_bias": np.nan},
    "negative length_floor": {"length_floor": -1.0},
    "negative band_distance": {"band_distance": -1.0},
    "band_distance NaN": {"band_distance": np.nan},
    "negative regular_iterations": {"regular_iterations": -1},
    "unknown ends": {"ends": "corners"},
    "unknown length_measure": {"length_measure": "steps"},
    "unknown denominator": {"denominator": "edges"},
}


@pytest.mark.parametrize("name", OPTIONS)
def test_bad_option_values_are_named(name):
    option = next(iter(OPTIONS[name]))
    with pytest.raises(ValueError, match=option):
        mrc.Options(**OPTIONS[name])


@pytest.mark.parametrize("pair", [("length", "edges"), ("arcs", "arc")])
def test_length_bias_requires_one_measure_of_length(pair):
    options = {"denominator": pair[0], "length_measure": pair[1]}
    with pytest.raises(ValueError, match="length_measure|denominator"):
        optimize(options={**options, "length_bias": 0.5})
    optimize(options=options)


@pytest.mark.parametrize("name", ["refinements", "end", "attractor", "min_saliency"])
def test_unknown_options_are_refused(name):
    with pytest.raises(TypeError, match=name):
        mrc.Options(**{name: 1})


def test_open_contour_with_equal_ends_is_refused():
    with pytest.raises(ValueError, match="32"):
        optimize([32, 33, 34, 35, 36, 37, 38, 39, 32], closed=False)


def test_open_contour_needs_two_points():
    with pytest.raises(ValueError, match="."):
        optimize([32], closed=False)


@pytest.mark.parametrize("k", [10**6, 2**31 - 1])
def test_graph_that_does_not_fit_in_memory_is_refused(k):
    with pytest.raises(ValueError, match="(?i)byte|memory|GB|GiB|large|many"):
        optimize(options={"refinement": k})


def test_required_vertices_on_one_flow_level_are_infeasible():
    """The error names one of the vertices."""
    mesh = meshes.tube(np.ones(9), COLUMNS)
    with pytest.raises(mrc.Infeasible, match=r"stops at vertex \d|cannot even begin"):
        optimize(mesh=mesh, required_vertices=[33, 49, 42, 26], options={"max_turn": 0.5})
    assert issubclass(mrc.Infeasible, ValueError)


def test_required_edges_across_one_flow_level_are_infeasible():
    mesh = meshes.tube(np.ones(9), COLUMNS)
    with pytest.raises(mrc.Infeasible, match=r"stops at vertex \d|cannot even begin"):
        optimize(mesh=mesh, required_edges=[(33, 34), (41, 42)])


def test_contour_across_a_barrier_is_refused():
    """The contour runs through the midpoints of the edges between two rows."""
    mesh = meshes.tube(np.ones(9), COLUMNS, split_fraction=1.0)
    between = [t for t in mesh.triangles.tolist() if {v // COLUMNS for v in t} == {4, 5}]
    crossed = {frozenset((a, b)) for t in between for a in t for b in t if a // COLUMNS == 4 and b // COLUMNS == 5}
    ends = sorted((min(e), max(e)) for e in crossed)
    ends.sort(key=lambda e: ((e[0] % COLUMNS) + (e[1] - e[0] + 3) % COLUMNS - 3 + (e[0] % COLUMNS)) % (2 * COLUMNS))
    points = {"edge_vertices": ends, "edge_parameters": [0.5] * len(ends), "options": mrc.Options(refinement=1)}
    surface = surface_of(mesh)
    mrc.optimize(surface, **points)
    with pytest.raises(ValueError, match="barrier"):
        mrc.optimize(surface, **points, barriers=[ends[3]])


REFINED = {
    "lengths differ": ([(32, 33), (33, 34)], [0.5], "edge_parameters"),
    "parameter above 1": ([(v, v) for v in range(32, 39)] + [(39, 32)], [0] * 7 + [1.5], "1.5"),
    "parameter negative": ([(v, v) for v in range(32, 39)] + [(39, 32)], [0] * 7 + [-0.5], "-0.5"),
    "parameter NaN": ([(v, v) for v in range(32, 39)] + [(39, 32)], [0] * 7 + [np.nan], "nan|NaN|finite"),
    "no edge": ([(v, v) for v in range(32, 39)] + [(39, 50)], [0] * 7 + [0.5], "39|50"),
    "consecutive points without a common face": ([(32, 33), (36, 37), (34, 42)], [0.5, 0.5, 0.5], r"\d"),
    "repeated point": ([(v, v) for v in range(32, 40)] + [(39, 39)], [0] * 9, "39"),
}


@pytest.mark.parametrize("name", REFINED)
def test_bad_refined_contours_are_refused(name):
    ends, parameters, pattern = REFINED[name]
    with pytest.raises(ValueError, match=pattern):
        mrc.optimize(surface_of(tube()), edge_vertices=ends, edge_parameters=parameters)


def test_vertices_and_points_are_mutually_exclusive():
    with pytest.raises(ValueError, match="edge_vertices"):
        mrc.optimize(surface_of(tube()), ring(4), edge_vertices=[(32, 32)], edge_parameters=[0.0])
    with pytest.raises(ValueError, match="vertices"):
        mrc.optimize(surface_of(tube()))


def test_whole_surface_band_reaches_the_border_on_the_other_side():
    """A disk with a hole: on one side of the contour is the border, on the other the band reaches the outer border."""
    rng = np.random.default_rng(2)
    mesh = meshes.jittered_annulus(rng, 6, 9)
    for k in (0, 1):
        result = optimize(9 + np.arange(9), mesh=mesh, options={"width": None, "refinement": k})
        assert np.isfinite(result.objective)
        assert result.objective <= result.initial_objective
