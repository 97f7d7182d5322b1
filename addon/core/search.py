# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for contours: of scripts on a native surface, and of all that are selected. Needs no Blender.

All of it may run in any thread.
"""

from dataclasses import dataclass

import numpy as np

from . import mesh_faults, messages, native
from .native_constraints import OutsideBand, native_keywords
from .refusals import vertices_of


def optimize_on(surface, vertices, closed=True, around_limb=False, progress=None, **settings):
    """The minimum ratio contour near a given one on a native surface, of `surface_of`.

    Like api.optimize_contour; `progress` and `constraints` as in optimize_all_on.
    """
    if settings.pop("close", False) or around_limb:  # its earlier name
        closing, progress = fraction_of(progress, 0, 2), fraction_of(progress, 1, 2)
        loop = native.module().close_contour(surface, vertices, progress=closing)
        if loop is None:  # cancelled: so is the search
            return optimize_all_on(surface, [vertices], closed=False, progress=lambda _: False, **settings)[0]
        vertices, closed = loop, True
    return optimize_all_on(surface, [vertices], closed=closed, progress=progress, **settings)[0]


def optimize_all_on(surface, contours, closed=True, progress=None, constraints=None, errors="raise", **settings):
    """Several contours of a native surface together, which never cross; `closed` is one for all or one for each.

    `contours` are sequences of vertices, `mrcontour.Contour`s or earlier results. `progress` is called with the
    fraction done, 0 to 1; where it returns False the search ends, status "cancelled", and an exception that it raises
    passes through. `constraints` is what `constraint_layers.read` gives. Returns an `mrcontour.Result` for each
    contour; where `errors` is "return", an `mrcontour.InvalidInput` for each contour in error, of which the others
    keep clear.
    """
    mrc = native.module()
    each_closed = [closed] * len(contours) if isinstance(closed, bool) else closed
    given = contours
    if constraints is not None:
        given = [mrc.Contour(contour, closed=is_closed) for contour, is_closed in zip(contours, each_closed)]
    keywords = native_keywords(mrc, surface, given, settings, constraints)
    return mrc.optimize_all(surface, contours, closed=closed, progress=progress, errors=errors, **keywords)


def problem_on(surface, vertices, closed=True, barriers=()):
    """Why these vertices are no contour that could be optimized, in words; empty where they are one."""
    error = native.module().check_contour(surface, vertices, closed=closed, barriers=barriers)
    return "" if error is None else messages.problem(error)


def fraction_of(progress, i, count):
    """The progress callback of the i-th of several searches; None stays None."""
    return progress and (lambda fraction: progress((i + fraction) / count))


_POOR = 0.5  # the salience below which a contour seldom lies where it should
# What the native module says of contours that faults of the mesh are in the way of.
_CODES_OF_FAULTS = ("on_border", "non_manifold", "no_path_around")


@dataclass
class ContourSearch:
    """The contours of one mesh, which are searched together."""

    outcomes: list
    from_faces: bool = False  # whether they are borders of selected faces, which then lie to their left
    arrays: object = None  # of the mesh, where there is something to optimize
    surface: object = None  # the native one made from them
    constraints: object = None  # what the mesh's layers ask of the contours
    outside: tuple = ()  # required vertices where nothing is searched

    def refuse(self, outcome, error):
        """Gives an outcome the problem that an error states, or the fault of the mesh that is behind it."""
        behind = None
        if self.arrays is not None and getattr(error, "code", "") in _CODES_OF_FAULTS:
            behind = mesh_faults.fault_near(self.arrays, [*outcome.vertices, *vertices_of(error)])
        outcome.refuse(behind or error)

    def sound(self):
        """The contours that can be handed to the search."""
        return [outcome for outcome in self.outcomes if not outcome.problem]

    def done(self):
        """The contours that are output."""
        return [outcome for outcome in self.outcomes if outcome.result is not None and not outcome.problem]

    def fail(self, error):
        """Why nothing can be done with any of the contours that could be handed to the search."""
        for outcome in self.sound():
            outcome.refuse(error)


def optimize_contours(searches, settings, progress=None):
    """Gives each outcome of each search its result, or the problem that keeps it from one."""
    searches = [search for search in searches if search.surface]
    for i, search in enumerate(searches):
        own_progress = fraction_of(progress, i, len(searches))
        steps = 2 if any(outcome.closing for outcome in search.sound()) else 1
        try:
            complete(search, fraction_of(own_progress, 0, steps))
            _optimize_together(search, search.sound(), settings, fraction_of(own_progress, steps - 1, steps))
        except OutsideBand as error:
            search.outside = error.vertices
            find_problems(search, search.sound())  # what is wrong with a contour itself says more
            search.fail(error)
        except ValueError as error:
            search.fail(error)


def complete(search, progress=None):
    """Closes the chains that are to be closed, and turns contours so that what is painted lies to their left."""
    _refuse_split_loops(search)
    _close(search, search.sound(), progress)
    if search.constraints is not None and search.constraints.density is not None:
        _orient_by_density(search)


def find_problems(search, outcomes):
    """Gives each outcome that is no contour the reason why; the others may stay without a result."""
    mrc = native.module()
    barriers = () if search.constraints is None else search.constraints.barriers_beside(native.contours(outcomes))
    for outcome in outcomes:
        error = mrc.check_contour(search.surface, outcome.vertices, closed=outcome.closed, barriers=barriers)
        if error is not None:
            search.refuse(outcome, error)


def _refuse_split_loops(search):
    """What is a loop to the eye, but a chain on a mesh that is split there, has no end to hold."""
    for outcome in search.sound():
        if search.arrays is not None and not outcome.closed:
            fault = mesh_faults.ends_not_joined(search.arrays, outcome.vertices)
            if fault is not None:
                outcome.refuse(fault)


def _close(search, outcomes, progress):
    """Closes the chains that are to be closed. Loops that meet are no contours beside each other: the first has it."""
    taken = {vertex for outcome in outcomes if not outcome.closing for vertex in outcome.vertices.tolist()}
    closing = [outcome for outcome in outcomes if outcome.closing]
    for i, outcome in enumerate(closing):
        own_progress = fraction_of(progress, i, len(closing))
        try:
            loop = native.module().close_contour(search.surface, outcome.vertices, progress=own_progress)
        except ValueError as error:
            search.refuse(outcome, error)
            continue
        if taken.isdisjoint(loop.tolist()):
            outcome.vertices, outcome.closed = loop, True
            taken.update(loop.tolist())
        else:
            outcome.problem = messages.meets_another(outcome.vertices)


def _orient_by_density(search):
    """Turns the contours so that what is painted lies to their left, unless the selected part already lies there."""
    for outcome in search.sound():
        if not outcome.closed:
            outcome.problem = messages.open_region()
        elif not search.from_faces and _paints_the_right(search, outcome):
            outcome.vertices = outcome.vertices[::-1].copy()


def _paints_the_right(search, outcome):
    """Whether the density is greater to the right of a contour; what is no contour has no sides."""
    if problem_on(search.surface, outcome.vertices, outcome.closed):
        return False
    (contour,) = native.contours([outcome])
    return search.constraints.paints_the_right(native.module(), search.surface, contour)


def _optimize_together(search, outcomes, settings, progress):
    """Optimizes all together. One that cannot be optimized has a problem instead, and the others keep clear of it."""
    if not outcomes:
        return
    found = optimize_all_on(
        search.surface,
        native.contours(outcomes),
        progress=progress,
        constraints=search.constraints,
        errors="return",
        **settings,
    )
    for outcome, result in zip(outcomes, found):
        if isinstance(result, ValueError):
            search.refuse(outcome, result)
        else:
            outcome.result = result
            outcome.fault = _fault_met(search, outcome)
            if outcome.fault and result.status == "unchanged":
                outcome.culprits = outcome.fault.elements


def _fault_met(search, outcome):
    """The fault of the mesh that dents a result or has ended the search around a contour that stays; None: none has.

    A result that keeps clear of what its band has met needs no look at the mesh.
    """
    result = outcome.result
    if search.arrays is None or result.status == "cancelled":
        return None
    if result.status == "unchanged" and result.salience < _POOR:
        faces = native.module().band(search.surface, result, options=native.module().Options(width=2))
        beside = mesh_faults.vertices_of(search.arrays, faces)
        return mesh_faults.fault_near(search.arrays, np.concatenate([outcome.vertices, result.non_manifold, beside]))
    if not len(result.non_manifold):
        return None
    ends = np.unique(result.edge_vertices)
    beside = mesh_faults.vertices_of(search.arrays, mesh_faults.faces_at(search.arrays, ends))
    touched = np.intersect1d(beside, result.non_manifold)
    return mesh_faults.fault_near(search.arrays, touched) if len(touched) else None
