# SPDX-License-Identifier: GPL-3.0-or-later
"""Any input that Python can pass gives a result or an exception that says what is wrong, never a crash, NaN or another
exception. Every run tries the same input."""

import os

import meshes
import mrcontour as mrc
import numpy as np
from contour_energy import vertex
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from result_checks import Task, check_finite, check_numbers, check_result

REFUSALS = (TypeError, ValueError, OverflowError)
LARGE = 2**31 - 1
FULL = bool(os.environ.get("MRC_LONG"))


def examples(count):
    """This many examples in the usual run, twenty times as many in a full run."""
    return settings(derandomize=True, max_examples=count * (20 if FULL else 1), deadline=None, database=None)


def tube():
    return meshes.tube(1 + 0.1 * np.cos(np.arange(7)), 6, rng=np.random.default_rng(3), noise=0.02)


MESH = tube()
SURFACE = mrc.Surface(*MESH.arguments())
RING = np.arange(18, 24, dtype=np.int32)
POINTS = np.column_stack([RING, RING])


def allowed(call):
    """The result of a call, or None if it refuses its input with a message."""
    try:
        return call()
    except REFUSALS as error:
        message = str(error)
    assert len(message) >= 10
    return None


def check_found(result, options):
    if result is not None and result.closed:
        ring = [vertex(v) for v in RING]
        given_ring = result.scales.given.tolist() == RING.tolist()
        if given_ring and options.refinement < 10:
            check_result(Task(SURFACE, MESH.triangles, ring, True, options, faces=MESH.faces), result)
        else:
            check_numbers(result)


# ---- strategies for input

scalars = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 50),
    st.integers(-(2**70), 2**70),
    st.sampled_from([LARGE, LARGE + 1, -LARGE - 1, 2**63, 2**64]),
    st.floats(),
    st.text(max_size=3),
    st.complex_numbers(),
    st.just(np.float32(2)),
    st.just(object()),
)
dtypes = st.one_of(
    arrays.scalar_dtypes(),
    st.sampled_from([np.dtype(object), np.dtype(np.longdouble), np.dtype("<i4"), np.dtype(">i4"), np.dtype(">f8")]),
)
shapes = st.one_of(
    arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=5),
    st.sampled_from([(0, 3), (4, 3), (6,), (6, 2), (1, 1, 3)]),
)


def elements(dtype):
    return scalars if dtype.kind == "O" else arrays.from_dtype(dtype)


@st.composite
def any_arrays(draw):
    """Arrays of any type, shape and memory layout."""
    dtype = draw(dtypes)
    array = draw(arrays.arrays(dtype, draw(shapes), elements=elements(dtype)))
    return laid_out(array, draw(st.sampled_from([*LAYOUTS])))


def read_only(array):
    array.flags.writeable = False
    return array


def spaced(array):
    """The same array as a strided view of a larger one."""
    wide = np.repeat(array, 3, axis=-1) if array.ndim else array
    return wide[..., 1::3] if array.ndim else wide


LAYOUTS = {
    "rows": np.ascontiguousarray,
    "columns": np.asfortranarray,
    "backwards": lambda array: array[::-1].copy()[::-1] if array.ndim else array,
    "spaced": spaced,
    "read only": lambda array: read_only(array.copy()),
    "unaligned": lambda array: unaligned(array),
    "other byte order": lambda array: array.astype(array.dtype.newbyteorder()),
    "list": lambda array: array.tolist(),
}


def unaligned(array):
    if array.dtype.kind == "O" or not array.size:
        return array
    shifted = np.zeros(array.nbytes + 1, dtype=np.uint8)
    place = shifted[1:].view(array.dtype).reshape(array.shape)
    place[...] = array
    return place


def laid_out(array, layout):
    return LAYOUTS[layout](array)


anything = st.one_of(
    any_arrays(),
    scalars,
    st.recursive(scalars, lambda inner: st.lists(inner, max_size=4) | st.tuples(inner, inner), max_leaves=8),
    st.dictionaries(st.integers(0, 5), st.integers(0, 5), max_size=2),
)
indices = st.one_of(anything, st.lists(st.integers(-1, 45), max_size=8), st.permutations(range(18, 24)))
edges = st.one_of(anything, st.lists(st.tuples(st.integers(-1, 45), st.integers(-1, 45)), max_size=4))


# ---- surfaces


@examples(400)
@given(
    name=st.sampled_from(["positions", "face_offsets", "face_vertices", "triangles", "hidden_faces"]), value=anything
)
def test_arbitrary_surface_arrays(name, value):
    names = ("positions", "face_offsets", "face_vertices", "triangles")
    parts = {**dict(zip(names, MESH.arguments(), strict=True)), name: value}
    surface = allowed(lambda: mrc.Surface(**parts))
    if surface is not None:
        found = allowed(lambda: mrc.optimize(surface, RING))
        if found is not None:
            check_numbers(found)


@examples(100)
@given(layouts=st.lists(st.sampled_from([*LAYOUTS]), min_size=5, max_size=5), wide=st.booleans())
def test_memory_layout_of_arrays_does_not_matter(layouts, wide):
    kinds = (np.float64, *([np.int64 if wide else np.int32] * 4))
    parts = [part.astype(kind) for part, kind in zip((*MESH.arguments(), RING), kinds, strict=True)]
    *parts, ring = [laid_out(part, layout) for part, layout in zip(parts, layouts, strict=True)]
    found, expected = mrc.optimize(mrc.Surface(*parts), ring), mrc.optimize(SURFACE, RING)
    assert found.vertices.tobytes() == expected.vertices.tobytes()
    assert (found.ratio, found.history) == (expected.ratio, expected.history)


@examples(100)
@given(
    positions=arrays.arrays(np.float64, (8, 3), elements=st.floats(allow_nan=False, allow_infinity=False)),
    faces=st.lists(st.lists(st.integers(0, 7), min_size=3, max_size=4, unique=True), min_size=1, max_size=9),
)
def test_any_positions(positions, faces):
    """However large, small or flat."""
    offsets = np.cumsum([0] + [len(face) for face in faces])
    surface = allowed(lambda: mrc.Surface(positions, offsets, np.concatenate(faces)))
    if surface is not None:
        found = allowed(lambda: mrc.optimize(surface, faces[0], options=mrc.Options(refinement=1)))
        curvature = allowed(lambda: mrc.curvature(surface, mrc.Options()))
        assert found is None or check_numbers(found) is None
        assert curvature is None or np.isfinite(curvature.direction_min).all()


# ---- contours


@examples(400)
@given(value=indices, closed=st.booleans(), at=st.integers(0, 4))
def test_arbitrary_contours(value, closed, at):
    function = (mrc.optimize, mrc.measure, mrc.band, mrc.search_space)[at % 4]
    if at == 4:
        allowed(lambda: mrc.close_contour(SURFACE, value))
    else:
        allowed(lambda: function(SURFACE, value, closed, options=mrc.Options(width=2)))


@examples(300)
@given(
    ends=st.one_of(st.just(POINTS), edges), parameters=st.one_of(st.just(np.zeros(6)), anything), k=st.integers(0, 2)
)
def test_arbitrary_points_on_edges(ends, parameters, k):
    options = mrc.Options(width=2, refinement=k)
    contour = {"edge_vertices": ends, "edge_parameters": parameters}
    result = allowed(lambda: mrc.optimize(SURFACE, **contour, options=options))
    check_found(result, options)
    allowed(lambda: mrc.measure(SURFACE, **contour, options=options))


# ---- options

NAMES = sorted(name for name, value in vars(mrc.Options).items() if isinstance(value, property))
CHOICES = ["gates", "arc_length", "valley", "ridge", "left", "right", "arc", "arcs"]
CHOICES += ["edges", "vertices", "border", "edges_or_border"]
values = st.one_of(anything, st.floats(0, 3), st.floats(0), st.integers(0, 4), st.sampled_from(CHOICES))


@examples(500)
@given(chosen=st.dictionaries(st.sampled_from(NAMES), values, min_size=1, max_size=3))
def test_arbitrary_option_values(chosen):
    options = allowed(lambda: mrc.Options(**chosen))
    if options is not None and (options.refinement < 4 or options.refinement > 10_000):
        result = allowed(lambda: mrc.optimize(SURFACE, RING, options=options))
        check_found(result, options)


@examples(100)
@given(name=st.text(max_size=12), value=scalars)
def test_arbitrary_option_names(name, value):
    allowed(lambda: mrc.Options(**{name: value}))


# ---- constraints, and several contours

constraint_values = {
    "required_vertices": indices,
    "required_edges": edges,
    "barriers": edges,
    "attractors": st.one_of(anything, st.lists(st.tuples(st.integers(-1, 45), st.floats(), st.floats()), max_size=3)),
    "region_density": st.one_of(anything, arrays.arrays(np.float64, 36, elements=st.floats())),
    "scales": st.one_of(anything, st.just(mrc.optimize(SURFACE, RING).scales)),
}
constraints = st.sampled_from([*constraint_values]).flatmap(
    lambda name: st.tuples(st.just(name), constraint_values[name])
)


@examples(400)
@given(constraint=constraints, weight=st.sampled_from([0.0, 1.0, -1e50]))
def test_arbitrary_constraints(constraint, weight):
    """With the largest weights, rounding decides what is better, so only finiteness is checked."""
    options = mrc.Options(width=2, region_weight=weight)
    result = allowed(lambda: mrc.optimize(SURFACE, RING, options=options, **dict([constraint])))
    if result is not None:
        (check_numbers if abs(weight) <= 1 else check_finite)(result)


@examples(300)
@given(
    contours=st.one_of(anything, st.lists(st.one_of(st.just(RING), st.just(RING - 6), indices), max_size=3)),
    closed=st.one_of(st.booleans(), anything),
    constraint=st.one_of(constraints, st.just(("closed", True))),
)
def test_arbitrary_lists_of_contours(contours, closed, constraint):
    more = {"closed": closed, "options": mrc.Options(width=2), **dict([constraint])}
    results = allowed(lambda: mrc.optimize_all(SURFACE, contours, **more))
    for result in results or ():
        check_numbers(result)


@examples(100)
@given(answer=anything)
def test_arbitrary_return_values_of_progress(answer):
    """The return value is converted to a bool; if that fails, as for an array, it is an error."""
    result = allowed(lambda: mrc.optimize(SURFACE, RING, progress=lambda share: answer))
    if result is not None:
        check_numbers(result)
