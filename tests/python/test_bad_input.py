# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input gives an exception that names the elements or, if it is legal after all, a correct result; never NaN or a
crash."""

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from brute_force import same_cycle
from conftest import surface_of
from hypothesis import given, settings
from hypothesis import strategies as st
from search_space_checks import check_search_space, pairs

FLOWS = ["gates", "arc_length", "harmonic"]


def tube(rows=9, columns=8):
    return meshes.tube(1 + 0.1 * np.cos(np.arange(rows)), columns, rng=np.random.default_rng(3), noise=0.02)


def ring(row, columns=8):
    return row * columns + np.arange(columns, dtype=np.int32)


def check_answer(mesh, contour, options=None, **keywords):
    """Optimizes, and checks what holds for every result."""
    options = options or {}
    surface = surface_of(mesh, **keywords)
    result = mrc.optimize(surface, contour, options=mrc.Options(**options))
    space = mrc.search_space(surface, contour, options=mrc.Options(**options))
    numbers = [result.ratio, result.initial_ratio, result.objective, result.lower_bound, result.gap, result.salience]
    assert np.isfinite(numbers).all()
    assert np.isfinite(result.positions).all()
    assert result.objective <= result.initial_objective
    loop = result.vertices.tolist()
    real = {frozenset(edge) for face in mesh.faces for edge in pairs(face)}
    assert len(set(loop)) == len(loop)
    assert all(frozenset(edge) in real for edge in pairs(loop))
    check_search_space(mesh, np.asarray(contour), space, options)
    return result


def check_answer_or_error(mesh, contour, options=None, **keywords):
    try:
        check_answer(mesh, contour, options, **keywords)
    except ValueError as error:
        if len(str(error)) < 10:
            raise AssertionError("the error has no message") from error


# ---- the surface


def arguments(**changes):
    names = ("positions", "face_offsets", "face_vertices", "triangles")
    return {**dict(zip(names, tube().arguments(), strict=True)), **changes}


def changed(name, index, value, dtype=None):
    array = np.array(arguments()[name], dtype=dtype)
    array[index] = value
    return {name: array}


BAD_SURFACES = {
    "two-dimensional positions": ({"positions": np.zeros((72, 2))}, "positions"),
    "flat positions": ({"positions": np.zeros(216)}, "positions"),
    "text as positions": ({"positions": np.full((72, 3), "x")}, None),
    "complex positions": ({"positions": np.zeros((72, 3), dtype=complex)}, None),
    "no positions": ({"positions": None}, None),
    "NaN in a position": (changed("positions", (17, 1), np.nan), "17"),
    "infinity in a position": (changed("positions", (23, 2), -np.inf), "23"),
    "corner out of range": (changed("face_vertices", 5, 99), "99"),
    "negative corner": (changed("face_vertices", 5, -4), "-4"),
    "huge corner": (changed("face_vertices", 5, 2**40, np.int64), None),
    "corner repeated in a face": (changed("face_vertices", 5, arguments()["face_vertices"][4]), "1"),
    "fractional corners": ({"face_vertices": arguments()["face_vertices"] + 0.5}, None),
    "two-dimensional corners": ({"face_vertices": arguments()["face_vertices"].reshape(-1, 4)}, None),
    "offsets that do not start at zero": (changed("face_offsets", 0, 1), "offset"),
    "decreasing offsets": (changed("face_offsets", 7, 2), None),
    "offsets that end early": ({"face_offsets": arguments()["face_offsets"][:-1]}, None),
    "offsets that end late": (changed("face_offsets", -1, 400), None),
    "no offsets": ({"face_offsets": np.zeros(0, dtype=np.int32)}, None),
    "face with two corners": (changed("face_offsets", 3, 10), "2"),
    "too few triangles": ({"triangles": arguments()["triangles"][:-1]}, "triangle"),
    "triangles with four corners": ({"triangles": np.zeros((64, 4), dtype=np.int32)}, "triangle"),
    "triangle of another face": (changed("triangles", (20, 0), 0), None),
    "triangle out of range": (changed("triangles", (20, 0), 1000), "1000"),
    "hidden face out of range": ({"hidden_faces": np.array([64], dtype=np.int32)}, "64"),
    "negative hidden face": ({"hidden_faces": np.array([-1], dtype=np.int32)}, "-1"),
    "quads without offsets": (
        {"face_offsets": None, "face_vertices": np.zeros((5, 4), dtype=np.int32), "triangles": None},
        None,
    ),
}


@pytest.mark.parametrize("name", BAD_SURFACES)
def test_bad_surface_arrays_are_refused(name):
    changes, message = BAD_SURFACES[name]
    with pytest.raises((ValueError, TypeError), match=message):
        mrc.Surface(**arguments(**changes))


def test_unchanged_arguments_are_accepted():
    mrc.Surface(**arguments())
    check_answer(tube(), ring(4))


@pytest.mark.parametrize("dtype", [np.int64, np.uint32, np.int16])
def test_other_dtypes_and_layouts_are_converted(dtype):
    mesh, contour = tube(), ring(4)
    expected = mrc.optimize(surface_of(mesh), contour)
    surface = mrc.Surface(
        np.asfortranarray(mesh.positions),
        mesh.face_offsets.astype(dtype).tolist(),
        np.repeat(mesh.face_vertices.astype(dtype), 2)[::2],
        mesh.triangles.astype(dtype),
    )
    found = mrc.optimize(surface, contour.astype(dtype).tolist())
    assert np.array_equal(found.vertices, expected.vertices)
    assert found.ratio == expected.ratio


def test_surface_keeps_its_own_copy_of_arrays():
    """Changing the arrays after construction has no effect."""
    mesh, contour = tube(), ring(4)
    expected = mrc.optimize(surface_of(mesh), contour)
    arrays = [array.copy() for array in mesh.arguments()]
    surface = mrc.Surface(*arrays)
    for array in arrays:
        array[...] = -7
    del arrays
    found = mrc.optimize(surface, contour)
    assert np.array_equal(found.vertices, expected.vertices)
    assert found.ratio == expected.ratio


def test_read_only_arrays_are_accepted():
    arrays = [array.copy() for array in tube().arguments()]
    for array in arrays:
        array.flags.writeable = False
    mrc.optimize(mrc.Surface(*arrays), ring(4))


def test_empty_mesh_is_legal():
    """A mesh without faces is legal, but has no contours."""
    surface = mrc.Surface(np.zeros((0, 3)), np.zeros(1, dtype=np.int32), np.zeros(0, dtype=np.int32))
    with pytest.raises(ValueError, match="0"):
        mrc.optimize(surface, [0, 1, 2])


# ---- the contour

BAD_CONTOURS = {
    "empty": ([], None),
    "two vertices": ([32, 33], "2|two"),
    "repeated vertex": ([*ring(4), 32], "32"),
    "touches itself": ([32, 33, 41, 40, 32, 24, 25, 26, 27, 28, 29, 30, 31], "32"),
    "vertices not joined by an edge": ([32, 33, 34, 35, 36, 37, 39], "37"),
    "across a quad": ([32, 33, 42, 43, 35, 36, 37, 38, 39], "33"),
    "out of range": ([32, 33, 34, 72], "72"),
    "negative": ([32, 33, -3], "-3"),
    "fractional numbers": (ring(4) + 0.25, None),
    "two dimensions": (ring(4).reshape(2, 4), None),
    "text": (["a", "b", "c"], None),
}


@pytest.mark.parametrize("name", BAD_CONTOURS)
@pytest.mark.parametrize("function", [mrc.optimize, mrc.measure, mrc.band, mrc.search_space])
def test_bad_contours_are_refused(name, function):
    contour, message = BAD_CONTOURS[name]
    with pytest.raises((ValueError, TypeError), match=message):
        function(surface_of(tube()), contour, closed=True, options=mrc.Options())


def test_diagonal_is_not_an_edge():
    mesh = tube()
    face = next(face for face in mesh.faces if 33 in face and 42 in face)
    start = 2 * mesh.faces.index(face)
    diagonal = set(mesh.triangles[start]) & set(mesh.triangles[start + 1])
    contour = [32, 33, 42, 34, 35, 36, 37, 38, 39] if diagonal == {33, 42} else [32, 33, 41, 34, 35, 36, 37, 38, 39]
    with pytest.raises(ValueError, match="edge"):
        mrc.optimize(surface_of(mesh), contour)


@pytest.mark.parametrize("flow", FLOWS)
def test_contour_on_a_border(flow):
    """Such a contour has only one side, into which the band grows."""
    for contour in (ring(0), ring(8), ring(0)[::-1]):
        check_answer_or_error(tube(), contour, {"flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
def test_contour_partly_along_the_border(flow):
    contour = [0, 1, 2, 3, 11, 12, 13, 14, 15, 8]
    check_answer_or_error(tube(), np.array(contour, dtype=np.int32), {"flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("hidden", [[32, 33, 34], [24, 25, 26, 32, 33, 34], range(64), range(32, 64)])
def test_contour_on_hidden_faces(flow, hidden):
    check_answer_or_error(tube(), ring(4), {"flow": flow}, hidden_faces=np.array(hidden, dtype=np.int32))


@pytest.mark.parametrize("flow", FLOWS)
def test_contour_on_an_edge_of_three_faces(flow):
    base = tube()
    positions = np.concatenate([base.positions, [[2.0, 0.5, 4.0], [2.0, 0.0, 4.0]]])
    fin = meshes.polygon_mesh(positions, [*base.faces, (32, 33, 72, 73)])
    check_answer_or_error(fin, ring(4), {"flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
def test_contour_along_inconsistent_winding(flow):
    base = tube()
    flipped = [face[::-1] if i in (34, 41) else face for i, face in enumerate(base.faces)]
    check_answer_or_error(meshes.polygon_mesh(base.positions, flipped), ring(4), {"flow": flow})
    inside_out = [face[::-1] if i >= 32 else face for i, face in enumerate(base.faces)]
    check_answer_or_error(meshes.polygon_mesh(base.positions, inside_out), ring(4), {"flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
def test_contour_through_a_vertex_of_two_fans(flow):
    """The tip of a cone touches the tube at a vertex of the contour."""
    base = tube()
    tip = base.positions[34]
    cone = tip + 0.5 * (tip * [1, 1, 0] + np.array([[0, 0, 0.3], [0.2, -0.2, -0.2], [-0.2, 0.2, -0.2]]))
    mesh = meshes.polygon_mesh(
        np.concatenate([base.positions, cone]), [*base.faces, (34, 72, 73), (34, 73, 74), (34, 74, 72)]
    )
    check_answer_or_error(mesh, ring(4), {"flow": flow})
    check_answer(mesh, ring(7), {"flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
def test_contour_around_a_single_vertex_or_face(flow):
    sphere = meshes.icosphere(2)
    v = 40
    link = {a: b for face in sphere.faces if v in face for a, b in pairs(face) if v not in (a, b)}
    loop = [min(link)]
    while link[loop[-1]] != loop[0]:
        loop.append(link[loop[-1]])
    for contour in (loop, list(sphere.faces[17])):
        for direction in (1, -1):
            check_answer_or_error(sphere, np.array(contour[::direction], dtype=np.int32), {"flow": flow})
    quads = tube()
    for contour in (list(quads.faces[30]), [32, 33, 34, 42, 50, 49, 48, 40]):
        check_answer_or_error(quads, np.array(contour, dtype=np.int32), {"flow": flow})


# ---- degenerate geometry


@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("merged", [(35, 36), (35, 43), (51, 52), (43, 52)])
def test_zero_length_edges(flow, merged):
    mesh = tube()
    positions = mesh.positions.copy()
    positions[merged[0]] = positions[merged[1]]
    check_answer_or_error(mesh.moved(positions), ring(4), {"flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
def test_zero_area_faces(flow):
    mesh = meshes.tube(np.ones(9), 8, split_fraction=1.0)
    flat = mesh.positions.copy()
    flat[[43, 44]] = flat[[35, 36]] * 0.5 + flat[[34, 35]] * 0.5
    check_answer_or_error(mesh.moved(flat), ring(4), {"flow": flow})
    collapsed = mesh.positions.copy()
    collapsed[ring(5)] = collapsed[ring(4)]
    check_answer_or_error(mesh.moved(collapsed), ring(4), {"flow": flow})


@pytest.mark.parametrize("flow", FLOWS)
def test_mesh_collapsed_to_a_point_or_line(flow):
    mesh = tube()
    check_answer_or_error(mesh.moved(np.zeros_like(mesh.positions)), ring(4), {"flow": flow})
    check_answer_or_error(mesh.moved(mesh.positions * [0, 0, 1]), ring(4), {"flow": flow})


@pytest.mark.parametrize("size", [1e-30, 1e-12, 1e12, 1e30])
def test_extreme_sizes(size):
    check_answer(tube().moved(tube().positions * size), ring(4))


@pytest.mark.parametrize("flow", FLOWS)
def test_flat_plane(flow):
    """Nothing is concave: the numerator is pure bending, so no ratio is negative, and that of a square is not NaN."""
    y, x = np.meshgrid(np.arange(13.0), np.arange(13.0), indexing="ij")
    mesh = meshes.polygon_mesh(
        np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3), meshes.grid_faces(13, 13, closed_columns=False)
    )
    square = [4 * 13 + x for x in range(4, 8)] + [y * 13 + 8 for y in range(4, 8)]
    square += [8 * 13 + x for x in range(8, 4, -1)] + [y * 13 + 4 for y in range(8, 4, -1)]
    result = check_answer(mesh, np.array(square, dtype=np.int32), {"flow": flow, "width": 2})
    # Four right angles, each |e| (1 - cos 45 degrees) with kappa_0 = 3 * 0.01 / L0, over 16 edges of length 1.
    assert result.initial_ratio == pytest.approx(4 * (1 - np.sqrt(0.5)) * 0.03 / 16 / 16, rel=1e-6)
    assert result.ratio >= 0


@pytest.mark.parametrize("flow", FLOWS)
def test_cube(flow):
    """A cube with eight vertices, and a finer one."""
    corners = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    cube = meshes.polygon_mesh(corners, faces)
    result = check_answer(cube, np.array([0, 1, 3, 2], dtype=np.int32), {"flow": flow})
    assert result.status == "unchanged" or result.ratio < result.initial_ratio
    ring_positions = [(x, -1) for x in np.linspace(-1, 1, 7)[:-1]]
    ring_positions += [(-y, x) for x, y in ring_positions] + [(-x, -y) for x, y in ring_positions]
    ring_positions += [(y, -x) for x, y in ring_positions[:6]]
    rows = [np.column_stack([ring_positions, np.full(24, z)]) for z in np.linspace(-1, 1, 7)]
    walls = meshes.polygon_mesh(np.concatenate(rows), meshes.grid_faces(7, 24))
    check_answer(walls, ring(3, 24), {"flow": flow, "width": None})


@pytest.mark.parametrize("flow", FLOWS)
def test_ring_around_a_triangular_prism_is_legal(flow):
    """Turns are measured in the tangent plane, so a ring around a triangular prism is legal despite its sharp
    corners."""
    mesh = meshes.tube([1.0, 0.9, 0.7, 0.9, 1.0], 3)
    space = mrc.search_space(surface_of(mesh), ring(1, 3), options=mrc.Options(flow=flow))
    nodes = {tuple(node) for node in space["nodes"].tolist()}
    for row in range(1, 4):  # the rows in between are those of the border, where no contour runs
        assert set(pairs(ring(row, 3))) <= nodes
    result = check_answer(mesh, ring(1, 3), {"flow": flow})
    assert same_cycle(result.vertices, ring(2, 3))


# ---- options and the rest

BAD_OPTIONS = [
    {"width": 0},
    {"width": -1},
    {"iterations": -2},
    {"kappa0_factor": -1.0},
    {"kappa0_factor": np.nan},
    {"kappa0_factor": np.inf},
    {"curvature_radius": 0.0},
    {"curvature_radius": -1.0},
    {"curvature_radius": np.nan},
    {"curvature_smoothing": -0.1},
    {"curvature_smoothing": np.inf},
    {"feature_exponent": np.nan},
    {"feature_exponent": -1.0},
    {"direction_exponent": -2.0},
    {"direction_exponent": np.inf},
    {"max_turn": 0.0},
    {"max_turn": -1.0},
    {"max_turn": np.nan},
    {"flow": "sideways"},
    {"feature": "hill"},
    {"flow": ""},
]


@pytest.mark.parametrize("bad", BAD_OPTIONS, ids=[str(bad) for bad in BAD_OPTIONS])
def test_error_names_the_bad_option(bad):
    """The message contains the name of the option."""
    with pytest.raises(ValueError, match=next(iter(bad))):
        mrc.optimize(surface_of(tube()), ring(4), options=mrc.Options(**bad))


@pytest.mark.parametrize("bad", [{"width": "wide"}, {"widht": 4}, {"width": 2.5}, {"flow": 3}, {"iterations": 1.5}])
def test_unknown_options_and_wrong_types_are_refused(bad):
    with pytest.raises(TypeError):
        mrc.Options(**bad)


def test_options_are_keywords_only():
    with pytest.raises(TypeError):
        mrc.Options(4)


def test_scales_must_be_a_scales_object():
    with pytest.raises(TypeError):
        mrc.optimize(surface_of(tube()), ring(4), scales={"h": 1.0})


# ---- random and damaged meshes

faces = st.lists(st.lists(st.integers(-1, 9), min_size=2, max_size=5), min_size=1, max_size=12)
proper_faces = st.lists(st.lists(st.integers(0, 9), min_size=3, max_size=4, unique=True), min_size=1)


@settings(derandomize=True, max_examples=300, deadline=None, database=None)
@given(soup=st.one_of(faces, proper_faces, proper_faces), which=st.integers(0, 13))
def test_polygon_soup_gives_an_error_or_finite_numbers(soup, which):
    """Random polygons on a few vertices; most of their edges are shared by many."""
    positions = np.random.default_rng(5).standard_normal((10, 3))
    offsets = np.cumsum([0] + [len(face) for face in soup])
    try:
        surface = mrc.Surface(positions, offsets, np.concatenate(soup))
        found = mrc.curvature(surface, mrc.Options())
        assert np.isfinite(found.kappa_min).all()
        assert np.isfinite(found.direction_max).all()
        mrc.optimize(surface, soup[which % len(soup)])
    except ValueError:
        pass


def damaged_sphere(rng):
    """A sphere with holes, reversed faces, fins, collapsed edges and hidden faces, and a loop around it."""
    sphere = meshes.icosphere(2)
    normal = rng.standard_normal(3)
    loops = meshes.plane_contours(sphere, normal / np.linalg.norm(normal), rng.uniform(-0.6, 0.6))
    polygons, positions = list(sphere.faces), sphere.positions.copy()
    for place in rng.choice(len(polygons), 12, replace=False)[: rng.integers(12)]:
        kind = rng.integers(4)
        a, b, c = polygons[place]
        if kind == 0:
            polygons[place] = (a, c, b)
        elif kind == 1:
            polygons.append((a, b, int(rng.integers(len(positions)))))
        elif kind == 2:
            positions[a] = positions[b]
        else:
            polygons[place] = None
    polygons = [polygon for polygon in polygons if polygon and len(set(polygon)) == 3]
    hidden = rng.choice(len(polygons), rng.integers(8), replace=False)
    return meshes.polygon_mesh(positions, polygons), max(loops, key=len), hidden.astype(np.int32)


def test_damage_beside_a_sound_loop_is_tolerated():
    """If the loop itself is sound the result is correct, whatever is near it."""
    answers = 0
    for seed in range(250):
        mesh, contour, hidden = damaged_sphere(np.random.default_rng(seed))
        options = {"flow": FLOWS[seed % 3], "width": (2, 4, None)[seed % 4 % 3]}
        try:
            mrc.band(surface_of(mesh, hidden_faces=hidden), contour)
        except ValueError:
            continue
        check_answer(mesh, contour, options, hidden_faces=hidden)
        answers += 1
    assert answers > 40
