# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh.optimize_contour on random meshes, selections and settings: the mesh stays valid whatever happens."""

from collections import Counter

import bmesh
import bpy
import numpy as np
import pytest
from contour_shapes import add_attributes, edges_by_ends, rough_plate, rough_sphere
from made_meshes import OUTPUTS, but_selection, edit, grooved_cylinder, mesh_state

CASES, CHUNK = 500, 25
ALONG_EDGES = ("SELECT", "SEAM", "SHARP", "CUT")
counts = Counter()


@pytest.mark.parametrize("first", range(0, CASES, CHUNK))
def test_random_runs(first):
    for seed in range(first, first + CHUNK):
        clear()
        try:
            check_run(np.random.default_rng(seed))
        except Exception as error:
            raise AssertionError(f"with seed {seed}") from error


def test_the_random_runs_had_every_outcome():
    """Otherwise the test above would prove little. Canceled runs count, too."""
    if sum(counts.values()) < CASES:
        pytest.skip("not all runs were made")
    for output in OUTPUTS:
        for refined in (False, True):
            assert counts[output, refined, "FINISHED"] >= 10
            assert counts[output, refined, "CANCELLED"] >= 5


def clear():
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])


def check_run(rng):
    obj = random_mesh(rng)
    edit(obj, mode=str(rng.choice(["VERTEX", "EDGE", "EDGE", "FACE", "FACE"])))
    hide_some(obj, rng)
    select_some(obj, rng)
    settings = random_settings(rng)
    bpy.ops.ed.undo_push(message="before")
    before, hidden = mesh_state(obj), hidden_shapes(obj)
    name = obj.name
    (status,) = bpy.ops.mesh.optimize_contour("EXEC_DEFAULT", True, **settings)
    obj = bpy.data.objects[name]
    after = mesh_state(obj)
    counts[settings["output"], settings["refinement"] > 0, status] += 1
    if status == "CANCELLED":
        assert but_selection(after) == but_selection(before)
        assert len(bpy.data.objects) == 1
        return
    assert hidden_shapes(obj) == hidden
    check_sound(obj)
    if settings["output"] in ALONG_EDGES and settings["refinement"] == 0:
        assert without_marks(after) == without_marks(before)
    if settings["output"] != "SEPARATE":
        assert not vertex_rows(before) - vertex_rows(after)
    bpy.ops.ed.undo()
    assert mesh_state(bpy.data.objects[name]) == before
    assert len(bpy.data.objects) == 1


def random_mesh(rng):
    seed = int(rng.integers(1000))
    make = [
        lambda: grooved_cylinder(grooves=(5, 14)),
        lambda: rough_sphere(seed, dissolve=float(rng.choice([0.0, 0.5])), bumps=0.3, subdivisions=2),
        lambda: rough_plate(seed),
    ]
    obj = make[rng.integers(3)]()
    obj.data.use_mirror_x = bool(rng.random() < 0.2)
    if rng.random() < 0.5:
        add_attributes(obj, lambda points: 0.5 + points @ np.array([0.1, -0.1, 0.1]))
        obj.active_shape_key_index = int(rng.integers(2))
    return obj


def hide_some(obj, rng):
    bm = bmesh.from_edit_mesh(obj.data)
    if rng.random() < 0.3:
        for face in blob(bm, rng, 12):
            face.hide_set(True)
    if rng.random() < 0.2:  # a fin: an edge of three faces, and a loose edge at its tip
        edge = some(bm.edges, rng)
        if not edge.hide:
            tip = bm.verts.new(edge.verts[0].co * 1.5)
            end = bm.verts.new(edge.verts[0].co * 1.7)
            bm.faces.new([*edge.verts, tip])
            bm.edges.new([tip, end])
    bm.normal_update()
    bmesh.update_edit_mesh(obj.data)


def select_some(obj, rng):
    bm = bmesh.from_edit_mesh(obj.data)
    for _ in range(rng.integers(1, 3)):
        kind = rng.random()
        if kind < 0.7 or bm.select_mode == {"FACE"}:
            select_region(bm, set(blob(bm, rng, int(rng.integers(4, 150)))))
        elif kind < 0.95:
            select_walk(bm, rng)
        else:
            some(bm.edges, rng).select_set(True)
    for kind in (bm.verts, bm.edges, bm.faces):  # Edit Mode has nothing hidden selected
        for element in kind:
            if element.hide:
                element.select_set(False)
    bm.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)


def select_region(bm, faces):
    """Select a region in face mode, otherwise its border."""
    if bm.select_mode == {"FACE"}:
        for face in faces:
            face.select_set(not face.hide)
        return
    for edge in {edge for face in faces for edge in face.edges}:
        if len(faces.intersection(edge.link_faces)) == 1 and not edge.hide and not edge.is_boundary:
            edge.select_set(True)


def select_walk(bm, rng):
    """Select a chain that continues as straight as possible."""
    vertex, direction = some(bm.verts, rng), rng.normal(size=3)
    for _ in range(int(rng.integers(2, 30))):
        edges = [edge for edge in vertex.link_edges if not edge.select and not edge.hide]
        if not edges:
            return
        steps = [np.subtract(edge.other_vert(vertex).co, vertex.co) for edge in edges]
        best = int(np.argmax([step @ direction / np.linalg.norm(step) for step in steps]))
        edges[best].select_set(True)
        vertex, direction = edges[best].other_vert(vertex), steps[best]


def some(elements, rng):
    elements.ensure_lookup_table()
    return elements[int(rng.integers(len(elements)))]


def blob(bm, rng, size):
    """Return about so many faces around one face, nearest first."""
    center = np.array(some(bm.faces, rng).calc_center_median())
    by_distance = sorted(bm.faces, key=lambda face: np.sum((np.array(face.calc_center_median()) - center) ** 2))
    return by_distance[: int(size * rng.uniform(0.8, 1.2))]


def random_settings(rng):
    return {
        "output": str(rng.choice(OUTPUTS)),
        "refinement": int(rng.choice([0, 0, 1, 2])),
        "merge": float(rng.choice([0.0, 0.1, 0.4])),
        "fill_holes": bool(rng.random() < 0.5),
        "keep_old": bool(rng.random() < 0.5),
        "ends": str(rng.choice(["AUTO", "EDGES", "VERTICES", "BORDER"])),
        "width": int(rng.integers(1, 6)),
        "min_salience": float(rng.choice([0.0, 0.0, 0.0, 0.25])),
        "length_bias": float(rng.choice([0.0, 0.0, 2.0])),
        "anchor": float(rng.choice([0.0, 0.0, 0.5])),
        "flow": str(rng.choice(["HARMONIC", "GATES", "ARC_LENGTH"])),
    }


def check_sound(obj):
    bm = bmesh.from_edit_mesh(obj.data)
    assert max(edges_by_ends(bm).values()) == 1
    assert min(face.calc_area() for face in bm.faces) > 1e-8
    assert not any(element.select and element.hide for kind in (bm.verts, bm.edges, bm.faces) for element in kind)
    obj.update_from_editmode()
    for mesh in [other.data for other in bpy.data.objects]:
        assert not mesh.copy().validate(verbose=True)


def hidden_shapes(obj):
    """Return the positions of hidden elements, whose ids may change."""
    bm = bmesh.from_edit_mesh(obj.data)
    return Counter(tuple(tuple(vertex.co) for vertex in face.verts) for face in bm.faces if face.hide)


def without_marks(state):
    """Return the state of a mesh without selection, seams and sharp edges."""
    return (
        [(co, hide) for co, _, hide in state["vertices"]],
        [(a, b, hide) for a, b, _, hide, _, _ in state["edges"]],
        [(*face[:-4], *face[-3:]) for face in state["faces"]],
        state["layers"],
    )


def vertex_rows(state):
    """Return the vertices with the values of all layers, independent of their ids."""
    layers = [values for (domain, _, _), values in state["layers"].items() if domain == "vertex"]
    return Counter(zip((co for co, _, _ in state["vertices"]), *layers))
