# SPDX-License-Identifier: GPL-3.0-or-later
"""From what is selected in Edit Mode to an outcome for each of its contours; changes nothing there."""

from dataclasses import dataclass

import bpy
import numpy as np

from . import api, contours, jobs, mesh_access, native, report
from . import constraints as layers
from .constraint_arrays import OutsideBand


@dataclass
class Part:
    """One object's share of the selection."""

    obj: bpy.types.Object
    outcomes: list
    warnings: list
    mirrored: bool = False  # whether there are contours that were not selected, but their mirror images
    asymmetric: bool = False  # whether mirror images were asked for and are not there
    arrays: object = None  # of the mesh, where there is something to optimize
    surface: object = None  # the native one made from them
    constraints: object = None  # what the mesh's layers ask of the contours
    has_left: bool = False  # whether a side of the contours was selected, in face mode, which is then their left
    outside: tuple = ()  # required vertices where nothing is searched

    def sound(self):
        """The contours that can be handed to the search."""
        return [outcome for outcome in self.outcomes if not outcome.problem]

    def done(self):
        """The contours that are output."""
        return [outcome for outcome in self.outcomes if outcome.result is not None and not outcome.problem]

    def old_edges(self):
        """The edges of the contours that have a result, as selected."""
        edge_lists = [outcome.edges for outcome in self.done()]
        return np.concatenate(edge_lists) if edge_lists else np.empty((0, 2), dtype=np.int32)

    def fail(self, error):
        """Why nothing can be done with any of the contours that could be handed to the search."""
        for outcome in self.sound():
            outcome.problem = report.problem(error)


def read_parts(objects, face_mode, close=False, constraints=None):
    """A Part for each object, with an outcome for each connected piece of its selection; nothing is optimized yet.

    With `close`, chains of edges are to be closed first. `constraints` are settings that name layers.
    """
    parts = [read_part(obj, face_mode, close) for obj in objects]
    for part in parts:
        if part.sound():
            try:
                part.arrays, part.surface = api.arrays_and_surface_of(part.obj, beside=objects)
                part.constraints = layers.read(part.obj, **(constraints or {}))
            except ValueError as error:
                part.fail(error)
    return parts


def optimize_parts(parts, settings, progress=None):
    """Gives each outcome its result, or the problem that keeps it from one. Without bpy, for any thread."""
    searched = [part for part in parts if part.surface]
    for i, part in enumerate(searched):
        share = jobs.share_of(progress, i, len(searched))
        steps = 2 if any(outcome.closing for outcome in part.sound()) else 1
        try:
            complete(part, jobs.share_of(share, 0, steps))
            _fill_in(part, part.sound(), settings, jobs.share_of(share, steps - 1, steps))
        except ValueError as error:
            part.outside = error.vertices if isinstance(error, OutsideBand) else ()
            part.fail(error)


def complete(part, progress=None):
    """Closes the chains that are to be closed, and turns contours so that what is painted lies to their left."""
    _close(part.surface, part.sound(), progress)
    _prepare_for_region(part)


def find_problems(part, outcomes):
    """Gives each outcome that is no contour the reason why; the others may stay without a result."""
    vertices, closed = [outcome.vertices for outcome in outcomes], [outcome.closed for outcome in outcomes]
    barriers = () if part.constraints is None else part.constraints.barriers_beside(vertices, closed)
    for outcome in outcomes:
        outcome.problem = api.problem_on(part.surface, outcome.vertices, outcome.closed, barriers)


def read_part(obj, face_mode, close=False):
    """One object's share of the selection."""
    mesh_access.synchronize(obj)
    selection = mesh_access.read_selection(obj, face_mode)
    mirror = obj.data.use_mirror_x and len(selection.edges) > 0
    images = mesh_access.with_mirror_images(obj, selection.edges) if mirror else None
    edges = selection.edges if images is None else images
    outcomes = _outcomes(obj.name, edges, face_mode)
    if selection.borderless:
        outcomes.append(report.Outcome(obj.name, edges, problem=report.NO_BORDER))
    for outcome in outcomes:
        outcome.closing = close and not face_mode and not outcome.closed
        outcome.problem = outcome.problem or _problem(outcome, selection.loose)
    mirrored = len(edges) > len(selection.edges)
    return Part(obj, outcomes, [], mirrored, asymmetric=mirror and images is None, has_left=face_mode)


def note_warnings(part):
    """What the user should know about how the object is measured, where anything was."""
    if part.done():
        part.warnings = warnings_of(part.obj, part.arrays) + [report.not_mirrored(part.obj.name)] * part.asymmetric


def _outcomes(place, edges, face_mode):
    """One outcome for each connected piece; in face mode with the part to the left."""
    pieces = contours.sort_edges(edges)
    given = [(loop, True) for loop in pieces.loops] + [(chain, False) for chain in pieces.chains]
    if face_mode:
        given = [(contours.along(vertices, edges, closed), closed) for vertices, closed in given]
    branching = [
        report.Outcome(place, piece, problem=report.branching(contours.branch_vertices(piece)))
        for piece in pieces.branching
    ]
    return [report.Outcome.of(place, vertices, closed) for vertices, closed in given] + branching


def warnings_of(obj, arrays):
    """What the user should know about how a synchronized mesh, with its arrays, is measured."""
    warnings = []
    if mesh_access.is_unevenly_scaled(obj):
        warnings.append(report.uneven_scale(obj.name))
    if mesh_access.is_inside_out(obj, arrays):
        warnings.append(report.inside_out(obj.name))
    return warnings


def _problem(outcome, loose_edges):
    """Why a contour is not handed to the search at all; empty where it is."""
    loose = contours.common_edges(outcome.edges, loose_edges)
    if len(loose):
        return report.loose(loose, outcome.closed)
    if len(outcome.edges) == 1 and not outcome.closing:
        return report.single_edge(outcome.vertices)
    return ""


def _close(surface, outcomes, progress):
    """Closes the chains that are to be closed. Loops that meet are no contours beside each other: the first has it."""
    taken = {vertex for outcome in outcomes if not outcome.closing for vertex in outcome.vertices.tolist()}
    closing = [outcome for outcome in outcomes if outcome.closing]
    for i, outcome in enumerate(closing):
        share = jobs.share_of(progress, i, len(closing))
        try:
            loop = native.module().close_contour(surface, outcome.vertices, progress=share)
        except ValueError as error:
            outcome.problem = report.problem(error)
            continue
        if taken.isdisjoint(loop.tolist()):
            outcome.vertices, outcome.closed = loop, True
            taken.update(loop.tolist())
        else:
            outcome.problem = report.meets_another(outcome.vertices)


def _prepare_for_region(part):
    """Turns the contours so that what is painted lies to their left, where the selected part does not lie there."""
    if part.constraints is None or part.constraints.density is None:
        return
    for outcome in part.sound():
        if not outcome.closed:
            outcome.problem = report.open_region()
        elif not part.has_left and part.constraints.paints_the_right(native.module(), part.surface, outcome.vertices):
            outcome.vertices = outcome.vertices[::-1].copy()


def _fill_in(part, outcomes, settings, progress):
    """Optimizes all together. Where one of them cannot be a contour, that one is left out and the others go on."""
    if not outcomes:
        return
    surface, asked = part.surface, part.constraints
    vertices, closed = [outcome.vertices for outcome in outcomes], [outcome.closed for outcome in outcomes]
    try:
        results = api.optimize_all_on(
            surface, vertices, closed=closed, progress=progress, constraints=asked, **settings
        )
    except OutsideBand:
        raise
    except ValueError:
        find_problems(part, outcomes)
        sound = [outcome for outcome in outcomes if not outcome.problem]
        if len(sound) == len(outcomes):
            raise
        _fill_in(part, sound, settings, progress)
        return
    for outcome, result in zip(outcomes, results):
        outcome.result = result
