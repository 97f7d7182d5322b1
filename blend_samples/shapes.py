# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the sample shapes from Blender's primitives, modifiers and metaballs. Lengths are in centimeters, z is up.

Each function for a sample returns a new mesh object. The fingers of `hand` and the groove of `groove_cylinder` are
known by construction, and so are the correct contours.
"""

from math import cos, radians, sin

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

# name: base on the hand's outline (x, z), angle of the axis to the vertical, length, radius at the base and at the tip
FINGERS = {
    "index": ((2.75, 8.6), 10.0, 7.0, 1.05, 0.75),
    "middle": ((0.45, 9.1), 0.0, 7.9, 1.08, 0.77),
    "ring": ((-1.8, 8.7), -10.0, 7.2, 1.02, 0.72),
    "little": ((-3.75, 7.6), -21.0, 5.6, 0.88, 0.62),
    "thumb": ((3.5, 3.2), 50.0, 5.8, 1.2, 0.85),
}
HAND_VOXEL = 0.22  # about the hand's edge length
KNUCKLE = 1.25  # radius of the ball of the palm that the finger leaves, divided by the finger's radius
GROOVE = {"height": 0.0, "slope": 0.45, "depth": 0.22, "sigma": 0.22}
# The limbs on the character's left side: positions along the axis and radii there, from the body outward.
ARM = (((2.4, 0.0, 11.9), 1.0), ((4.1, 0.1, 10.3), 0.75), ((6.0, -0.2, 8.7), 0.45))
LEG = (((1.25, 0.0, 7.2), 1.10), ((1.45, -0.1, 4.3), 0.85), ((1.55, 0.1, 1.6), 0.55))
# Its balls: position and the three radii; those with x > 0 have a twin on the right.
BODY_BALLS = {
    "belly": ((0.0, 0.0, 8.4), (2.65, 1.9, 2.0)),
    "chest": ((0.0, 0.0, 11.2), (2.0, 1.5, 2.1)),
    "head": ((0.0, -0.1, 16.0), (2.1, 2.0, 2.2)),
    "nose": ((0.0, -2.1, 15.7), (0.35, 0.4, 0.4)),
    "ear": ((2.05, 0.1, 16.0), (0.35, 0.5, 0.7)),
    "hand": ((6.75, -0.3, 7.9), (1.0, 0.75, 1.0)),
    "thumb": ((6.15, -0.95, 7.75), (0.35, 0.65, 0.35)),
    "foot": ((1.7, -0.8, 0.65), (0.95, 1.75, 0.75)),
}
RAGGED = 0.9  # how far above a finger's base the rough segmentation ends on average
PART_COLORS = {  # red, green, blue
    "palm": (0.93, 0.84, 0.70),
    "index": (0.88, 0.20, 0.14),
    "middle": (1.0, 0.66, 0.08),
    "ring": (0.22, 0.60, 0.25),
    "little": (0.15, 0.42, 0.80),
    "thumb": (0.52, 0.25, 0.68),
}
CYLINDER = {"radius": 2.0, "height": 8.0, "around": 64, "along": 80}


def finger_axis(name):
    """Return the base point and unit direction of a finger."""
    (x, z), angle, *_ = FINGERS[name]
    return Vector((x, 0.0, z)), Vector((sin(radians(angle)), 0.0, cos(radians(angle))))


def finger_point(name, part):
    """Return the point on a finger's axis at a fraction of its length; at 0 its cone leaves the ball of its knuckle."""
    base, axis = finger_axis(name)
    length, radius = FINGERS[name][2:4]
    leaves = radius * (KNUCKLE**2 - 1.0) ** 0.5
    return base + axis * (leaves + part * (length - leaves))


def hand():
    """Palm: the hull of balls at the knuckles and the wrist. Fingers: cones that narrow toward a round tip."""
    bm = bmesh.new()
    for name in FINGERS:
        _add_finger(bm, name)
    _add_palm(bm)
    wrist = _scaled((0, 0, -1.6), (1.15, 0.72, 1))
    bmesh.ops.create_cone(bm, cap_ends=True, segments=48, radius1=2.1, radius2=2.1, depth=5.0, matrix=wrist)
    return _remeshed(_object("hand", bm), voxel=HAND_VOXEL, smoothing=6)


def parts_of_hand(points):
    """Return for each point the part whose surface is nearest, from inside or outside: "palm" or a finger's name."""
    hull = bmesh.new()
    _add_palm(hull)
    palm = BVHTree.FromBMesh(hull)
    hull.free()
    distances = {"palm": np.array([_signed_distance(palm, Vector(point)) for point in points])}
    distances |= {name: _finger_distance(name, points) for name in FINGERS}
    return np.array(list(distances))[np.argmin(np.stack(list(distances.values())), axis=0)]


def _signed_distance(tree, point):
    nearest, normal, _, distance = tree.find_nearest(point)
    return distance if (point - nearest).dot(normal) > 0.0 else -distance


def _finger_distance(name, points):
    """Return the signed distance to a cone with a round tip; the slope of its side, 3 degrees, is neglected."""
    base, axis = (np.array(vector) for vector in finger_axis(name))
    length, base_radius, tip_radius = FINGERS[name][2:]
    straight = length - tip_radius
    along = np.clip((points - base) @ axis, 0.0, straight)
    radius = base_radius + along / straight * (tip_radius - base_radius)
    return np.linalg.norm(points - base - along[:, None] * axis, axis=1) - radius


def _add_finger(bm, name):
    base, axis = finger_axis(name)
    length, base_radius, tip_radius = FINGERS[name][2:]
    tip = base + axis * (length - tip_radius)
    _add_cone(bm, (base, base_radius), (tip, tip_radius))
    _add_ball(bm, tip, tip_radius)


def _add_cone(bm, joint, following):
    """Add a limb between two joints, each a position and the radius there."""
    (start, radius1), (end, radius2) = joint, following
    axis = Vector(end) - Vector(start)
    turned = Matrix.Translation((Vector(start) + Vector(end)) / 2) @ axis.to_track_quat("Z", "Y").to_matrix().to_4x4()
    bmesh.ops.create_cone(
        bm, cap_ends=True, segments=48, radius1=radius1, radius2=radius2, depth=axis.length, matrix=turned
    )


def _add_ball(bm, place, radius):
    bmesh.ops.create_uvsphere(bm, u_segments=32, v_segments=24, radius=radius, matrix=Matrix.Translation(place))


def _add_palm(bm):
    hull = bmesh.new()
    for name in FINGERS:
        base, axis = finger_axis(name)
        ball = KNUCKLE * FINGERS[name][3]
        _add_ball(hull, base, ball)
    for x in (-1.6, 1.5):
        _add_ball(hull, (x, 0, 0.6), 1.3)
    result = bmesh.ops.convex_hull(hull, input=hull.verts)
    inside = [e for e in result["geom_interior"] if isinstance(e, bmesh.types.BMVert)]
    bmesh.ops.delete(hull, geom=inside, context="VERTS")
    mesh = bpy.data.meshes.new("palm")
    hull.to_mesh(mesh)
    hull.free()
    bm.from_mesh(mesh)
    bpy.data.meshes.remove(mesh)


def torso():
    """Make a trunk of metaballs with a strong waist and sinusoidal horizontal grooves all over."""
    balls = [((0, 0, 0.5), 5.2, (1.15, 0.8, 0.9)), ((0, 0, 9.5), 5.6, (1.25, 0.8, 0.95))]
    balls += [((0, 0, 5), 3.2, (1.05, 0.8, 1.3))]
    balls += [((side * 5.4, 0, 11.5), 2.6, (1, 1, 1)) for side in (-1, 1)] + [((0, 0, 15), 2.4, (1, 1, 1.2))]
    ob = _remeshed(_from_metaballs("torso", balls), voxel=0.26, smoothing=6)
    normals, positions = _vertex_normals(ob.data), _positions(ob.data)
    depth = 0.10 * np.cos(2 * np.pi * positions[:, 2] / 1.3)
    _set_positions(ob.data, positions + depth[:, None] * normals)
    return ob


def head():
    """Make a head with nose, ears, eye hollows and a neck on shoulders, of metaballs."""
    balls = [
        ((0, 0, 0), 3.6, (0.85, 1.0, 1.05)),
        ((0, -1.0, -1.9), 2.3, (0.95, 1.0, 0.9)),
        ((0, -3.0, -0.5), 0.8, (0.8, 1.0, 1.2)),
        ((0, 0.5, -4.2), 1.9, (1, 1, 1.6)),
        ((0, 0.6, -7.2), 2.6, (2.0, 1.0, 0.75)),
    ]
    balls += [((side * 2.75, 0.2, -0.5), 1.0, (0.55, 0.8, 1.3)) for side in (-1, 1)]
    hollows = [((side * 1.25, -3.5, 0.3), 0.9, (1.0, 0.9, 0.7)) for side in (-1, 1)]
    return _remeshed(_from_metaballs("head", balls, hollows), voxel=0.16, smoothing=5)


def character():
    """Make a figure of balls and limbs that narrow toward wrists and ankles, joined at creases."""
    bm = bmesh.new()
    _add_cone(bm, ((0.0, 0.0, 12.4), 0.85), ((0.0, 0.0, 14.6), 0.85))
    for place, radii in BODY_BALLS.values():
        for side in (1, -1) if place[0] else (1,):
            scaled = _scaled(_mirrored(place, side), radii)
            bmesh.ops.create_uvsphere(bm, u_segments=32, v_segments=24, radius=1.0, matrix=scaled)
    for limb in (ARM, LEG):
        for side in (1, -1):
            joints = [(_mirrored(place, side), radius) for place, radius in limb]
            for joint, following in zip(joints, joints[1:]):
                _add_cone(bm, joint, following)
            for joint in joints[:2]:
                _add_ball(bm, *joint)
    return _remeshed(_object("character", bm), voxel=0.2, smoothing=4)


def _mirrored(place, side):
    return (side * place[0], *place[1:])


def hand_parts():
    """Make the hand with a material for each part, as from a rough segmentation: ragged and too high up."""
    ob = hand()
    ob.name = ob.data.name = "hand_parts"
    for name in ("palm", *FINGERS):
        ob.data.materials.append(bpy.data.materials.new(name))
        ob.data.materials[-1].diffuse_color = (*PART_COLORS[name], 1.0)
    centers = np.array([face.center for face in ob.data.polygons])
    ob.data.polygons.foreach_set("material_index", rough_labels(centers))
    return ob


def rough_labels(points):
    """Return for each point 0 for the palm, or the number of its finger from 1 on."""
    nearest, labels = parts_of_hand(points), np.zeros(len(points), np.int32)
    for number, name in enumerate(FINGERS, 1):
        base, axis = (np.array(vector) for vector in finger_axis(name))
        along = (points - base) @ axis
        x, y = points[:, 0] - base[0] - along * axis[0], points[:, 1]
        angle = np.arctan2(y, x)
        ragged = 0.35 * np.sin(9 * angle) + 0.2 * np.sin(4 * angle + number)
        leaves = (finger_point(name, 0.0) - finger_axis(name)[0]).length
        labels[(nearest == name) & (along > leaves + RAGGED + ragged)] = number
    return labels


def suzanne():
    bpy.ops.mesh.primitive_monkey_add(size=2)
    ob = bpy.context.object
    ob.name = ob.data.name = "suzanne"
    return _apply(ob, "SUBSURF", levels=2)


# radius and height of the bottle's profile
BODY = ((3.0, 0.0), (3.4, 0.4), (3.4, 4.4), (3.0, 4.9), (3.0, 5.5), (3.4, 6.0), (3.4, 9.5), (3.1, 10.8), (1.9, 12.2))
NECK = ((1.3, 13.0), (1.2, 13.6), (1.2, 16.0), (1.6, 16.2), (1.6, 17.0), (1.2, 17.2))


def bottle():
    """Make a lathed bottle of quads, with n-gons for its ends and bricks of six vertices where the label would be."""
    profile = _even_profile(BODY + NECK, 0.22)
    bm = bmesh.new()
    angles = np.linspace(0, 2 * np.pi, 96, endpoint=False)
    rings = [[bm.verts.new((r * cos(a), r * sin(a), z)) for a in angles] for r, z in profile]
    for low, high in zip(rings, rings[1:]):
        for i in range(96):
            j = (i + 1) % 96
            bm.faces.new((low[i], low[j], high[j], high[i]))
    bm.faces.new(rings[0][::-1])
    bm.faces.new(rings[-1])
    _lay_bricks(bm, 96, [k for k, (_, z) in enumerate(profile[:-1]) if 6.4 < z < 9.2])
    return _object("bottle", bm)


def _even_profile(profile, step):
    points = []
    for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
        count = max(1, round(((r1 - r0) ** 2 + (z1 - z0) ** 2) ** 0.5 / step))
        points += [(r0 + (r1 - r0) * i / count, z0 + (z1 - z0) * i / count) for i in range(count)]
    return points + [profile[-1]]


def _lay_bricks(bm, around, rows):
    """Merge pairs of neighboring quads in each row, shifted by one from row to row."""
    bm.faces.ensure_lookup_table()
    pairs = [(row * around + i, row * around + (i + 1) % around) for row in rows for i in range(row % 2, around, 2)]
    pairs = [(bm.faces[a], bm.faces[b]) for a, b in pairs]
    edges = [next(e for e in a.edges if e in b.edges) for a, b in pairs]
    bmesh.ops.dissolve_edges(bm, edges=edges, use_verts=False)


def groove_cylinder():
    """Make a regular quad cylinder with a slanted groove that follows no row of its vertices."""
    around, along = CYLINDER["around"], CYLINDER["along"]
    angle = np.tile(np.linspace(0, 2 * np.pi, around, endpoint=False), along + 1)
    z = np.repeat(np.linspace(-0.5, 0.5, along + 1) * CYLINDER["height"], around)
    x, y = np.cos(angle), np.sin(angle)
    away = z - GROOVE["height"] - GROOVE["slope"] * CYLINDER["radius"] * x
    radius = CYLINDER["radius"] - GROOVE["depth"] * np.exp(-0.5 * (away / GROOVE["sigma"]) ** 2)
    faces = [
        (k * around + i, k * around + (i + 1) % around, (k + 1) * around + (i + 1) % around, (k + 1) * around + i)
        for k in range(along)
        for i in range(around)
    ]
    mesh = bpy.data.meshes.new("groove_cylinder")
    mesh.from_pydata(np.stack([radius * x, radius * y, z], axis=1).tolist(), [], faces)
    return _linked(mesh)


def _scaled(place, scale):
    return Matrix.LocRotScale(Vector(place), None, Vector(scale))


def _linked(mesh):
    ob = bpy.data.objects.new(mesh.name, mesh)
    bpy.context.scene.collection.objects.link(ob)
    bpy.context.view_layer.objects.active = ob
    return ob


def _object(name, bm):
    mesh = bpy.data.meshes.new(name)
    bm.to_mesh(mesh)
    bm.free()
    return _linked(mesh)


def _apply(ob, kind, **settings):
    modifier = ob.modifiers.new(kind, kind)
    for name, value in settings.items():
        setattr(modifier, name, value)
    with bpy.context.temp_override(object=ob):
        bpy.ops.object.modifier_apply(modifier=modifier.name)
    return ob


def _remeshed(ob, voxel, smoothing):
    """Remesh to one closed surface of even quads; smoothing rounds the voxel steps and the creases between parts."""
    _apply(ob, "REMESH", mode="VOXEL", voxel_size=voxel)
    return _apply(ob, "SMOOTH", factor=0.5, iterations=smoothing)


def _from_metaballs(name, balls, hollows=()):
    """Make metaballs, and negative ones for hollows: position, radius, and scale of each axis."""
    data = bpy.data.metaballs.new(name)
    data.resolution, data.threshold = 0.25, 0.1
    for index, (place, radius, scale) in enumerate([*balls, *hollows]):
        element = data.elements.new(type="ELLIPSOID")
        element.co, element.radius, element.use_negative = place, radius, index >= len(balls)
        element.size_x, element.size_y, element.size_z = scale
    source = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(source)
    evaluated = source.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = bpy.data.meshes.new_from_object(evaluated)
    bpy.data.objects.remove(source)
    mesh.name = name
    return _linked(mesh)


def _positions(mesh):
    flat = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def _vertex_normals(mesh):
    flat = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("normal", flat)
    return flat.reshape(-1, 3)


def _set_positions(mesh, positions):
    mesh.vertices.foreach_set("co", positions.ravel())
    mesh.update()
