# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams and region borders across faces are cut into the mesh, and labels and islands are preserved."""

from collections import Counter

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import (
    GROOVE,
    RINGS,
    SEGMENTS,
    edit,
    mark_edges,
    marked_edges,
    mesh_state,
    pairs,
    rough_loop,
    select,
)
from minimum_ratio_contours import api
from minimum_ratio_contours.core import parameters
from minimum_ratio_contours.mesh.arrays import synchronize
from test_optimize_seams import hide_some, islands, random_seams
from test_optimize_segmentation import NAMES, SOURCES, get_labels, pieces, ragged, random_labels, set_labels
from test_optimize_segmentation import random_body as any_body
from test_outputs import custom_normal, normals_of, tilted_cylinder, with_custom_normals

REFINED = {"refinement": 2, "min_salience": 0.0}
RATIO_ALONE = {"min_salience": 0.0, "length_bias": 0.0, "anchor": 0.0}


def where(source):
    return {"source": source} | ({"attribute": NAMES[source]} if source == "ATTRIBUTE" else {})


def segment(source="MATERIAL", **settings):
    return bpy.ops.mesh.optimize_segmentation(**where(source), **(REFINED | settings))


def labeled_tilted(labels=None, source="MATERIAL"):
    obj = tilted_cylinder()
    set_labels(obj, source, ragged(GROOVE - 2) if labels is None else labels)
    edit(obj)
    return obj


def three_labels():
    column = np.arange(SEGMENTS) < SEGMENTS // 2
    return np.where(ragged(GROOVE - 1).reshape(-1, SEGMENTS), 2, column).ravel()


def points_and_label(obj, labels, chosen):
    """Return the corner positions and label of some faces, which identify them after a cut."""
    bm = bmesh.from_edit_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    return Counter((tuple(tuple(v.co) for v in bm.faces[i].verts), int(labels[i])) for i in chosen)


def is_valid(obj):
    bpy.ops.object.mode_set(mode="OBJECT")
    return not obj.data.validate(verbose=True)


# ---- segmentation


@pytest.mark.parametrize("source", SOURCES)
def test_a_border_across_faces_is_cut_and_the_labels_follow(source, last):
    obj = labeled_tilted(source=source)
    count = len(obj.data.polygons)
    (result,) = api.optimize_segmentation(obj, **where(source), **REFINED)
    assert (result.vertices < 0).any()
    assert segment(source) == {"FINISHED"}
    bm = bmesh.from_edit_mesh(obj.data)
    labels = get_labels(obj, source)
    assert len(labels) > count
    border = np.array([v.co for v in bm.verts if len({labels[f.index] for f in v.link_faces}) == 2])
    assert np.linalg.norm(border[:, None] - result.positions, axis=2).min(axis=1).max() < 1e-6
    assert pieces(obj, labels) == {0: 1, 1: 1}
    assert last.message.startswith("1 of 1 borders moved: clear boundary, ")


def test_a_border_along_edges_cuts_nothing():
    obj = labeled_tilted()
    before = mesh_state(obj)
    assert segment(refinement=0, merge=0.3) == {"FINISHED"}
    after = mesh_state(obj)
    assert [after[kind] for kind in ("vertices", "edges")] == [before[kind] for kind in ("vertices", "edges")]


def test_undo_and_redo_of_a_segmentation():
    labeled_tilted(three_labels())
    bpy.ops.ed.undo_push(message="prepared")
    before = mesh_state(bpy.data.objects["Cylinder"])
    assert bpy.ops.mesh.optimize_segmentation("EXEC_DEFAULT", True, source="MATERIAL", **REFINED) == {"FINISHED"}
    after = mesh_state(bpy.data.objects["Cylinder"])
    assert len(after["faces"]) > len(before["faces"])
    bpy.ops.ed.undo()
    assert mesh_state(bpy.data.objects["Cylinder"]) == before
    bpy.ops.ed.redo()
    assert mesh_state(bpy.data.objects["Cylinder"]) == after


@pytest.mark.parametrize("source", SOURCES)
def test_faces_that_no_border_crosses_stay_as_they_are(source):
    obj = labeled_tilted(three_labels(), source)
    labels = get_labels(obj, source)
    results = api.optimize_segmentation(obj, **where(source), **REFINED)
    uncut = np.setdiff1d(np.arange(len(labels)), touched(obj, results))
    before = points_and_label(obj, np.zeros(len(labels)), uncut)
    far = [
        i for i in uncut if abs(i // SEGMENTS - GROOVE) > 8 and not 14 <= i % SEGMENTS <= 17 and 1 < i % SEGMENTS < 30
    ]
    far_labels = points_and_label(obj, labels, far)
    assert segment(source) == {"FINISHED"}
    new = get_labels(obj, source)
    assert before - points_and_label(obj, np.zeros(len(new)), range(len(new))) == Counter()
    assert len(far) > 20
    assert far_labels - points_and_label(obj, new, range(len(new))) == Counter()


def touched(obj, results):
    """Return the faces that contours cross, or whose side they touch, which adds a corner."""
    edges = {tuple(pair) for result in results for pair in np.sort(result.edge_vertices).tolist()}
    crossed = [face for result in results for face in result.segment_faces]
    return sorted({*crossed, *(face.index for face in obj.data.polygons if edges & set(face.edge_keys))})


def test_two_runs_give_the_same_result():
    found = []
    for _ in range(2):
        obj = labeled_tilted(three_labels())
        segment()
        found.append(mesh_state(obj))
    assert found[0] == found[1]


@pytest.mark.parametrize("source", SOURCES)
def test_scripts_in_object_mode_get_the_same_as_in_edit_mode(source):
    found = []
    for mode in ("OBJECT", "EDIT"):
        obj = tilted_cylinder()
        obj.data.uv_layers.new(name="UVMap")  # not in Edit Mode, where it takes Blender 5.1.2 down
        set_labels(obj, source, three_labels())
        edit(obj)
        bpy.ops.object.mode_set(mode=mode)
        results = api.optimize_segmentation(obj, apply=True, merge=0.1, **where(source), **REFINED)
        assert any((result.vertices < 0).any() for result in results)
        bpy.ops.object.mode_set(mode="EDIT")
        found.append(mesh_state(obj))
    assert found[0] == found[1]


def test_shape_keys_survive_a_cut_in_object_mode():
    obj = tilted_cylinder()
    set_labels(obj, "MATERIAL", ragged(GROOVE - 2))
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Taller")
    for point in obj.data.shape_keys.key_blocks["Taller"].data:
        point.co.z *= 2
    api.optimize_segmentation(obj, "MATERIAL", apply=True, **REFINED)
    taller = obj.data.shape_keys.key_blocks["Taller"].data
    assert len(taller) == len(obj.data.vertices) > RINGS * SEGMENTS
    for point, vertex in zip(taller, obj.data.vertices):
        assert point.co.z == pytest.approx(2 * vertex.co.z, abs=1e-5)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_custom_normals_survive_a_cut(mode):
    obj = with_custom_normals(tilted_cylinder)
    set_labels(obj, "MATERIAL", ragged(GROOVE - 2))
    edit(obj)
    bpy.ops.object.mode_set(mode=mode)
    count = len(obj.data.loops)
    api.optimize_segmentation(obj, "MATERIAL", apply=True, **REFINED)
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = obj.data
    assert len(mesh.loops) > count
    assert not [layer.name for layer in mesh.attributes if "contours" in layer.name]
    expected = [custom_normal(mesh.vertices[loop.vertex_index].co) for loop in mesh.loops]
    assert np.degrees(np.arccos(np.clip((normals_of(mesh) * expected).sum(1), -1, 1))).max() < 1.0


def test_across_faces_the_mean_ratio_is_not_above_that_along_edges():
    obj = labeled_tilted(three_labels())
    ratios = []
    for refinement in (0, 2):
        results = api.optimize_segmentation(obj, "MATERIAL", refinement=refinement, iterations=4, **RATIO_ALONE)
        assert len(results) == 4
        ratios.append(np.mean([result.ratio for result in results]))
    assert ratios[1] <= ratios[0]


# ---- random labels and seams


def new_vertices(obj, before):
    """Return the vertices that a cut has added."""
    known = {place for place, *_ in before["vertices"]}
    return [vertex for vertex in bmesh.from_edit_mesh(obj.data).verts if tuple(vertex.co) not in known]


def divides(vertex, label):
    """Whether a vertex lies between regions or on the border of the visible mesh, where a contour may run."""
    ends = vertex.is_boundary or any(face.hide for face in vertex.link_faces)
    return ends or len(set(map(label, vertex.link_faces))) > 1


@pytest.mark.parametrize("seed", range(40))
def test_no_label_is_lost_and_no_region_is_split(seed):
    rng = np.random.default_rng(seed)
    obj = any_body(rng)
    source = SOURCES[seed % 3]
    labels = random_labels(rng, obj)
    set_labels(obj, source, labels)
    edit(obj)
    if seed % 4 == 3:
        hide_some(rng, obj)
    select(obj, [])
    before, regions = mesh_state(obj), pieces(obj, labels)
    hidden = [i for i, face in enumerate(bmesh.from_edit_mesh(obj.data).faces) if face.hide]
    hidden_before = points_and_label(obj, labels, hidden)
    settings = {"width": int(rng.integers(1, 6)), "merge": float(rng.choice([0, 0.1, 0.5]))}
    settings = REFINED | settings | {"refinement": int(rng.integers(1, 4))}
    results = api.optimize_segmentation(obj, **where(source), **settings)
    ran = segment(source, **settings)
    after, new = mesh_state(obj), get_labels(obj, source)
    assert (after != before) == (ran == {"FINISHED"})
    assert pieces(obj, new) == regions
    divided = {tuple(v.co) for v in bmesh.from_edit_mesh(obj.data).verts if divides(v, lambda face: new[face.index])}
    for result in results:  # contours that count as moved lie between regions now
        assert {before["vertices"][vertex][0] for vertex in result.vertices[result.vertices >= 0]} <= divided
    assert {tuple(vertex.co) for vertex in new_vertices(obj, before)} <= divided  # nothing else is cut
    faces = bmesh.from_edit_mesh(obj.data).faces
    assert points_and_label(obj, new, [i for i, face in enumerate(faces) if face.hide]) == hidden_before
    assert is_valid(obj)


@pytest.mark.parametrize("seed", range(40))
def test_the_number_of_islands_is_preserved(seed):
    rng = np.random.default_rng(seed)
    obj = any_body(rng)
    edit(obj)
    if seed % 4 == 3:
        hide_some(rng, obj)
    mark_edges(obj, random_seams(rng, obj), "seam")
    chosen = bool(seed % 2)
    if chosen:
        shown = {frozenset(state[:2]) for state in mesh_state(obj)["edges"] if not state[3]}
        select(obj, [pair for pair in sorted(map(sorted, marked_edges(obj, "seam") & shown)) if rng.random() < 0.9])
    before, count = mesh_state(obj), islands(obj)
    settings = {"width": int(rng.integers(1, 6)), "merge": float(rng.choice([0, 0.1, 0.5])), "selected_only": chosen}
    ran = bpy.ops.mesh.optimize_seams(**(REFINED | settings))
    assert (mesh_state(obj) != before) == (ran == {"FINISHED"})
    assert islands(obj) == count
    assert all(any(edge.seam for edge in vertex.link_edges) for vertex in new_vertices(obj, before))
    assert is_valid(obj)


# ---- seams


def tilted_seam():
    obj = tilted_cylinder()
    edit(obj)
    mark_edges(obj, pairs(rough_loop(GROOVE - 3)), "seam")
    return obj


@pytest.mark.parametrize("selected", [False, True])
def test_a_seam_moves_onto_the_cut_and_the_selection_with_it(selected, last):
    obj = tilted_seam()
    if selected:
        select(obj, pairs(rough_loop(GROOVE - 3)))
    edges = len(obj.data.edges)
    assert bpy.ops.mesh.optimize_seams(selected_only=selected, **REFINED) == {"FINISHED"}
    bm = bmesh.from_edit_mesh(obj.data)
    assert len(bm.edges) > edges
    seam = [edge for edge in bm.edges if edge.seam]
    assert set(Counter(v for edge in seam for v in edge.verts).values()) == {2}
    assert [edge.select for edge in bm.edges] == [selected and edge.seam for edge in bm.edges]
    assert islands(obj) == 2
    assert last.message.startswith("1 of 1 seams moved")


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_scripts_cut_seams(mode):
    obj = tilted_seam()
    bpy.ops.object.mode_set(mode=mode)
    (result,) = api.optimize_seams(obj, apply=True, **REFINED)
    synchronize(obj)
    seam = {v for edge in obj.data.edges if edge.use_seam for v in edge.vertices}
    distances = np.linalg.norm(
        np.array([obj.data.vertices[v].co for v in seam])[:, None] - result.positions[None], axis=2
    )
    assert distances.min(axis=1).max() < 1e-5


def test_a_search_without_apply_does_not_change_the_mesh():
    obj = tilted_seam()
    before = mesh_state(obj)
    api.optimize_seams(obj, **REFINED)
    assert mesh_state(obj) == before
    assert [mesh.name for mesh in bpy.data.meshes] == [obj.data.name]


def test_the_panel_has_the_settings_of_optimize_contour():
    for operator in (bpy.ops.mesh.optimize_seams, bpy.ops.mesh.optimize_segmentation):
        properties = operator.get_rna_type().properties
        for name in ("refinement", "regular_iterations"):
            assert properties[name].default == parameters.SETTINGS[name]["default"]
