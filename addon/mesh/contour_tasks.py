# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the selected contours of meshes in Edit Mode, to be optimized. Changes nothing in the meshes."""

from collections import Counter
from dataclasses import dataclass, field
from functools import cache

import bpy
import numpy as np

from ..core import edge_paths, mesh_faults, messages
from ..core.edge_selections import read_edges
from ..core.outcomes import Outcome
from ..core.refusals import Refusal
from ..core.search import ContourSearch
from . import constraint_layers
from .arrays import (
    is_inside_out,
    is_unevenly_scaled,
    read_arrays,
    read_faces,
    read_selected_edges,
    read_selected_faces,
    synchronize,
    with_mirror_images,
)
from .surface_cache import arrays_and_surface_of

SINGLE_EDGE = "single_edge"  # a kind of problem


@dataclass
class ContourTask(ContourSearch):
    """The selected contours of one object."""

    obj: bpy.types.Object = None
    mirrored: bool = False  # whether some contours are only mirror images of the selected ones
    asymmetric: bool = False  # whether X Mirror is on but mirror images are missing
    left_out: Counter = field(default_factory=Counter)  # what was selected but hardly meant: how many of each kind
    dashes: int = 0  # how many chains were joined to others
    strays: tuple = ()  # in face mode the faces of islands that do not count, and those of pinholes that do

    def old_edges(self):
        """Return the edges along the given contours that have a result."""
        return _concatenated([outcome.edges for outcome in self.done()])

    def edges_beside(self):
        """Return the edges that were selected beside these contours, but left out."""
        return _concatenated([outcome.beside for outcome in self.done() if outcome.beside is not None])


def _concatenated(edge_lists):
    return np.concatenate([np.empty((0, 2), dtype=np.int32), *edge_lists])


def read_tasks(objects, face_mode, close=False, constraints=None):
    """Return a task for each object, with an outcome for each connected piece of its selection; optimize nothing yet.

    With `close`, chains of edges will be closed first. `constraints` are settings that name layers.
    """
    tasks = [read_task(obj, face_mode, close) for obj in objects]
    for task in tasks:
        if task.sound():
            try:
                task.arrays, task.surface = arrays_and_surface_of(task.obj, beside=objects)
                task.constraints = constraint_layers.read(task.obj, **(constraints or {}))
            except ValueError as error:
                task.fail(error)
    return tasks


def read_task(obj, face_mode, close=False):
    """Return the selected contours of one object, without its surface."""
    synchronize(obj)
    task = _read_faces(obj) if face_mode else _read_edges(obj, close)
    for outcome in task.outcomes:
        refusal = None if outcome.problem else _refusal(outcome, face_mode)
        if refusal:
            outcome.refuse(refusal)
    _name_faults(task, [outcome for outcome in task.outcomes if outcome.kind == SINGLE_EDGE])
    return task


def _name_faults(task, single_edges):
    """Give single edges the fault of the mesh that has made a loop to the eye fall into them, if there is one."""
    if single_edges:
        vertices = np.concatenate([outcome.vertices for outcome in single_edges])
        fault = mesh_faults.fault_near(read_arrays(task.obj), vertices)
        for outcome in single_edges if fault else ():
            outcome.refuse(fault)


def warnings(tasks):
    """Return what the user should know about the objects with results; call it before any output is made."""
    return [warning for task in tasks if task.done() for warning in warnings_of(task)]


def warnings_of(task):
    """Return the warnings about one object; also for a NetworkTask."""
    found = []
    if is_unevenly_scaled(task.obj):
        found.append(messages.uneven_scale(task.obj.name))
    if is_inside_out(task.obj, task.arrays):
        found.append(messages.inside_out(task.obj.name))
    if task.asymmetric:
        found.append(messages.not_mirrored(task.obj.name))
    return found


def notes(tasks):
    """Return how the selections of objects with results were read, where not as they are."""
    done = [task for task in tasks if task.done()]
    left_out = sum((task.left_out for task in done), Counter())
    return messages.left_out(left_out) + messages.joined(sum(task.dashes for task in done))


def _read_edges(obj, close):
    """Read the contours of the selected edges; with `close`, chains will be closed."""
    edges, loose = read_selected_edges(obj)
    edges, mirrored, asymmetric = _with_images(obj, edges)
    found = read_edges(edges, cache(lambda: read_faces(obj)), close)
    outcomes = [_outcome(obj.name, contour, close) for contour in found.contours]
    outcomes += [_branching(obj.name, piece) for piece in found.branching]
    for outcome in outcomes:
        _refuse_loose(outcome, edge_paths.common_edges(outcome.edges, loose))
    task = ContourTask(outcomes, obj=obj, mirrored=mirrored, asymmetric=asymmetric)
    task.left_out, task.dashes = found.left_out, found.dashes
    return task


def _outcome(place, contour, close):
    closing = close and not contour.closed
    reading = {"as_selected": contour.as_selected, "beside": contour.beside}
    return Outcome.of(place, contour.vertices, contour.closed, closing=closing, **reading)


def _read_faces(obj):
    """Read the borders of the selected faces, with these to their left."""
    selection = read_selected_faces(obj)
    found = selection.borders()
    given = edge_paths.all_edges(found)
    edges, mirrored, asymmetric = _with_images(obj, given)
    pieces = edge_paths.sort_directed_edges(edges) if mirrored else found
    outcomes = _outcomes(obj.name, pieces)
    if not outcomes and selection.selected.any():
        outcomes.append(Outcome(obj.name, edges))
        fault = mesh_faults.fault_near(read_arrays(obj), selection.vertices())
        outcomes[-1].refuse(fault or Refusal(messages.NO_BORDER))
    task = ContourTask(outcomes, True, obj=obj, mirrored=mirrored, asymmetric=asymmetric)
    task.left_out = Counter(island=found.island_count, pinhole=found.pinhole_count)
    task.strays = found.islands, found.pinholes
    return task


def _with_images(obj, edges):
    """Return the edges with their mirror images if X Mirror is on, whether there are any, and whether some lack."""
    mirror = obj.data.use_mirror_x and len(edges) > 0
    images = with_mirror_images(obj, edges) if mirror else None
    found = edges if images is None else images
    return found, len(found) > len(edges), mirror and images is None


def _outcomes(place, pieces):
    """Return one outcome for each loop, chain and branching piece of the borders of faces."""
    contours = [(loop, True) for loop in pieces.loops] + [(chain, False) for chain in pieces.chains]
    return [Outcome.of(place, vertices, closed) for vertices, closed in contours] + [
        _branching(place, piece, from_faces=True) for piece in pieces.branching
    ]


def _branching(place, edges, from_faces=False):
    """Return the outcome of a piece that is no contour, since edges branch off it."""
    outcome, vertices = Outcome(place, edges), edge_paths.branch_vertices(edges)
    outcome.refuse(Refusal(messages.branching(vertices, from_faces), vertices))
    return outcome


def _refuse_loose(outcome, loose):
    """Give a contour some of whose edges no face uses this problem."""
    if len(loose) and not outcome.problem:
        outcome.refuse(Refusal(messages.loose(loose, outcome.closed), loose))


def _refusal(outcome, from_faces):
    """Return why a contour cannot be searched at all; None if it can."""
    if len(outcome.edges) == 1 and not outcome.closing:
        return Refusal(messages.single_edge(outcome.vertices, from_faces), outcome.vertices, code=SINGLE_EDGE)
    return None
