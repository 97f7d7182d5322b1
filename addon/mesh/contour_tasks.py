# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the selected contours of meshes in Edit Mode, to be optimized. Changes nothing in the meshes."""

from dataclasses import dataclass

import bpy
import numpy as np

from ..core import edge_paths, messages
from ..core.outcomes import Outcome
from ..core.refusals import Refusal
from ..core.search import ContourSearch
from . import constraint_layers
from .arrays import is_inside_out, is_unevenly_scaled, read_selection, synchronize, with_mirror_images
from .surface_cache import arrays_and_surface_of


@dataclass
class ContourTask(ContourSearch):
    """The selected contours of one object."""

    obj: bpy.types.Object = None
    mirrored: bool = False  # whether some contours are only mirror images of the selected ones
    asymmetric: bool = False  # whether X Mirror is on but mirror images are missing

    def old_edges(self):
        """Return the edges of the contours that have a result, as they were selected."""
        edge_lists = [outcome.edges for outcome in self.done()]
        return np.concatenate(edge_lists) if edge_lists else np.empty((0, 2), dtype=np.int32)


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
    selection = read_selection(obj, face_mode)
    mirror = obj.data.use_mirror_x and len(selection.edges) > 0
    images = with_mirror_images(obj, selection.edges) if mirror else None
    edges = selection.edges if images is None else images
    outcomes = _outcomes(obj.name, edges, face_mode)
    if selection.borderless:
        outcomes.append(Outcome(obj.name, edges, problem=messages.NO_BORDER))
    for outcome in outcomes:
        outcome.closing = close and not face_mode and not outcome.closed
        refusal = None if outcome.problem else _refusal(outcome, selection.loose)
        if refusal:
            outcome.refuse(refusal)
    mirrored = len(edges) > len(selection.edges)
    return ContourTask(outcomes, face_mode, obj=obj, mirrored=mirrored, asymmetric=mirror and images is None)


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


def _outcomes(place, edges, face_mode):
    """Return one outcome for each connected piece; in face mode with the selected part to the left."""
    pieces = edge_paths.sort_edges(edges)
    given = [(loop, True) for loop in pieces.loops] + [(chain, False) for chain in pieces.chains]
    if face_mode:
        given = [(edge_paths.along(vertices, edges, closed), closed) for vertices, closed in given]
    return [Outcome.of(place, vertices, closed) for vertices, closed in given] + [
        _branching(place, piece) for piece in pieces.branching
    ]


def _branching(place, edges):
    """Return the outcome of a piece that is no contour, since edges branch off it."""
    outcome, vertices = Outcome(place, edges), edge_paths.branch_vertices(edges)
    outcome.refuse(Refusal(messages.branching(vertices), vertices))
    return outcome


def _refusal(outcome, loose_edges):
    """Return why a contour cannot be searched at all; None if it can."""
    loose = edge_paths.common_edges(outcome.edges, loose_edges)
    if len(loose):
        return Refusal(messages.loose(loose, outcome.closed), loose)
    if len(outcome.edges) == 1 and not outcome.closing:
        return Refusal(messages.single_edge(outcome.vertices), outcome.vertices)
    return None
