# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's networks of seams and region borders, without Blender: their chains, their regions, and what moves."""

import importlib
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import meshes
import numpy as np
import pytest
from conftest import surface_of

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
networks = importlib.import_module("addon.core.networks")
topology_module = importlib.import_module("addon.core.topology")
chains_module = importlib.import_module("addon.core.chains")
region_check_module = importlib.import_module("addon.core.region_check")
edge_paths = importlib.import_module("addon.core.edge_paths")


def topology_of(mesh, hidden_faces=()):
    """Return the topology of a mesh whose edges have random order and direction, as from Blender's arrays."""
    corners = [pair for face in mesh.faces for pair in zip(face, face[1:] + face[:1])]
    rng = np.random.default_rng(len(corners))
    edges = rng.permuted(rng.permutation(mesh.real_edges()), axis=1)
    number = {tuple(sorted(pair)): i for i, pair in enumerate(edges.tolist())}
    corner_edges = np.array([number[tuple(sorted(pair))] for pair in corners])
    offsets = mesh.face_offsets
    return topology_module.make_topology(
        edges, offsets, np.array([a for a, _ in corners]), corner_edges, list(hidden_faces)
    )


def centers(mesh):
    return np.array([mesh.positions[list(face)].mean(axis=0) for face in mesh.faces])


def nearest_seed(rng, mesh, count):
    """Return ragged regions: each face belongs to the nearest of some seed faces, with noise."""
    places = centers(mesh)
    seeds = places[rng.choice(len(places), count, replace=False)]
    distances = np.linalg.norm(places[:, None] - seeds, axis=2)
    return rng.permutation(count)[np.argmin(distances * rng.uniform(1, 1.3, distances.shape), axis=1)]


def bodies(rng):
    rows = np.arange(18)
    return [
        meshes.icosphere(3),
        meshes.torus(14, 30, rng=rng, split_fraction=0.5, noise=0.03, grooves=0.4),
        meshes.tube(1 - 0.3 * np.exp(-((rows - 9) ** 2) / 2.0), 20, step=0.3, rng=rng, split_fraction=0.5),
        meshes.polygon_mesh(*open_sheet(12, 16)),
    ]


def open_sheet(rows, columns):
    x, y = np.meshgrid(np.arange(columns) * 1.0, np.arange(rows) * 1.0)
    z = -np.exp(-((x - 8.0) ** 2) / 2)
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), meshes.grid_faces(rows, columns, closed_columns=False)


def cases(count):
    """(mesh, labels, hidden faces): ragged regions, from few to many, and sometimes hidden faces."""
    for seed in range(count):
        rng = np.random.default_rng(seed)
        mesh = bodies(rng)[seed % 4]
        labels = nearest_seed(rng, mesh, int(rng.integers(2, 14)))
        hidden = np.flatnonzero(rng.random(len(labels)) < 0.03) if seed % 3 == 2 else []
        yield seed, mesh, labels, hidden


CASES = list(cases(24))
networks_of_labels = pytest.mark.parametrize(
    ("mesh", "labels", "hidden"), [case[1:] for case in CASES], ids=[str(case[0]) for case in CASES]
)


def edge_faces(mesh):
    """Return the faces of each edge by sorted vertex pair, with a slow but simple loop."""
    found = {}
    for i, face in enumerate(mesh.faces):
        for pair in zip(face, face[1:] + face[:1]):
            found.setdefault(tuple(sorted(pair)), []).append(i)
    return found


def expected_borders(mesh, labels, hidden):
    return {
        pair
        for pair, faces in edge_faces(mesh).items()
        if len(faces) == 2 and not set(faces) & set(hidden) and labels[faces[0]] != labels[faces[1]]
    }


def as_pairs(edges):
    return [tuple(sorted(pair)) for pair in np.asarray(edges).tolist()]


def chain_pairs(chain):
    return as_pairs(edge_paths.contour_edges(chain.vertices, chain.closed))


# ---- chains


@networks_of_labels
def test_every_border_edge_is_in_exactly_one_chain(mesh, labels, hidden):
    topology = topology_of(mesh, hidden)
    borders = topology_module.label_borders(topology, labels)
    expected = expected_borders(mesh, labels, hidden)
    assert set(as_pairs(topology.edges[borders])) == expected
    pairs = [pair for chain in chains_module.find_chains(topology, borders) for pair in chain_pairs(chain)]
    assert sorted(pairs) == sorted(expected)


@networks_of_labels
def test_chains_meet_in_junctions_and_on_borders_only(mesh, labels, hidden):
    topology = topology_of(mesh, hidden)
    chains = chains_module.find_chains(topology, topology_module.label_borders(topology, labels))
    degrees = Counter(v for pair in expected_borders(mesh, labels, hidden) for v in pair)
    shown = {pair: [f for f in faces if f not in set(hidden)] for pair, faces in edge_faces(mesh).items()}
    border = {v for pair, faces in shown.items() if len(faces) == 1 for v in pair}
    ends = set()
    for chain in chains:
        inside = chain.vertices.tolist()
        assert len(set(inside)) == len(inside)
        held = chain.closed and list(chain.required) == inside[:1]
        ends |= set() if chain.closed and not held else {inside[0], inside[-1 if not chain.closed else 0]}
        inside = inside[held:] if chain.closed else inside[1:-1]
        assert all(degrees[v] == 2 and v not in border for v in inside)
    assert ends == {v for v, degree in degrees.items() if degree != 2 or v in border}


@networks_of_labels
def test_each_side_of_a_chain_has_one_label(mesh, labels, hidden):
    """Left and right by the faces' own winding."""
    topology = topology_of(mesh, hidden)
    left_face = {pair: i for i, face in enumerate(mesh.faces) for pair in zip(face, face[1:] + face[:1])}
    for chain in chains_module.find_chains(topology, topology_module.label_borders(topology, labels)):
        pairs = [tuple(pair) for pair in edge_paths.contour_edges(chain.vertices, chain.closed).tolist()]
        line = region_check_module._lines(topology, [chain.vertices], [chain.closed])[0]
        assert line.left.tolist() == [left_face[pair] for pair in pairs]
        assert line.right.tolist() == [left_face[pair[::-1]] for pair in pairs]
        assert len(set(labels[line.left])) == len(set(labels[line.right])) == 1


def test_chains_do_not_depend_on_the_order_of_the_edges():
    _, mesh, labels, _ = CASES[1]
    topology = topology_of(mesh)
    order = np.random.default_rng(0).permutation(len(topology.edges))
    shuffled = topology_module.Topology(
        *(getattr(topology, name)[order] for name in ("edges", "left", "right", "inner", "hidden")),
        topology.face_count,
    )
    one, other = (
        chains_module.find_chains(each, topology_module.label_borders(each, labels)) for each in (topology, shuffled)
    )
    assert Counter(frozenset(chain_pairs(chain)) for chain in one) == Counter(
        frozenset(chain_pairs(chain)) for chain in other
    )


def test_chosen_edges_form_separate_chains():
    topology = topology_of(meshes.tube(np.ones(6), 12))
    ring = 2 * 12 + np.arange(12)
    marked, chosen = np.zeros((2, len(topology.edges)), dtype=bool)
    marked[topology.find(edge_paths.contour_edges(ring))[0]] = True
    chosen[topology.find(edge_paths.contour_edges(ring[3:8], closed=False))[0]] = True
    moving, staying = sorted(chains_module.find_chains(topology, marked, chosen), key=lambda chain: not chain.chosen)
    assert set(moving.vertices) == set(ring[3:8])
    assert set(staying.vertices) == set(ring) - set(ring[4:7])
    assert (moving.chosen, staying.chosen) == (True, False)


def test_a_loop_at_a_junction_keeps_it():
    topology = topology_of(meshes.tube(np.ones(6), 12))
    ring = 2 * 12 + np.arange(12)
    marked = np.zeros(len(topology.edges), dtype=bool)
    marked[topology.find(edge_paths.contour_edges(ring))[0]] = True
    marked[topology.find([(ring[5], ring[5] + 12), (ring[5] + 12, ring[5] + 24)])[0]] = True
    loop, tail = sorted(chains_module.find_chains(topology, marked), key=lambda chain: not chain.closed)
    assert (loop.closed, loop.required, loop.vertices[0]) == (True, (ring[5],), ring[5])
    assert tail.vertices.tolist() in ([ring[5], ring[5] + 12, ring[5] + 24], [ring[5] + 24, ring[5] + 12, ring[5]])


# ---- regions


@networks_of_labels
def test_regions_are_the_connected_pieces_of_labels(mesh, labels, hidden):
    topology = topology_of(mesh, hidden)
    found = topology_module.regions(topology, topology_module.label_borders(topology, labels))
    around = {}
    for faces in edge_faces(mesh).values():
        if len(faces) == 2 and not set(faces) & set(hidden) and labels[faces[0]] == labels[faces[1]]:
            for one, other in (faces, faces[::-1]):
                around.setdefault(one, []).append(other)
    expected = np.full(len(labels), -1)
    for face in range(len(labels)):
        pending = [face] if expected[face] < 0 else []
        while pending:
            here = pending.pop()
            if expected[here] < 0:
                expected[here] = face
                pending += around.get(here, [])
    assert found.tolist() == expected.tolist()


@networks_of_labels
def test_regions_are_unchanged_if_nothing_moves(mesh, labels, hidden):
    topology = topology_of(mesh, hidden)
    borders = topology_module.label_borders(topology, labels)
    chains = chains_module.find_chains(topology, borders)
    for paths in ([None] * len(chains), [chain.vertices for chain in chains]):
        region_check = region_check_module.check_regions(topology, borders, chains, paths)
        assert region_check.lost == {}
        assert (labels[region_check.after] == labels).all()


# ---- the search


def optimize(mesh, topology, marked, chosen=None, **settings):
    return networks.optimize(
        surface_of(mesh, hidden_faces=np.flatnonzero(hidden_mask(topology))),
        chains_module.make_network(topology, marked, chosen),
        **{"width": 3, "min_salience": 0.0} | settings,
    )


def hidden_mask(topology):
    shown = np.zeros(topology.face_count, dtype=bool)
    for side in (topology.left, topology.right):
        shown[side[side >= 0]] = True
    return ~shown


def piece_labels(topology, labels):
    """Return for each label its number of connected pieces."""
    roots = np.unique(topology_module.regions(topology, topology_module.label_borders(topology, labels)))
    return Counter(labels[roots].tolist())


@networks_of_labels
@pytest.mark.slow
def test_labels_follow_the_borders(mesh, labels, hidden):
    """The borders of the new labels are the new contours; every label keeps its pieces; what is hidden stays."""
    topology = topology_of(mesh, hidden)
    plan = optimize(mesh, topology, topology_module.label_borders(topology, labels))
    new = labels[plan.region_check.after]
    lines = [
        getattr(result, "vertices", None) if taken else chain.vertices
        for chain, result, taken in zip(plan.chains, plan.results, plan.region_check.taken)
    ]
    pairs = [
        pair
        for chain, line in zip(plan.chains, lines)
        for pair in as_pairs(edge_paths.contour_edges(line, chain.closed))
    ]
    inner = set(as_pairs(topology.edges[topology.inner]))
    assert sorted(pair for pair in pairs if pair in inner) == sorted(expected_borders(mesh, new, hidden))
    assert piece_labels(topology, new) == piece_labels(topology, labels)
    assert (new[hidden] == labels[hidden]).all()
    moved = [i for i, taken in enumerate(plan.region_check.taken) if taken]
    assert all(plan.chains[i].edge_count > 1 for i in moved)
    assert set(moved).isdisjoint(plan.region_check.lost)


def test_most_chains_move_and_few_are_refused():
    """Otherwise the tests above would prove little."""
    moved = lost = total = problems = 0
    for _, mesh, labels, hidden in CASES[:8]:
        topology = topology_of(mesh, hidden)
        plan = optimize(mesh, topology, topology_module.label_borders(topology, labels))
        movable = [chain.movable for chain in plan.chains]
        total += sum(movable)
        moved += sum(plan.region_check.taken)
        lost += len(plan.region_check.lost)
        problems += len(plan.problems)
    assert moved > 0.25 * total  # most borders of so many noisy regions are a few edges long
    assert lost + problems < 0.05 * moved


def two_columns():
    """Make a sheet with three regions separated by two straight lines, and their chains."""
    mesh = meshes.polygon_mesh(*open_sheet(6, 11))
    topology = topology_of(mesh)
    column = np.arange(50) % 10
    labels = (column >= 3).astype(int) + (column >= 6)
    borders = topology_module.label_borders(topology, labels)
    return topology, labels, borders, chains_module.find_chains(topology, borders)


def line_at(column):
    return np.arange(6) * 11 + column


def checked(lines):
    """Return which of the lines at columns 3 and 6 may move to the given columns, and the labels along the sheet."""
    topology, labels, borders, chains = two_columns()
    paths = [
        None if lines[chain.vertices[0] % 11] is None else line_at(lines[chain.vertices[0] % 11]) for chain in chains
    ]
    paths = [
        p if p is None or p[0] < chain.vertices[-1] and chain.vertices[0] < 11 else p[::-1]
        for p, chain in zip(paths, chains)
    ]
    region_check = region_check_module.check_regions(topology, borders, chains, paths)
    taken = {int(chain.vertices[0] % 11): t for chain, t in zip(chains, region_check.taken)}
    return taken, region_check.lost, labels[region_check.after].reshape(5, 10)


def test_labels_stay_on_their_side_of_the_line():
    taken, lost, labels = checked({3: 2, 6: 8})
    assert (taken, lost) == ({3: True, 6: True}, {})
    assert (labels == [0, 0, 1, 1, 1, 1, 1, 1, 2, 2]).all()


def test_a_region_that_would_vanish_keeps_its_borders():
    """Both lines on the same edges: the middle region, whose lowest face is the fourth, would be gone."""
    taken, lost, labels = checked({3: 5, 6: 5})
    assert taken == {3: False, 6: False}
    assert set(lost.values()) == {3}
    assert (labels == [0, 0, 0, 1, 1, 1, 2, 2, 2, 2]).all()


def test_lines_that_would_change_places_stay():
    taken, _, labels = checked({3: 8, 6: 2})
    assert taken == {3: False, 6: False}
    assert (labels == [0, 0, 0, 1, 1, 1, 2, 2, 2, 2]).all()


def test_a_line_along_the_border_stays_and_the_other_one_moves():
    taken, lost, labels = checked({3: 0, 6: 7})
    assert taken == {3: False, 6: True}
    assert lost == {0: -1}
    assert (labels == [0, 0, 0, 1, 1, 1, 1, 2, 2, 2]).all()


def test_only_the_line_that_would_split_a_region_stays():
    """The line at column 3 would touch the neighboring border, which would cut a corner off the middle region."""
    topology, labels, borders, chains = two_columns()
    bent = np.array([3, 14, 25, 26, 15, 4, 5, 16, 27, 38, 49, 60])
    paths = [bent if chain.vertices[0] % 11 == 3 else line_at(7) for chain in chains]
    region_check = region_check_module.check_regions(topology, borders, chains, paths)
    assert region_check.taken == [bool(chain.vertices[0] % 11 != 3) for chain in chains]
    assert (labels[region_check.after].reshape(5, 10) == [0, 0, 0, 1, 1, 1, 1, 2, 2, 2]).all()


def test_a_line_that_would_join_regions_stays():
    """The line at column 3 would end inside the sheet."""
    topology, labels, borders, chains = two_columns()
    paths = [line_at(3)[:4] if chain.vertices[0] % 11 == 3 else None for chain in chains]
    region_check = region_check_module.check_regions(topology, borders, chains, paths)
    assert not any(region_check.taken)
    assert list(region_check.lost.values()) == [-1]
    assert (labels[region_check.after] == labels).all()


def taken_ends(plan):
    """Return the end vertices of the chains that move."""
    return sorted(v for v, count in Counter(plan.new_edges().ravel().tolist()).items() if count == 1)


@pytest.mark.parametrize(
    ("faces", "hidden", "end"),
    {
        "nothing hidden": ([], [], 8),
        "at hidden faces": ([], range(15), 6 + 16),
        # The face left of its first edge is split, and the half that touches the end alone is hidden.
        "on the border at a hidden face": ([(5, 6, 21), (6, 22, 21)], [105], 6),
    }.values(),
)
def test_an_end_slides_unless_it_is_next_to_hidden_faces(faces, hidden, end):
    """The line at column 6 moves into the groove at column 8, including its lower end unless that is held."""
    positions, sheet = open_sheet(8, 16)
    sheet = [tuple(face) for face in np.asarray(sheet).tolist()]
    places = [face for face in sheet if not faces or face[0] != 5 or set(face) != {5, 6, 21, 22}]
    mesh = meshes.polygon_mesh(positions, places + faces)
    hidden = [len(places) if faces else face for face in hidden]
    labels = (centers(mesh)[:, 0] >= 6).astype(int)
    topology = topology_of(mesh, hidden)
    plan = optimize(mesh, topology, topology_module.label_borders(topology, labels), width=4, anchor=0.0)
    assert plan.changed
    assert taken_ends(plan)[0] == end


def three_strips():
    """Make a sheet with a groove at column 8, divided by straight lines at columns 6 and 12."""
    mesh = meshes.polygon_mesh(*open_sheet(8, 16))
    column = np.arange(7 * 15) % 15
    topology = topology_of(mesh)
    return mesh, topology, topology_module.label_borders(topology, (column >= 6).astype(int) + (column >= 12))


def test_seams_along_the_border_of_the_mesh_change_nothing():
    mesh, topology, marked = three_strips()
    plan = optimize(mesh, topology, marked, width=4)
    bordered = optimize(mesh, topology, marked | ~topology.inner, width=4)
    assert plan.changed
    assert plan.new_edges().tolist() == bordered.new_edges().tolist()


def test_only_chosen_chains_move():
    """Both chains could move: the line at column 12 is bent by hand first."""
    mesh, topology, marked = three_strips()
    bent = np.array([12, 28, 29, 45, 44, 60, 76, 92, 108, 124])
    straight = topology.find(edge_paths.contour_edges(np.arange(8) * 16 + 12, closed=False))[0]
    marked[straight] = False
    marked[topology.find(edge_paths.contour_edges(bent, closed=False))[0]] = True
    column = topology.edges.min(axis=1) % 16
    moved = []
    for chosen in (marked, marked & (column < 9), marked & (column > 9)):
        plan = optimize(mesh, topology, marked, chosen=chosen, width=4)
        moved.append(sorted({int(v % 16) // 9 for v in plan.old_edges().ravel()}))
    assert moved == [[0, 1], [0], [1]]


class CountingModule:
    """The native module, which notes the searches asked for, and can add contours' errors to what they return."""

    def __init__(self, module, refuse=lambda contour: False):
        self.module, self.refuse, self.calls = module, refuse, []

    def __getattr__(self, name):
        return getattr(self.module, name)

    def optimize_all(self, surface, contours, **more):
        self.calls.append((contours, more))
        found = self.module.optimize_all(surface, contours, **more)
        refused = ValueError("it is not to my liking")
        return [refused if self.refuse(contour) else result for contour, result in zip(contours, found)]


def test_chains_that_cannot_be_searched_are_reported_and_stay(monkeypatch):
    mesh, topology, marked = three_strips()
    counting = CountingModule(networks.native.module(), lambda contour: 12 in contour.vertices % 16)
    monkeypatch.setattr(networks.native, "module", lambda: counting)
    plan = optimize(mesh, topology, marked, width=4)
    assert list(plan.problems.values()) == ["it is not to my liking"]
    assert [bool(12 in chain.vertices % 16) for chain in plan.chains] == [
        not taken for taken in plan.region_check.taken
    ]
    assert [more["errors"] for _, more in counting.calls] == ["return"]


def test_chains_beside_a_refused_one_move_as_if_it_were_a_barrier(monkeypatch):
    """One native call for all; the same as a search of the others with the edges of the refused one as barriers."""
    mesh, topology, marked = three_strips()
    network = chains_module.make_network(topology, marked)
    straight, other = sorted(network.chains, key=lambda chain: 12 in chain.vertices % 16)
    bad = replace(other, vertices=np.append(other.vertices, other.vertices[:1]))  # it passes its first vertex twice
    surface = surface_of(mesh)
    counting = CountingModule(networks.native.module())
    monkeypatch.setattr(networks.native, "module", lambda: counting)
    options = counting.Options(**networks.parameters.network_options(width=8, reach=0.0, min_salience=0.0))
    (result, nothing), problems = networks._search(surface, [straight, bad], options, None)
    assert (nothing, list(problems)) == (None, [1])
    assert problems[1] == networks.messages.problem(counting.check_contour(surface, bad.vertices, closed=False))
    assert len(counting.calls) == 1
    barriers = edge_paths.contour_edges(other.vertices, closed=False)
    (alone,) = counting.module.optimize_all(
        surface, [straight.vertices], closed=False, options=options, barriers=barriers
    )
    assert result.vertices.tolist() == alone.vertices.tolist() != straight.vertices.tolist()
    assert (result.ratio, result.objective) == (alone.ratio, alone.objective)


def test_contours_through_nonmanifold_vertices_are_reported():
    """Two tetrahedra share a vertex on a seam; the seam of a sheet in the same mesh still moves."""
    positions, sheet = open_sheet(8, 16)
    base = len(positions)
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)]
    solids = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3), (0, 4, 5), (0, 6, 4), (0, 5, 6), (4, 6, 5)]
    faces = [tuple(face) for face in np.asarray(sheet).tolist()]
    faces += [tuple(base + v for v in face) for face in solids]
    mesh = meshes.polygon_mesh(np.concatenate([positions, 40.0 + np.array(corners)]), faces)
    topology = topology_of(mesh)
    marked = np.zeros(len(topology.edges), dtype=bool)
    marked[topology.find([(base + 1, base), (base, base + 4)])[0]] = True
    marked[topology.find(edge_paths.contour_edges(np.arange(8) * 16 + 6, closed=False))[0]] = True
    plan = optimize(mesh, topology, marked, width=4)
    assert ["non-manifold" in problem for problem in plan.problems.values()] == [True]
    assert sum(plan.region_check.taken) == 1


def test_a_network_of_single_edges_needs_no_surface():
    mesh = meshes.polygon_mesh(*open_sheet(3, 3))
    topology = topology_of(mesh)
    borders = topology_module.label_borders(topology, np.array([0, 1, 2, 3]))
    plan = networks.optimize(None, chains_module.make_network(topology, borders))
    assert not plan.changed
    assert (len(plan.old_edges()), len(plan.new_edges())) == (0, 0)
