# SPDX-License-Identifier: GPL-3.0-or-later
"""What the figures of the thesis show (1.1, 3.3, chapter 5), checked by numbers on bodies of known shape."""

from functools import cache
from itertools import pairwise

import figures  # from blend_samples, which draws the figures
import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

FLOWS = ["gates", "arc_length", "harmonic"]
all_flows = pytest.mark.parametrize("flow", FLOWS)


@cache
def mesh_of(name, **keywords):
    figure = figures.FIGURES[name](**keywords)
    return figure, meshes.polygon_mesh(figure.positions, figure.faces)


def run(figure, mesh, search, flow, **more):
    options = mrc.Options(**{**search.options, "flow": flow, **more})
    return mrc.optimize(surface_of(mesh), search.given, closed=search.closed, options=options, **search.constraints)


def results(name, flow):
    """A figure, its mesh, and the result of each of its searches by title."""
    figure, mesh = mesh_of(name)
    return figure, mesh, {search.title: run(figure, mesh, search, flow) for search in figure.searches}


def mean_edge(mesh):
    edges = mesh.real_edges()
    return np.linalg.norm(mesh.positions[edges[:, 0]] - mesh.positions[edges[:, 1]], axis=1).mean()


def samples(points, closed=True, count=8):
    """Evenly spaced points along each segment of a curve."""
    following = np.roll(points, -1, axis=0) if closed else points[1:]
    share = np.arange(count)[:, None, None] / count
    return np.concatenate([((1 - share) * points[: len(following)] + share * following).reshape(-1, 3), points[-1:]])


def distances(curve, other, closed=True):
    """The distances from points all along one curve to the nearest points of another."""
    apart = samples(curve, closed)[:, None] - samples(other, closed)[None]
    return np.linalg.norm(apart, axis=2).min(axis=1)


def hausdorff(one, two):
    return max(distances(one, two).max(), distances(two, one).max())


def length(points):
    return np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum()


def shortest_loop(mesh, faces):
    """The shortest path along the edges of these faces once around the z axis. It is the shortest path, on two copies
    of the graph joined where the angle wraps around, from a vertex of the first copy to its twin in the second."""
    edges = {e for i in faces for e in zip(mesh.faces[i], mesh.faces[i][1:] + mesh.faces[i][:1])}
    tail, head = np.array(sorted(edges | {(b, a) for a, b in edges})).T
    angle = np.arctan2(mesh.positions[:, 1], mesh.positions[:, 0])
    step = np.rint((angle[tail] - angle[head]) / (2 * np.pi)).astype(int)  # 1 where the angle wraps around
    count, weight = len(angle), np.linalg.norm(mesh.positions[tail] - mesh.positions[head], axis=1)
    rows, columns = np.concatenate([tail, tail[step == 0] + count]), np.concatenate([head, head[step == 0] + count])
    columns[: len(tail)] += count * (step == 1)
    keep = np.concatenate([step >= 0, np.ones((step == 0).sum(), dtype=bool)])
    weights = np.concatenate([weight, weight[step == 0]])
    graph = coo_matrix((weights[keep], (rows[keep], columns[keep])), shape=(2 * count, 2 * count)).tocsr()
    starts = np.unique(head[step == 1])
    away, before = dijkstra(graph, indices=starts, return_predecessors=True)
    best = int(np.argmin(away[np.arange(len(starts)), starts + count]))
    path = [starts[best] + count]
    while path[-1] != starts[best]:
        path.append(before[best, path[-1]])
    return np.array(path[1:][::-1]) % count


# ---- all figures


@pytest.mark.parametrize("name", figures.FIGURES)
def test_figures_are_sound_and_reproducible_meshes(name):
    figure, again = figures.FIGURES[name](), figures.FIGURES[name]()
    assert np.array_equal(figure.positions, again.positions)
    assert figure.faces == again.faces
    assert figure.name == name
    assert len(figure.title) <= 60
    assert 1000 <= len(figure.faces) <= 6200
    directed = [edge for face in figure.faces for edge in zip(face, face[1:] + face[:1])]
    assert len(directed) == len(set(directed))
    edges = {frozenset(edge) for edge in directed}
    for curve in (*figure.truths, *(search.given for search in figure.searches)):
        assert {frozenset(edge) for edge in pairwise(np.asarray(curve).tolist())} <= edges
    assert wound_outward(figure, directed)


def wound_outward(figure, directed):
    """Whether a closed body has positive volume, or an open sheet faces up or towards the viewer, along -y."""
    a, b, c = (figure.positions[[face[i] for face in figure.faces]] for i in range(3))
    if set(directed) == {(v, u) for u, v in directed}:
        return (a * np.cross(b, c)).sum() > 0
    return np.cross(b - a, c - a).sum(axis=0) @ [0, -1, 1] > 0


@all_flows
@pytest.mark.parametrize("name", figures.FIGURES)
def test_every_search_of_a_figure_improves_its_contour(name, flow):
    for result in results(name, flow)[2].values():
        assert result.status == "improved"
        assert result.objective < result.initial_objective
        assert result.gap <= 1e-9 * abs(result.objective)


# ---- 1.1: from anywhere on a finger to its base


@all_flows
def test_1_1_every_start_on_the_finger_gives_the_base(flow):
    figure, mesh, found = results("1.1", flow)
    edge, base = mean_edge(mesh), mesh.positions[figure.truths[0]]
    wide = [search for search in figure.searches if search.options["width"] == 24]
    assert len(wide) == 4
    for search in wide:
        assert distances(mesh.positions[search.given], base).min() > 3 * edge
        assert distances(found[search.title].positions, base).max() < 0.5 * edge


@all_flows
def test_1_1_contour_near_the_tip_does_not_vanish(flow):
    """Shortening a contour there would move it up until it vanishes. If the band does not reach the base, the contour
    moves down with each iteration, or stays."""
    figure, mesh, found = results("1.1", flow)
    narrow = figure.searches[-1]
    before, after = mesh.positions[narrow.given], found[narrow.title].positions
    angle = np.unwrap(np.arctan2(after[:, 1], after[:, 0]), period=2 * np.pi)
    assert abs(angle[-1] - angle[0]) > np.pi  # it still goes around the finger
    assert after[:, 2].mean() < before[:, 2].mean()
    shortest = shortest_loop(mesh, range(len(mesh.faces)))
    assert mesh.positions[shortest, 2].min() > before[:, 2].mean()
    assert length(after) > 2 * length(mesh.positions[shortest])


# ---- 3.3: proximity


@pytest.fixture
def fragments():
    """The three curves of figure 3.3, each divided into fragment A, completion and fragment C."""
    figure, mesh = mesh_of("3.3")
    curves = [figure.truths[0], *(search.given for search in figure.searches)]
    a, c = set(curves[0][: figures.FRAGMENT + 1]), set(curves[0][-figures.FRAGMENT - 1 :])
    assert all(a < set(curve) and c < set(curve) for curve in curves)
    return figure, mesh, curves


def test_3_3_shortest_completion_has_the_least_ratio(fragments):
    figure, mesh, curves = fragments
    surface, options = surface_of(mesh), mrc.Options(**figure.searches[0].options)
    scales = mrc.optimize(surface, curves[0], closed=False, options=options).scales

    def measure(curve):
        return mrc.measure(surface, curve, closed=False, options=options, scales=scales)

    cut = figures.FRAGMENT
    for curve in curves:
        assert measure(curve[: cut + 1]).numerator < 0
        assert measure(curve[-cut - 1 :]).numerator < 0
        assert measure(curve[cut:-cut]).numerator > 0
    whole = [measure(curve) for curve in curves]
    assert [m.length for m in whole] == sorted(m.length for m in whole)
    assert whole[0].ratio < whole[1].ratio < whole[2].ratio


@all_flows
@pytest.mark.parametrize("ends", ["edges", "vertices"])
def test_3_3_search_returns_the_shortest_completion(flow, ends, fragments):
    figure, mesh, curves = fragments
    for search in figure.searches:
        assert run(figure, mesh, search, flow, ends=ends).vertices.tolist() == curves[0].tolist()


# ---- 5.1: regular and refined


def turning(mesh, result):
    """The sum of the turns in the tangent plane, with normals weighted by area and linear along edges."""
    normals = np.zeros_like(mesh.positions)
    a, b, c = (mesh.positions[mesh.triangles[:, i]] for i in range(3))
    for i in range(3):
        np.add.at(normals, mesh.triangles[:, i], np.cross(b - a, c - a))
    t, ends = result.edge_parameters[:, None], normals[result.edge_vertices]
    normal = (1 - t) * ends[:, 0] + t * ends[:, 1]
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    into = result.positions - np.roll(result.positions, 1, axis=0)
    out = np.roll(into, -1, axis=0)
    into, out = (e - (e * normal).sum(axis=1, keepdims=True) * normal for e in (into, out))
    sine, cosine = (np.cross(into, out) * normal).sum(axis=1), (into * out).sum(axis=1)
    return np.abs(np.arctan2(sine, cosine)).sum()


@all_flows
@pytest.mark.parametrize("seed", range(50, 53))
def test_5_1_refined_contours_turn_less_and_stay_close(flow, seed):
    figure, mesh = mesh_of("5.1", seed=seed)
    regular, one, two = (run(figure, mesh, search, flow) for search in figure.searches)
    assert turning(mesh, regular) > turning(mesh, one) > turning(mesh, two)
    assert regular.ratio > one.ratio > two.ratio
    edge, found = mean_edge(mesh), [result.positions for result in (regular, one, two)]
    assert hausdorff(mesh.positions[figure.searches[0].given], found[0]) > 3 * edge
    for i, j in ((0, 1), (0, 2), (1, 2)):
        assert hausdorff(found[i], found[j]) < 2 * edge
    assert abs(found[2][:, 2]).max() < edge  # the groove is the circle z = 0


# ---- 5.2: escaping local minima


@all_flows
@pytest.mark.parametrize("seed", range(3))
def test_5_2_loop_halfway_up_a_finger_moves_to_its_base(flow, seed):
    """The finger becomes thinner towards the tip, so a snake would slip off over it, as does the shortest loop of the
    same band. The base ring is the only concave corner of the profile, known from the construction of the mesh."""
    rng = np.random.default_rng(seed)
    mesh, base_ring = meshes.finger(rng)
    loops = meshes.plane_contours(mesh, [*rng.uniform(-0.15, 0.15, 2), 1.0], 1.9)
    contour = max(loops, key=len)
    surface, options = surface_of(mesh), mrc.Options(width=13, flow=flow)
    result = mrc.optimize(surface, contour, options=options)
    shortest = shortest_loop(mesh, mrc.band(surface, contour, options=options))

    def distance(loop):
        return distances(mesh.positions[loop], mesh.positions[base_ring]).mean() / mean_edge(mesh)

    assert distance(contour) > 6
    assert distance(shortest) > distance(contour)
    assert result.status == "improved"
    assert distance(result.vertices) <= 2
    assert length(mesh.positions[shortest]) < length(mesh.positions[result.vertices])
    assert mrc.measure(surface, shortest, options=options, scales=result.scales).ratio > result.ratio


@all_flows
def test_5_2_refinement_stays_at_the_base(flow):
    figure, mesh, found = results("5.2", flow)
    regular, refined = found.values()
    base = mesh.positions[figure.truths[0]]
    for result in (regular, refined):
        assert distances(result.positions, base).max() < 0.5 * mean_edge(mesh)
    assert refined.ratio < regular.ratio


@all_flows
def test_5_2_finds_a_slanted_groove_on_regular_quads(flow):
    """In the harmonic flow all edges across the band are level: without level edges no contour could leave its ring.
    The quads are sheared where the groove crosses them, so the steps along it turn by a little more than a right
    angle."""
    rows, columns, slope = 61, 64, 0.5
    mesh = meshes.tube(np.ones(rows), columns, step=2 * np.pi / columns)
    x, y, z = mesh.positions.T
    off = z - z.mean() - slope * x
    depth = 1 - 0.12 * np.exp(-((off / 0.25) ** 2))
    mesh = mesh.moved(np.stack([x * depth, y * depth, z], axis=-1))
    contour = (rows // 2) * columns + np.arange(columns, dtype=np.int32)
    result = mrc.optimize(surface_of(mesh), contour, options=mrc.Options(width=8, flow=flow, max_turn=np.radians(100)))
    edge = mean_edge(mesh)
    assert np.abs(off[contour]).mean() > 3 * edge
    assert result.status == "improved"
    assert np.abs(off[result.vertices]).mean() < 0.5 * edge


# ---- 5.3: two widths


@all_flows
def test_5_3_wider_band_finds_the_deeper_ring(flow):
    figure, mesh, found = results("5.3", flow)
    edge, surface = mean_edge(mesh), surface_of(mesh)
    for search, ring, other in zip(figure.searches, figure.truths, figure.truths[::-1]):
        result = found[search.title]
        assert distances(result.positions, mesh.positions[ring]).max() < 0.5 * edge
        assert distances(result.positions, mesh.positions[other]).min() > 3 * edge
    narrow, wide = found.values()
    shallow, deep = (mrc.measure(surface, ring, scales=wide.scales).ratio for ring in figure.truths)
    assert deep < shallow < 0
    assert wide.ratio < narrow.ratio
    bands = [mrc.band(surface, s.given, options=mrc.Options(**s.options, flow=flow)) for s in figure.searches]
    held = [{v for face in band for v in mesh.faces[face]} for band in bands]
    assert not held[0] & set(figure.truths[1])
    assert set(figure.truths[0]) | set(figure.truths[1]) <= held[1]


# ---- 5.4: over several local minima


def front(points):
    return points[points[:, 1] < 0]


@all_flows
def test_5_4_narrow_band_stops_in_every_groove(flow):
    """A jagged contour along a groove moves into it; then there is nothing better within reach: a local minimum."""
    figure, mesh = mesh_of("5.4")
    surface, edge = surface_of(mesh), mean_edge(mesh)
    options = mrc.Options(width=2, iterations=5, flow=flow)
    for height in figures.TORSO_GROOVES:
        start = max(meshes.plane_contours(mesh, [0.02, 0.03, 1.0], height), key=len)
        found = mrc.optimize(surface, start, options=options)
        assert abs(front(found.positions)[:, 2] - height).max() < edge
        again = mrc.optimize(surface, found, options=options)
        assert again.status == "unchanged"
        assert again.ratio < 0


@all_flows
def test_5_4_wide_band_crosses_the_grooves_to_the_waist(flow):
    figure, mesh, found = results("5.4", flow)
    narrow, wide = found.values()
    edge, start = mean_edge(mesh), mesh.positions[figure.searches[0].given][:, 2]
    jumped = [height for height in figures.TORSO_GROOVES if figures.TORSO_WAIST < height < start.min()]
    assert len(jumped) >= 2
    assert narrow.positions[:, 2].min() > max(jumped)
    assert abs(wide.positions[:, 2] - figures.TORSO_WAIST).max() < edge
    assert wide.ratio < narrow.ratio < 0


# ---- 5.5: iterations


def off_groove(points):
    return abs(figures.eye_distance(points[:, 0], points[:, 2]))


@all_flows
@pytest.mark.parametrize("side", ["left", "right"])
def test_5_5_iterations_improve_until_they_converge_in_the_groove(side, flow):
    figure, mesh = mesh_of("5.5")
    search = next(s for s in figure.searches if s.title == f"{side}, refined")
    five = run(figure, mesh, search, flow, regular_iterations=0, refinement=0, iterations=5)
    assert len(five.history) == 6
    assert (np.diff(five.history) < 0).all()
    regular = run(figure, mesh, search, flow, regular_iterations=0, refinement=0, iterations=9)
    refined = run(figure, mesh, search, flow, regular_iterations=9)
    assert regular.history[-1] == regular.history[-2]
    assert refined.ratio < regular.ratio
    before = off_groove(mesh.positions[search.given])
    assert before.min() < 1  # edges are about 1 long; at the corners of the eye, the band reaches the groove
    assert (before > 3).mean() > 1 / 3  # elsewhere it does not
    assert off_groove(regular.positions).max() < 1.5
    assert off_groove(refined.positions).max() < 1.5


@all_flows
def test_5_5_searches_show_the_iterations(flow):
    """The result in each picture is that of a single run after this many iterations; one iteration is not enough."""
    figure, _, found = results("5.5", flow)
    whole = found["after 5"].history
    for i in range(1, 6):
        assert found[f"after {i}"].objective == whole[min(i, len(whole) - 1)]
    assert off_groove(found["after 1"].positions).max() > 3
    assert off_groove(found["after 5"].positions).max() < 1.5


# ---- 5.6: hard constraints


def outside_face(points):
    """How far points lie outside the outline of the face, in edge lengths."""
    return figures.face_distance(points[:, 0], points[:, 2])


@all_flows
def test_5_6_three_vertices_hold_the_contour_on_the_chin(flow):
    figure, mesh, found = results("5.6", flow)
    free, held = found.values()
    required = figure.searches[1].constraints["required_vertices"]
    assert len(required) == 3
    half_way = figures.NECK[0] / 2
    assert outside_face(free.positions).max() > figures.NECK[0] - 1
    assert (outside_face(free.positions) > half_way).sum() >= 10
    assert not set(required) & set(free.vertices)
    assert set(required) <= set(held.vertices)
    assert abs(outside_face(held.positions)).max() < half_way
    assert free.ratio < held.ratio  # without constraints it is really better: only the constraint can hold the contour


# ---- 5.7: open curves


@all_flows
@pytest.mark.parametrize("ends", ["edges", "vertices"])
def test_5_7_open_curve_finds_the_hairline(flow, ends):
    figure, mesh = mesh_of("5.7")
    search, edge = figure.searches[0], mean_edge(mesh)
    given, line = mesh.positions[search.given], mesh.positions[figure.truths[0]]
    result = run(figure, mesh, search, flow, ends=ends)
    assert result.vertices[[0, -1]].tolist() == search.given[[0, -1]].tolist()
    assert distances(given, line, closed=False).mean() > 2 * edge
    assert distances(result.positions, line, closed=False).mean() < 0.5 * edge


# ---- table 5.1


def edge_count(mesh, faces):
    return len({frozenset(e) for i in faces for e in zip(mesh.faces[i], mesh.faces[i][1:] + mesh.faces[i][:1])})


@all_flows
@pytest.mark.parametrize("k", [0, 1, 2, 3])
def test_table_5_1_numbers_of_nodes_and_arcs(k, flow):
    """The numbers follow from the triangulation, and nearly match those of the thesis.

    Of the 6k^2 + 12k + 6 directed chords of a triangle, 6k(k + 1) cross it, and 2(k + 1) lie on each edge, shared with
    the neighbor. One direction of each rises in the flow and is a node: 3k(k + 1) for each face and k + 1 for each
    edge. So the horse of the thesis, with 979 faces and 1356 edges (not counting the band boundary), has 8586 nodes for
    k = 1 and 21690 for k = 2; the thesis says 8535 and 21332. Edges along which the flow is level, as on gates, are
    nodes in both directions here, but in the thesis they are no nodes.

    Through a Steiner point, a chord continues to one of the 2k + 1 points across the next triangle, or along the edge:
    at most 2k + 3 arcs for each node (k = 0: half of the six edges of a vertex rise). The flow and the limit on turns
    leave 3.3 for k = 1 and 4.4 for k = 2, and without the limit 4.3 and 5.6; the thesis has 4.2 and 5.9.
    """
    figure, mesh = mesh_of("5.1")
    surface, given = surface_of(mesh), figure.searches[0].given
    options = [mrc.Options(width=4, refinement=k, flow=flow, max_turn=turn) for turn in (np.pi / 2, np.pi)]
    held, loose = (mrc.optimize(surface, given, options=o).statistics for o in options)
    band = mrc.band(surface, given, options=options[0])
    edges = edge_count(mesh, band)
    expected = 3 * k * (k + 1) * len(band) + (k + 1) * edges
    assert held["faces"] == len(band)
    assert held["nodes"] == loose["nodes"]
    if flow == "harmonic":
        assert held["nodes"] == expected
    assert expected <= held["nodes"] <= expected + (k + 1) * edges  # each edge in at most both directions
    assert k + 1 < held["arcs"] / held["nodes"] < loose["arcs"] / loose["nodes"] < 2 * k + 3
