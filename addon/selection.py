# SPDX-License-Identifier: GPL-3.0-or-later
"""From what is selected in Edit Mode to an outcome for each of its contours; changes nothing."""

from dataclasses import dataclass

import bpy
import numpy as np

from . import api, constraints, contours, mesh_access, native, parameters, report
from .constraint_arrays import OutsideBand


@dataclass
class Part:
    """One object's share of the selection."""

    obj: bpy.types.Object
    outcomes: list
    warnings: list
    mirrored: bool = False  # whether there are contours that were not selected, but their mirror images
    outside: tuple = ()  # required vertices where nothing is searched

    def done(self):
        """The contours that are output."""
        return [outcome for outcome in self.outcomes if outcome.result is not None and not outcome.problem]

    def old_edges(self):
        """The edges of the contours that have a result, as selected."""
        edge_lists = [outcome.edges for outcome in self.done()]
        return np.concatenate(edge_lists) if edge_lists else np.empty((0, 2), dtype=np.int32)


def optimize_selection(objects, face_mode, settings):
    """A Part for each object, with an outcome for each connected piece of its selection."""
    return [_optimize_part(obj, objects, face_mode, settings) for obj in objects]


def _optimize_part(obj, objects, face_mode, settings):
    mesh_access.synchronize(obj)
    selection = mesh_access.read_selection(obj, face_mode)
    mirror = obj.data.use_mirror_x and len(selection.edges) > 0
    images = mesh_access.with_mirror_images(obj, selection.edges) if mirror else None
    edges = selection.edges if images is None else images
    outcomes = _outcomes(obj.name, edges, face_mode)
    for outcome in outcomes:
        outcome.problem = outcome.problem or _problem(outcome, selection.loose)
    sound = [outcome for outcome in outcomes if not outcome.problem]
    outside = _optimize(obj, objects, sound, face_mode, settings) if sound else ()
    part = Part(obj, outcomes, [], mirrored=len(edges) > len(selection.edges), outside=outside)
    if part.done():
        part.warnings = _warnings(obj) + [report.not_mirrored(obj.name)] * (mirror and images is None)
    return part


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


def _warnings(obj):
    """What the user should know about how the object is measured."""
    warnings = []
    if mesh_access.is_unevenly_scaled(obj):
        warnings.append(report.uneven_scale(obj.name))
    if mesh_access.is_inside_out(obj):
        warnings.append(report.inside_out(obj.name))
    return warnings


def _problem(outcome, loose_edges):
    """Why a contour is not handed to the search at all; empty where it is."""
    loose = contours.common_edges(outcome.edges, loose_edges)
    if len(loose):
        return report.loose(loose, outcome.closed)
    if len(outcome.edges) == 1:
        return report.single_edge(outcome.vertices)
    return ""


def _optimize(obj, objects, outcomes, face_mode, settings):
    """Gives each outcome its result, or the problem that keeps it from one; returns required vertices out of reach."""
    settings, wanted = parameters.split(settings)
    try:
        asked = constraints.read(obj, **wanted)
        surface = api.surface_of(obj, beside=objects)
        if asked is not None and asked.density is not None:
            outcomes = _prepare_for_region(surface, outcomes, face_mode, asked)
        _fill_in(surface, outcomes, asked, settings)
    except ValueError as error:
        for outcome in outcomes:
            outcome.problem = outcome.problem or str(error)
        return error.vertices if isinstance(error, OutsideBand) else ()
    return ()


def _prepare_for_region(surface, outcomes, face_mode, asked):
    """Those that can enclose a region, with what is painted to their left; in face mode the selected part is there."""
    for outcome in outcomes:
        if not outcome.closed:
            outcome.problem = report.open_region()
        elif not face_mode and asked.paints_the_right(native.module(), surface, outcome.vertices):
            outcome.vertices = outcome.vertices[::-1].copy()
    return [outcome for outcome in outcomes if outcome.closed]


def _fill_in(surface, outcomes, asked, settings):
    """Optimizes all together. Where one of them cannot be a contour, that one is left out and the others go on."""
    if not outcomes:
        return
    vertices, closed = [outcome.vertices for outcome in outcomes], [outcome.closed for outcome in outcomes]
    try:
        results = api.optimize_all_on(surface, vertices, closed=closed, constraints=asked, **settings)
    except OutsideBand:
        raise
    except ValueError:
        barriers = () if asked is None else asked.barriers_beside(vertices, closed)
        for outcome in outcomes:
            outcome.problem = api.problem_on(surface, outcome.vertices, outcome.closed, barriers)
        sound = [outcome for outcome in outcomes if not outcome.problem]
        if len(sound) == len(outcomes):
            raise
        _fill_in(surface, sound, asked, settings)
        return
    for outcome, result in zip(outcomes, results):
        outcome.result = result
