# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults of a mesh are named, with their places, and of a sound mesh none is."""

import importlib
import sys
from pathlib import Path
from types import SimpleNamespace

import meshes
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
faults = importlib.import_module("addon.core.mesh_faults")

COLUMNS, ROWS = 12, 15


def tube():
    mesh = meshes.tube(1 - 0.3 * np.exp(-((np.arange(ROWS) - 7.0) ** 2)), COLUMNS)
    return mesh.positions, [list(face) for face in mesh.faces]


def ring(row):
    return COLUMNS * row + np.arange(COLUMNS)


def arrays(positions, faces):
    counts = [len(face) for face in faces]
    return SimpleNamespace(
        positions=np.asarray(positions, dtype=float),
        face_offsets=np.cumsum([0, *counts]).astype(np.int32),
        face_vertices=np.concatenate(faces).astype(np.int32),
    )


def ids(fault):
    return [one for _, one in fault.elements]


def exploded(positions, faces):
    """Every face with vertices of its own, as in an STL file."""
    corners = np.concatenate(faces)
    ends = np.cumsum([0, *(len(face) for face in faces)])
    return positions[corners], [list(range(*pair)) for pair in zip(ends[:-1], ends[1:], strict=True)], corners


@pytest.mark.parametrize("row", [0, 1, 4, ROWS - 1])
def test_a_sound_mesh_has_none_even_beside_its_border(row):
    assert faults.fault_near(arrays(*tube()), ring(row)) is None
    for mesh in (meshes.icosphere(1), meshes.torus(6, 9), meshes.square_prism(3, 4)):
        assert faults.fault_near(arrays(mesh.positions, mesh.faces), [0, 5]) is None


def test_faces_with_vertices_of_their_own_are_not_joined():
    positions, faces, corners = exploded(*tube())
    given = np.flatnonzero(np.isin(corners, ring(5)))
    fault = faults.fault_near(arrays(positions, faces), given)
    assert (str(fault), fault.code) == (faults.NOT_JOINED, "not_joined")
    assert set(given) <= set(ids(fault))


@pytest.mark.parametrize("shift", [0.0, 1e-6, -1e-6])
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_a_split_is_one_at_any_size_and_with_rounding(scale, shift):
    positions, faces = tube()
    split = {vertex: len(positions) + i for i, vertex in enumerate(ring(6).tolist())}
    faces = [[split.get(v, v) if min(face) >= ring(6)[0] else v for v in face] for face in faces]
    positions = np.concatenate([positions, positions[ring(6)] + [0, 0, shift]]) * scale
    fault = faults.fault_near(arrays(positions, faces), ring(6))
    assert fault.code == "not_joined"
    assert set(ids(fault)) >= {*split, *split.values()}
    assert faults.fault_near(arrays(positions, faces), ring(3)) is None


def test_a_chain_whose_ends_lie_at_one_place_is_a_loop_on_a_split_mesh():
    positions, faces = tube()
    mesh = arrays(np.concatenate([positions, positions[ring(5)[:1]]]), faces)
    assert ids(faults.ends_not_joined(mesh, [*ring(5), len(positions)])) == [ring(5)[0], len(positions)]
    assert faults.ends_not_joined(mesh, ring(5)) is None


@pytest.mark.parametrize("turned", [False, True])
def test_of_faces_on_the_same_vertices_one_each_is_to_be_deleted(turned):
    positions, faces = tube()
    copies = [face[::-1] if turned else face[2:] + face[:2] for face in faces]
    fault = faults.fault_near(arrays(positions, faces + copies), ring(5))
    assert (str(fault), fault.code) == (faults.DOUBLED, "doubled")
    assert ids(fault) == list(range(len(faces), 2 * len(faces)))
    assert {kind for kind, _ in fault.elements} == {"face"}


def test_walls_inside_and_fins_are_edges_of_more_than_two_faces():
    positions, faces = tube()
    walled = arrays(positions, [*faces, ring(6).tolist()])
    fault = faults.fault_near(walled, ring(6))
    assert (str(fault), fault.code) == (faults.WALLED, "walled")
    assert sorted(ids(fault)) == sorted(tuple(sorted(pair)) for pair in zip(ring(6), np.roll(ring(6), -1), strict=True))
    assert faults.fault_near(walled, ring(5)).code == "walled"
    assert faults.fault_near(walled, ring(3)) is None


def test_flipped_normals_are_edges_whose_faces_disagree():
    positions, faces = tube()
    upper = [face[::-1] if min(face) >= ring(6)[0] else face for face in faces]
    fault = faults.fault_near(arrays(positions, upper), ring(6))
    assert (str(fault), fault.code) == (faults.FLIPPED, "flipped")
    assert len(fault.elements) == COLUMNS
    one = [face[::-1] if i == 6 * COLUMNS + 3 else face for i, face in enumerate(faces)]
    assert len(faults.fault_near(arrays(positions, one), ring(6)).elements) == 4


def bow_tie(row):
    """A vertex of this ring is also the tip of a tetrahedron."""
    positions, faces = tube()
    tip, n = int(ring(row)[4]), len(positions)
    outward = positions[tip] + np.array([[0.4, 0, 0.1], [0.4, 0.2, -0.1], [0.4, -0.2, -0.1]])
    cone = [[tip, n, n + 1], [tip, n + 1, n + 2], [tip, n + 2, n], [n, n + 2, n + 1]]
    return np.concatenate([positions, outward]), faces + cone, tip


def test_a_vertex_at_which_faces_meet_in_a_point_is_named_one_ring_away_too():
    positions, faces, tip = bow_tie(6)
    for row in (6, 5, 7):
        fault = faults.fault_near(arrays(positions, faces), ring(row))
        assert (str(fault), fault.code) == (faults.PINCHED, "pinched")
        assert fault.elements == (("vertex", tip),)
    assert faults.fault_near(arrays(positions, faces), ring(3)) is None


def test_two_borders_that_touch_in_a_vertex_are_a_pinch():
    positions, faces = tube()
    kept = [face for i, face in enumerate(faces) if i not in (5 * COLUMNS + 3, 6 * COLUMNS + 4)]
    fault = faults.fault_near(arrays(positions, kept), ring(6))
    assert fault.elements == (("vertex", int(ring(6)[4])),)


def test_every_cure_is_one_sentence_that_names_a_command():
    for text in (faults.NOT_JOINED, faults.DOUBLED, faults.WALLED, faults.FLIPPED, faults.PINCHED):
        assert ". " not in text
        assert "(" in text or " > " in text
