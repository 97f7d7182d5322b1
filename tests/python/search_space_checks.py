# SPDX-License-Identifier: GPL-3.0-or-later
"""Invariants of every band, flow and search graph, checked on what `mrcontour.search_space` returns."""

import itertools
from collections import defaultdict

import numpy as np


def pairs(loop):
    loop = [int(v) for v in loop]
    return list(zip(loop, loop[1:] + loop[:1], strict=True))


def check_search_space(mesh, contour, space, options):
    check_band(mesh, contour, space)
    check_rounds(mesh, contour, space)
    check_flow(contour, space)
    if options.get("flow", "gates") == "harmonic":
        check_harmonic(space)
    else:
        check_strips(contour, space)
    check_graph(space)


def check_band(mesh, contour, space):
    """The band is an annulus: its Euler characteristic is 0, counting the contour's own edges where one side is
    empty."""
    faces = [mesh.faces[i] for i in space["faces"].tolist()]
    assert len(set(space["faces"].tolist())) == len(faces)
    edges = {tuple(sorted(edge)) for loop in [*faces, contour] for edge in pairs(loop)}
    vertices = {v for edge in edges for v in edge}
    assert set(space["vertices"].tolist()) == vertices
    assert len(space["vertices"]) == len(vertices)
    assert len(vertices) - len(edges) + len(faces) == 0
    borders = open_edges(faces)
    outer = {frozenset(edge) for side in ("left", "right") for edge in pairs(space[side][-1])}
    assert {frozenset(edge) for edge in borders} <= outer


def open_edges(faces):
    directed = {edge for face in faces for edge in pairs(face)}
    return [(a, b) for a, b in directed if (b, a) not in directed]


def check_rounds(mesh, contour, space):
    """Every vertex of a round shares a polygon of the band with a vertex of the previous round's boundary. The
    boundaries are simple loops along mesh edges."""
    faces = [set(mesh.faces[i]) for i in space["faces"].tolist()]
    around = defaultdict(set)
    for face in faces:
        for v in face:
            around[v] |= face
    rounds = dict(zip(space["vertices"].tolist(), space["round"].tolist(), strict=True))
    sides = dict(zip(space["vertices"].tolist(), space["side"].tolist(), strict=True))
    real = {frozenset(edge) for face in mesh.faces for edge in pairs(face)}
    assert {v for v, side in sides.items() if side == 0} == set(contour.tolist())
    assert {v for v, number in rounds.items() if number == 0} == set(contour.tolist())
    for name, side in (("left", 1), ("right", -1)):
        curves = [curve.tolist() for curve in space[name]]
        assert curves[0] == contour.tolist()
        for number, (last, curve) in enumerate(itertools.pairwise(curves), start=1):
            assert len(set(curve)) == len(curve)
            assert all(frozenset(edge) in real for edge in pairs(curve))
            reach = set().union(*(around[v] for v in last))
            new = {v for v, n in rounds.items() if n == number and sides[v] == side}
            assert new <= reach
            assert set(curve) <= new | set(last)


def check_flow(contour, space):
    """A closed 1-form of period 1: it sums to zero around every triangle, and to one around the contour and every
    boundary."""
    form = {}
    for (a, b), increment in zip(space["edges"].tolist(), space["increments"].tolist(), strict=True):
        assert (a, b) not in form
        assert np.isfinite(increment)
        form[a, b], form[b, a] = increment, -increment
    triangles = [pairs(triangle) for triangle in space["triangles"].tolist()]
    assert all(abs(sum(form[edge] for edge in triangle)) < 1e-12 for triangle in triangles)
    assert {frozenset(edge) for triangle in triangles for edge in triangle} <= {frozenset(edge) for edge in form}
    for curve in [contour, *space["left"], *space["right"]]:
        assert abs(sum(form[edge] for edge in pairs(curve)) - 1) < 1e-11


def check_harmonic(space):
    """With weight 1 on every real edge, the flow into each vertex equals the flow out of it."""
    balance = defaultdict(float)
    real = ~space["diagonal"]
    for (a, b), increment in zip(space["edges"][real].tolist(), space["increments"][real].tolist(), strict=True):
        balance[a] += increment
        balance[b] -= increment
    assert max(map(abs, balance.values())) < 1e-11


def check_strips(contour, space):
    """The strip boundaries cover the band, rise strictly and do not cross, and no edge skips one."""
    strips = [strip.tolist() for strip in space["strips"]]
    form = dict(zip(map(tuple, space["edges"].tolist()), space["increments"].tolist(), strict=True))
    form |= {(b, a): -increment for (a, b), increment in form.items()}
    assert {v for strip in strips for v in strip} == set(space["vertices"].tolist())
    assert any(set(strip) == set(contour.tolist()) for strip in strips)
    for strip in strips:
        assert len(set(strip)) == len(strip)
        assert all(form[edge] > 0 for edge in pairs(strip))
    places = defaultdict(set)
    for number, strip in enumerate(strips):
        for v in strip:
            places[v].add(number)
    for a, b in form:
        assert any(abs(i - j) <= 1 for i in places[a] for j in places[b])
    left = [triangles_left_of(strip, space) for strip in strips]
    assert all(following <= last for last, following in itertools.pairwise(left))


def triangles_left_of(loop, space):
    triangles = space["triangles"].tolist()
    owner = {edge: i for i, triangle in enumerate(triangles) for edge in pairs(triangle)}
    fence = {frozenset(edge) for edge in pairs(loop)}
    stack = [owner[edge] for edge in pairs(loop) if edge in owner]
    found = set(stack)
    while stack:
        for a, b in pairs(triangles[stack.pop()]):
            other = owner.get((b, a))
            if other is not None and other not in found and frozenset((a, b)) not in fence:
                found.add(other)
                stack.append(other)
    return found


def check_graph(space):
    """Arcs join edges end to start. All lead forward except those that leave the cut, where a period ends."""
    nodes, cut = space["nodes"], set(space["cut"].tolist())
    assert cut
    assert len({tuple(node) for node in nodes.tolist()}) == len(nodes)
    for i, j in space["arcs"].tolist():
        assert nodes[i][1] == nodes[j][0]
        assert nodes[i][0] != nodes[j][1]
        assert i < j or i in cut
    assert np.isfinite(space["f"]).all()
    assert (space["g"] >= 0).all()
