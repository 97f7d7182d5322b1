# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh.optimize_segmentation on simple meshes: labels move with the borders of their regions, and none is lost."""

from collections import Counter

import bmesh
import bpy
import numpy as np
import pytest
from made_meshes import GROOVE, RINGS, SEGMENTS, edit, grooved_cylinder, mesh_object, mesh_state
from minimum_ratio_contours import api
from minimum_ratio_contours.core import native
from minimum_ratio_contours.mesh import segmentation

SOURCES = ("FACE_SETS", "MATERIAL", "ATTRIBUTE")
NAMES = {"FACE_SETS": segmentation.FACE_SETS, "ATTRIBUTE": "Part"}


def ragged(row, seed=3):
    """Return for each face of the cylinder whether it lies above a zigzag around a row of faces."""
    rows = row + np.random.default_rng(seed).integers(-1, 2, SEGMENTS)
    return (np.arange(RINGS - 1)[:, None] >= rows).ravel().astype(int)


def straight(row):
    return np.repeat(np.arange(RINGS - 1) >= row, SEGMENTS).astype(int)


def set_labels(obj, source, labels):
    """Set the labels of the faces, in Object Mode."""
    mesh = obj.data
    if source == "MATERIAL":
        for _ in range(max(labels) + 1):
            mesh.materials.append(bpy.data.materials.new("Part"))
        mesh.polygons.foreach_set("material_index", labels)
    else:
        mesh.attributes.new(NAMES[source], "INT", "FACE").data.foreach_set("value", labels)
    mesh.update()


def get_labels(obj, source):
    """Return the labels, in Edit Mode or Object Mode."""
    bm = bmesh.from_edit_mesh(obj.data) if obj.data.is_editmode else bmesh.new()
    if not obj.data.is_editmode:
        bm.from_mesh(obj.data)
    if source == "MATERIAL":
        return np.array([face.material_index for face in bm.faces])
    layer = bm.faces.layers.int[NAMES[source]]
    return np.array([face[layer] for face in bm.faces])


def run(source, **properties):
    name = {"attribute": NAMES[source]} if source == "ATTRIBUTE" else {}
    return bpy.ops.mesh.optimize_segmentation(source=source, **(name | properties))


def labeled(labels, source="MATERIAL", **more):
    obj = grooved_cylinder(**more)
    set_labels(obj, source, labels)
    edit(obj)
    return obj


@pytest.mark.parametrize("source", SOURCES)
def test_a_ragged_border_moves_into_the_groove(source, last, capfd):
    obj = labeled(ragged(GROOVE - 2), source)
    assert run(source) == {"FINISHED"}
    assert get_labels(obj, source).tolist() == straight(GROOVE).tolist()
    assert last.message.startswith("1 of 1 borders moved: clear boundary, ")
    assert f"Info: {last.message}" in capfd.readouterr().out


@pytest.mark.parametrize("source", SOURCES)
def test_only_the_labels_change(source):
    obj = grooved_cylinder()
    set_labels(obj, source, ragged(GROOVE - 2))
    obj.data.uv_layers.new(name="UVMap")
    obj.data.attributes.new("Other", "INT", "FACE").data.foreach_set("value", range(len(obj.data.polygons)))
    edit(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    before = mesh_state(obj)
    assert run(source) == {"FINISHED"}
    after = mesh_state(obj)
    assert after != before
    assert [after[name] for name in ("vertices", "edges")] == [before[name] for name in ("vertices", "edges")]
    label = ("face", "int", NAMES.get(source))
    assert {key: after["layers"][key] for key in before["layers"] if key != label} == {
        key: values for key, values in before["layers"].items() if key != label
    }
    if source != "MATERIAL":
        assert after["faces"] == before["faces"]


@pytest.mark.parametrize("source", SOURCES)
def test_undo_and_redo(source):
    labeled(ragged(GROOVE - 2), source)
    bpy.ops.ed.undo_push(message="prepared")
    before = mesh_state(bpy.data.objects["Cylinder"])
    name = NAMES.get(source, "")
    assert bpy.ops.mesh.optimize_segmentation("EXEC_DEFAULT", True, source=source, attribute=name) == {"FINISHED"}
    after = mesh_state(bpy.data.objects["Cylinder"])
    assert after != before
    bpy.ops.ed.undo()
    assert mesh_state(bpy.data.objects["Cylinder"]) == before
    bpy.ops.ed.redo()
    assert mesh_state(bpy.data.objects["Cylinder"]) == after


def test_the_same_label_in_several_places():
    """Regions are connected pieces: both borders of the middle one move, and both ends keep their common label."""
    labels = ragged(GROOVE - 2) + ragged(RINGS - 3)
    labels[labels == 2] = 0
    obj = labeled(labels)
    assert run("MATERIAL") == {"FINISHED"}
    after = get_labels(obj, "MATERIAL").reshape(-1, SEGMENTS)
    assert (after[:GROOVE] == 0).all()
    assert (after[GROOVE] == 1).all()
    assert (after[-1] == 0).all()


def test_junctions_of_three_regions_stay():
    column = np.arange(SEGMENTS) < SEGMENTS // 2
    labels = np.where(ragged(GROOVE - 1).reshape(-1, SEGMENTS), 2, column).ravel()
    obj = labeled(labels)
    before = junctions(obj, labels)
    assert run("MATERIAL", min_salience=0.0) == {"FINISHED"}
    after = get_labels(obj, "MATERIAL")
    assert junctions(obj, after) == before
    assert set(after) == {0, 1, 2}


def junctions(obj, labels):
    """Return the vertices at which three or more labels meet."""
    return {
        vertex.index
        for vertex in bmesh.from_edit_mesh(obj.data).verts
        if len({labels[face.index] for face in vertex.link_faces}) > 2
    }


def test_all_objects_in_edit_mode(last):
    objects = [grooved_cylinder("First"), grooved_cylinder("Second")]
    for obj in objects:
        set_labels(obj, "MATERIAL", ragged(GROOVE - 2))
    edit(*objects)
    assert run("MATERIAL") == {"FINISHED"}
    for obj in objects:
        assert get_labels(obj, "MATERIAL").tolist() == straight(GROOVE).tolist()
    assert last.message.startswith("2 of 2 borders moved")


def test_hidden_faces_keep_their_labels():
    obj = labeled(ragged(GROOVE - 2))
    bm = bmesh.from_edit_mesh(obj.data)
    for face in bm.faces:
        if face.index % SEGMENTS < 5:
            face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    before = mesh_state(obj)
    assert run("MATERIAL") == {"FINISHED"}
    after = mesh_state(obj)
    hidden = [i for i, state in enumerate(before["faces"]) if state[-3]]
    assert len(hidden) == 5 * (RINGS - 1)
    assert [after["faces"][i] for i in hidden] == [before["faces"][i] for i in hidden]
    assert after["edges"] == before["edges"]
    labels = np.array([state[-1] for state in after["faces"]]).reshape(-1, SEGMENTS)
    assert (labels[:, 8:-3] == straight(GROOVE).reshape(-1, SEGMENTS)[:, 8:-3]).all()


# ---- nothing to do


def cancelled(obj, source, **properties):
    before = mesh_state(obj)
    assert run(source, **properties) == {"CANCELLED"}
    assert mesh_state(obj) == before


def test_one_region(last):
    obj = grooved_cylinder()
    edit(obj)
    cancelled(obj, "MATERIAL")
    assert last.message.startswith("Nothing to optimize: there are no borders between regions")


def test_no_face_sets(last):
    obj = grooved_cylinder()
    edit(obj)
    cancelled(obj, "FACE_SETS")
    assert last.message == "Left unchanged: there are no face sets: make some in Sculpt Mode, or choose another source"


@pytest.mark.parametrize(("kind", "domain"), [("FLOAT", "FACE"), ("INT", "POINT"), ("BOOLEAN", "FACE"), (None, "")])
def test_an_attribute_that_is_not_an_integer_face_attribute(kind, domain, last):
    obj = grooved_cylinder()
    if kind:
        obj.data.attributes.new("Part", kind, domain)
    edit(obj)
    cancelled(obj, "ATTRIBUTE")
    assert "no integer face attribute 'Part'" in last.message


def test_an_attribute_without_a_name(last):
    obj = grooved_cylinder()
    edit(obj)
    cancelled(obj, "ATTRIBUTE", attribute="")
    assert "choose an integer attribute" in last.message


def test_an_object_without_labels_is_named_and_the_other_is_optimized(last):
    first, second = grooved_cylinder("First"), grooved_cylinder("Second")
    set_labels(first, "FACE_SETS", ragged(GROOVE - 2))
    edit(first, second)
    before = mesh_state(second)
    assert run("FACE_SETS") == {"FINISHED"}
    assert "Second: there are no face sets" in last.message
    assert mesh_state(second) == before


def test_missing_labels_are_reported_once_and_not_for_objects_without_faces(last):
    edit(grooved_cylinder("First"), grooved_cylinder("Second"), mesh_object("Points", [(0, 0, 0)]))
    assert run("FACE_SETS") == {"CANCELLED"}
    assert last.message.startswith("Left unchanged: there are no face sets")
    assert last.message.count("face sets") == 1
    assert "Points" not in last.message


def test_a_border_that_is_already_optimal(last):
    obj = labeled(straight(GROOVE))
    before = mesh_state(obj)
    assert run("MATERIAL") == {"FINISHED"}  # finished, so that the redo panel can change the settings
    assert mesh_state(obj) == before
    assert last.message.startswith("No better position was found for the borders: already the best nearby")


def test_an_empty_mesh():
    obj = mesh_object("Empty", [])
    edit(obj)
    cancelled(obj, "MATERIAL")


def test_object_mode_is_refused():
    grooved_cylinder()
    with pytest.raises(RuntimeError, match="Edit Mode"):
        run("MATERIAL")


def test_the_library_missing(monkeypatch):
    obj = labeled(ragged(GROOVE - 2))
    before = mesh_state(obj)
    monkeypatch.setattr(native, "VERSION", "0.0.1")
    with pytest.raises(RuntimeError, match="restart Blender"):
        run("MATERIAL")
    assert mesh_state(obj) == before


# ---- scripts


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("source", SOURCES)
def test_api(source, mode):
    obj = labeled(ragged(GROOVE - 2), source)
    bpy.ops.object.mode_set(mode=mode)
    where = {"attribute": "Part"} if source == "ATTRIBUTE" else {"source": source}
    (result,) = api.optimize_segmentation(obj, **where)
    assert result.status == "improved"
    assert get_labels(obj, source).tolist() == ragged(GROOVE - 2).tolist()
    api.optimize_segmentation(obj, apply=True, **where)
    assert get_labels(obj, source).tolist() == straight(GROOVE).tolist()


def test_api_names_what_is_missing():
    obj = grooved_cylinder()
    with pytest.raises(ValueError, match="no face sets"):
        api.optimize_segmentation(obj)
    with pytest.raises(ValueError, match="MATERIALS"):
        api.optimize_segmentation(obj, source="MATERIALS")


# ---- random labels


def random_labels(rng, obj):
    centers = np.array([face.center for face in obj.data.polygons])
    seeds = centers[rng.choice(len(centers), int(rng.integers(2, 12)), replace=False)]
    distances = np.linalg.norm(centers[:, None] - seeds, axis=2) * rng.uniform(1, 1.25, (len(centers), len(seeds)))
    return np.argmin(distances, axis=1)


def random_body(rng):
    add = [
        lambda: bpy.ops.mesh.primitive_torus_add(major_segments=28, minor_segments=12),
        lambda: bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4),
        lambda: bpy.ops.mesh.primitive_grid_add(x_subdivisions=16, y_subdivisions=20),
        lambda: grooved_cylinder(depth=0.3),
    ][rng.integers(4)]
    add()
    obj = bpy.context.view_layer.objects.active
    for vertex, shift in zip(obj.data.vertices, rng.normal(0, 0.02, (len(obj.data.vertices), 3))):
        vertex.co = [c + s for c, s in zip(vertex.co, shift)]
    return obj


def pieces(obj, labels):
    """Return for each label its number of connected pieces of visible faces."""
    bm = bmesh.from_edit_mesh(obj.data)
    pending, count = {face for face in bm.faces if not face.hide}, Counter()
    while pending:
        reached = [pending.pop()]
        label = labels[reached[0].index]
        count[int(label)] += 1
        while reached:
            around = {f for edge in reached.pop().edges for f in edge.link_faces if labels[f.index] == label} & pending
            pending -= around
            reached += around
    return count


@pytest.mark.parametrize("seed", range(30))
def test_no_label_is_lost_and_no_region_is_split(seed):
    rng = np.random.default_rng(seed)
    obj = random_body(rng)
    source = SOURCES[seed % 3]
    labels = random_labels(rng, obj)
    set_labels(obj, source, labels)
    edit(obj)
    if seed % 4 == 3:
        bm = bmesh.from_edit_mesh(obj.data)
        for face in bm.faces:
            if rng.random() < 0.02:
                face.hide_set(True)
        bmesh.update_edit_mesh(obj.data)
    before, regions = mesh_state(obj), pieces(obj, labels)
    ran = run(source, width=int(rng.integers(1, 6)), min_salience=0.0)
    after, new = mesh_state(obj), get_labels(obj, source)
    assert (after != before) == (ran == {"FINISHED"})
    assert (new != labels).any() == (ran == {"FINISHED"})
    assert pieces(obj, new) == regions
    assert after["edges"] == before["edges"]
    hidden = [face.hide for face in bmesh.from_edit_mesh(obj.data).faces]
    assert (new[hidden] == labels[hidden]).all()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not obj.data.validate(verbose=True)
