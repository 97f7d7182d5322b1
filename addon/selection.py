# SPDX-License-Identifier: GPL-3.0-or-later
"""From what is selected in Edit Mode to an outcome for each of its contours; changes nothing."""

from dataclasses import dataclass

import bpy
import numpy as np

from . import api, contours, mesh_access, report


@dataclass
class Part:
    """One object's share of the selection."""

    obj: bpy.types.Object
    outcomes: list
    warnings: list
    mirrored: bool = False  # whether there are contours that were not selected, but their mirror images
    asymmetric: bool = False  # whether mirror images were asked for and are not there

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


def optimize_selection(objects, face_mode, settings):
    """A Part for each object, with an outcome for each connected piece of its selection."""
    parts = [read_part(obj, face_mode) for obj in objects]
    for part in parts:
        _optimize(part.obj, objects, part.sound(), settings)
        note_warnings(part)
    return parts


def read_part(obj, face_mode):
    """One object's share of the selection, not yet searched for."""
    mesh_access.synchronize(obj)
    selection = mesh_access.read_selection(obj, face_mode)
    mirror = obj.data.use_mirror_x and len(selection.edges) > 0
    images = mesh_access.with_mirror_images(obj, selection.edges) if mirror else None
    edges = selection.edges if images is None else images
    outcomes = _outcomes(obj.name, edges, face_mode)
    for outcome in outcomes:
        outcome.problem = outcome.problem or _problem(outcome, selection.loose)
    return Part(obj, outcomes, [], len(edges) > len(selection.edges), asymmetric=mirror and images is None)


def note_warnings(part):
    """What the user should know about how the object is measured, where anything was."""
    if part.done():
        part.warnings = _warnings(part.obj) + [report.not_mirrored(part.obj.name)] * part.asymmetric


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


def _optimize(obj, objects, outcomes, settings):
    """Gives each outcome its result, or the problem that keeps it from one."""
    if not outcomes:
        return
    try:
        _fill_in(api.surface_of(obj, beside=objects), outcomes, settings)
    except ValueError as error:
        for outcome in outcomes:
            outcome.problem = str(error)


def _fill_in(surface, outcomes, settings):
    """Optimizes all together. Where one of them cannot be a contour, that one is left out and the others go on."""
    vertices, closed = [outcome.vertices for outcome in outcomes], [outcome.closed for outcome in outcomes]
    try:
        results = api.optimize_all_on(surface, vertices, closed=closed, **settings)
    except ValueError:
        for outcome in outcomes:
            outcome.problem = api.problem_on(surface, outcome.vertices, closed=outcome.closed)
        sound = [outcome for outcome in outcomes if not outcome.problem]
        if len(sound) == len(outcomes):
            raise
        if sound:
            _fill_in(surface, sound, settings)
        return
    for outcome, result in zip(outcomes, results):
        outcome.result = result
