# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes of every type that this Blender has, on every domain, through every output.

A crash ends Blender here, so that no report is written and the exit status is not 0: the run fails. The test that was
running is the last line of the log.
"""

import bpy
import numpy as np
import pytest
from made_meshes import GROOVE, RINGS, SEGMENTS, START, edit, mark_edges, mesh_state, pairs, run, select
from minimum_ratio_contours import api
from test_optimize_segmentation import ragged, set_labels
from test_outputs import REFINED, tilted_cylinder, with_custom_normals

GROUP = bpy.types.Mesh.bl_rna.properties["attributes"].srna  # its class has another name since 4.3
TYPES = GROUP.functions["new"].parameters["type"].enum_items.keys()
DOMAINS = ("POINT", "EDGE", "FACE", "CORNER")
STEP = 2 * np.pi / SEGMENTS


def contour(**settings):
    select(bpy.context.object, pairs(START))
    return lambda: run(**settings)


def seams():
    mark_edges(bpy.context.object, pairs(START), "seam")
    return lambda: bpy.ops.mesh.optimize_seams(**REFINED)


def segmentation(mode="EDIT"):
    obj = bpy.context.object
    bpy.ops.object.mode_set(mode="OBJECT")
    set_labels(obj, "MATERIAL", ragged(GROOVE - 2))
    bpy.ops.object.mode_set(mode=mode)
    if mode == "OBJECT":
        return lambda: api.optimize_segmentation(obj, "MATERIAL", apply=True, **REFINED) and {"FINISHED"}
    return lambda: bpy.ops.mesh.optimize_segmentation(source="MATERIAL", **REFINED)


COMMANDS = {
    "select": lambda: contour(output="SELECT"),
    "seam": lambda: contour(output="SEAM", **REFINED),
    "sharp": lambda: contour(output="SHARP", **REFINED),
    "cut": lambda: contour(output="CUT", **REFINED),
    "cut and merge": lambda: contour(output="CUT", merge=0.35, **REFINED),
    "rip": lambda: contour(output="RIP", **REFINED),
    "rip along edges": lambda: contour(output="RIP"),
    "rip and fill": lambda: contour(output="RIP", fill_holes=True, **REFINED),
    "separate": lambda: contour(output="SEPARATE", **REFINED),
    "separate and fill": lambda: contour(output="SEPARATE", fill_holes=True, **REFINED),
    "seams": seams,
    "segmentation": segmentation,
    "segmentation in Object Mode": lambda: segmentation("OBJECT"),
}


def field(attribute):
    """Return the name and width of the property that holds the values."""
    properties = attribute.data[0].bl_rna.properties
    name = next(name for name in ("value", "vector", "color") if name in properties)
    return name, max(1, getattr(properties[name], "array_length", 1))


def add(mesh, kind, domain):
    """Add an attribute that differs from element to element, with values from 0 to 1 or, as integers, to 99."""
    attribute = mesh.attributes.new(f"{kind} {domain}", kind, domain)
    name, width = field(attribute)
    numbers = np.arange(len(attribute.data) * width) * 37
    if kind == "STRING":
        encode = str if isinstance(attribute.data[0].value, str) else str.encode
        for item, number in zip(attribute.data, numbers):
            item.value = encode(str(number % 100))
    elif kind == "BOOLEAN":
        attribute.data.foreach_set(name, numbers % 3 == 0)
    else:
        whole = "INT" in kind
        attribute.data.foreach_set(name, numbers % 100 if whole else (numbers % 65) / np.float32(64))


def values(mesh, kind, domain):
    """Return a row of plain values for each element."""
    attribute = mesh.attributes[f"{kind} {domain}"]
    assert (attribute.data_type, attribute.domain) == (kind, domain)
    name, width = field(attribute)
    if kind == "STRING":
        return np.array([[item.value] for item in attribute.data])
    flat = np.empty(len(attribute.data) * width, dtype=np.float32)
    attribute.data.foreach_get(name, flat)
    return flat.reshape(-1, width)


def elements(mesh, domain):
    """Return for each element the positions of its vertices; for a corner those of its face and its own."""
    points = [tuple(vertex.co) for vertex in mesh.vertices]
    if domain == "POINT":
        return [(point,) for point in points]
    if domain == "EDGE":
        return [tuple(sorted(points[vertex] for vertex in edge.vertices)) for edge in mesh.edges]
    faces = [tuple(sorted(points[vertex] for vertex in face.vertices)) for face in mesh.polygons]
    if domain == "FACE":
        return faces
    return [(*faces[face.index], points[vertex]) for face in mesh.polygons for vertex in face.vertices]


def cell(points):
    """Return the column and row, or the line between two, of the cylinder that points lie in; None for none of them."""
    angles = np.arctan2(*np.transpose(points)[1::-1]) / STEP
    angles = (angles - np.round(angles[0]) + SEGMENTS / 2) % SEGMENTS - SEGMENTS / 2 + np.round(angles[0])
    place = []
    for along, count in ((angles, SEGMENTS), (np.transpose(points)[2] / 0.2, RINGS)):
        if np.abs(along - np.round(along[0])).max() < 1e-3:
            place.append(round(along[0]) % count)
        elif np.ptp(along) < 1.001:
            place.append(np.floor(along.mean()) % count + 0.5)
        else:
            return None
    return tuple(place)


ALL = " ".join(TYPES)
CASES = [(command, ALL) for command in COMMANDS]
# Each alone, too: where in memory a value lies depends on what else its element carries.
CASES += [(command, kind) for command in ("cut", "rip and fill") for kind in TYPES]


@pytest.mark.parametrize(("command", "kinds"), CASES)
def test_attributes_of_every_type_survive(command, kinds):
    """What is not cut keeps its value, pieces have the value of what they are part of, and the rest lies between."""
    obj = with_custom_normals(tilted_cylinder)
    mesh = obj.data
    names = [(kind, domain) for kind in kinds.split() for domain in DOMAINS]
    for kind, domain in names:
        add(mesh, kind, domain)
    for domain in DOMAINS:
        mesh.attributes.new(f"Odd {domain}", "INT8", domain)  # a byte, so that not all values lie at even addresses
    places = {domain: elements(mesh, domain) for domain in DOMAINS}
    before = {name: values(mesh, *name) for name in names}
    edit(obj)
    assert COMMANDS[command]()() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    meshes = [made.data for made in bpy.data.objects]
    assert len(meshes) == 1 + command.startswith("separate")
    for mesh in meshes:
        assert not mesh.validate(verbose=True)
        assert not [attribute.name for attribute in mesh.attributes if "contours" in attribute.name]
        origins = {domain: origin(places[domain], elements(mesh, domain), domain) for domain in DOMAINS}
        for name in names:
            check(before[name], values(mesh, *name), origins[name[1]])


def origin(before, after, domain):
    """Return for each element the one that it is or was part of; -1 if there is none."""
    same = {points: index for index, points in enumerate(before)}
    parts = {cell(points): index for index, points in enumerate(before)} if domain in ("EDGE", "FACE") else {}
    return np.array([same[points] if points in same else parts.get(cell(points), -1) for points in after])


def check(before, after, origins):
    np.testing.assert_array_equal(after[origins >= 0], before[origins[origins >= 0]])
    new = after[origins < 0]
    if before.dtype == np.float32 and len(new):
        assert (new >= np.minimum(before.min(axis=0), 0) - 1e-3).all()  # 0 is the default
        assert (new <= before.max(axis=0) + 1e-3).all()


@pytest.mark.skipif("FLOAT4X4" not in TYPES, reason="this Blender has no matrices")
def test_matrices_on_edges_change_nothing_else():
    """New edges are made from old ones then, but take over neither marks nor values."""
    found = []
    for domains in ((), ("EDGE",)):
        obj = tilted_cylinder()
        for kind in ("FLOAT", "INT", "BOOLEAN", "FLOAT_COLOR", "FLOAT_VECTOR"):
            add(obj.data, kind, "EDGE")
        for domain in domains:
            add(obj.data, "FLOAT4X4", domain)
        edit(obj)
        mark_edges(obj, [edge.vertices for edge in obj.data.edges], "seam")
        mark_edges(obj, [edge.vertices for edge in obj.data.edges], "sharp")
        assert contour(output="CUT", **REFINED)() == {"FINISHED"}
        found.append(mesh_state(obj))
        bpy.ops.object.mode_set(mode="OBJECT")
    assert found[0] == found[1]
