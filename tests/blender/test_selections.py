# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh.optimize_contour on selected edges as people make them: in dashes, with spurs, drawn twice, one edge alone."""

import bpy
import pytest
from made_meshes import (
    GROOVE,
    GROOVE_EDGES,
    SEGMENTS,
    START,
    edge_set,
    edit,
    grooved_cylinder,
    mark_edges,
    marked_edges,
    mesh_state,
    pairs,
    ring,
    run,
    select,
)

BELOW = ring(GROOVE - 2)


def start(*edge_lists, mode="EDGE"):
    obj = grooved_cylinder()
    edit(obj, mode=mode)
    for edges in edge_lists:
        select(obj, edges)
    return obj


def column(i, first, last):
    return [(row * SEGMENTS + i, (row + 1) * SEGMENTS + i) for row in range(first, last)]


def dashes(count, loop=BELOW):
    """Return about half of a loop's edges, in so many dashes."""
    step = len(loop) / count
    chosen = {int(i * step + j) for i in range(count) for j in range(max(1, round(step / 2)))}
    return [edge for i, edge in enumerate(pairs(loop)) if i in chosen]


@pytest.mark.parametrize("close", [False, True])
@pytest.mark.parametrize("count", [3, 6, 12, 16])
def test_dashes_that_make_a_loop_are_joined(count, close, last):
    obj = start(dashes(count))
    assert run(output="SEAM", close=close) == {"FINISHED"}
    assert marked_edges(obj, "seam") == marked_edges(obj, "select") == GROOVE_EDGES
    assert last.message.startswith("1 contour improved: clear boundary, ")
    assert last.message.endswith(f"{count} dashes were joined")


@pytest.mark.parametrize("count", [3, 4, 5, 8, 12])
def test_dashes_of_a_staircase_are_joined_too(count, last):
    obj = start(dashes(count, START))
    assert run(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == GROOVE_EDGES
    assert last.message.endswith(f"{count} dashes were joined")


def test_the_joined_loop_is_selected_if_nothing_is_better(last):
    obj = start(dashes(12, ring(GROOVE)))
    assert run() == {"FINISHED"}
    assert marked_edges(obj, "select") == GROOVE_EDGES


def test_a_mark_in_the_gaps_moves_with_the_loop():
    obj = start(dashes(12))
    mark_edges(obj, pairs(BELOW), "seam")
    assert run(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == GROOVE_EDGES


def test_a_mark_on_what_is_left_out_stays():
    spur = column(7, GROOVE - 4, GROOVE - 2)
    obj = start(pairs(BELOW), spur)
    mark_edges(obj, pairs(BELOW) + spur, "seam")
    assert run(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == GROOVE_EDGES | {frozenset(edge) for edge in spur}
    assert marked_edges(obj, "select") == GROOVE_EDGES


@pytest.mark.parametrize("output", ["SELECT", "SEAM", "CUT", "RIP"])
def test_spurs_are_left_out(output, last):
    obj = start(pairs(START), column(3, GROOVE - 5, GROOVE - 3), column(31, GROOVE - 3, GROOVE))
    assert run(output=output) == {"FINISHED"}
    assert last.message.startswith("1 contour improved: clear boundary, ")
    assert last.message.endswith("Left out of the selection: 2 spurs")
    if output != "RIP":
        assert marked_edges(obj, "select") == GROOVE_EDGES


@pytest.mark.parametrize("rungs", [[0], range(SEGMENTS)])
@pytest.mark.parametrize("mode", ["VERTEX", "EDGE"])
def test_a_doubled_ring_is_one_loop(rungs, mode, last):
    above = ring(GROOVE - 3)
    edges = [edge for i in rungs for edge in column(i, GROOVE - 3, GROOVE - 2)]
    obj = start(pairs(BELOW), pairs(above), edges, mode=mode)
    if mode == "VERTEX" and len(edges) == 1:  # vertices bring all edges between them
        assert len(marked_edges(obj, "select")) >= 2 * SEGMENTS + 1
    assert run(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == marked_edges(obj, "select") == GROOVE_EDGES
    assert "doubled edges" in last.message


@pytest.mark.parametrize("column", [0, 5])
def test_one_edge_is_closed_to_the_loop_around_the_limb(column, last):
    edge = pairs(BELOW)[column : column + 1]
    obj = start(edge)
    before = mesh_state(obj)
    assert run(output="SEAM") == {"CANCELLED"}
    assert mesh_state(obj)["edges"] == before["edges"]
    assert "turn on Close Chains" in last.message
    assert run(output="SEAM", close=True) == {"FINISHED"}
    assert marked_edges(obj, "seam") == GROOVE_EDGES


def test_adjusting_reads_the_same(last):
    obj = start(dashes(12))
    assert bpy.ops.mesh.adjust_contour(output="SEAM") == {"FINISHED"}
    assert marked_edges(obj, "seam") == GROOVE_EDGES
    assert last.message.endswith("12 dashes were joined")


def test_loops_beside_each_other_are_both_meant():
    obj = start(pairs(ring(3)), pairs(ring(4)))
    run(output="SEAM", min_salience=0.0)
    assert len(marked_edges(obj, "seam")) >= 2 * SEGMENTS
    assert edge_set(ring(3)) != marked_edges(obj, "seam")
