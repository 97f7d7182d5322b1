# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for contours: of scripts on a native surface, and of all that are selected. Needs no Blender.

All of it may run in any thread.
"""

from dataclasses import dataclass

from . import messages, native
from .native_constraints import OutsideBand, native_keywords


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


@dataclass
class ContourSearch:
    """The contours of one mesh, which are searched together."""

    outcomes: list
    from_faces: bool = False  # whether they are borders of selected faces, which then lie to their left
    arrays: object = None  # of the mesh, where there is something to optimize
    surface: object = None  # the native one made from them
    constraints: object = None  # what the mesh's layers ask of the contours
    outside: tuple = ()  # required vertices where nothing is searched

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
    _close(search.surface, search.sound(), progress)
    if search.constraints is not None and search.constraints.density is not None:
        _orient_by_density(search)


def find_problems(search, outcomes):
    """Gives each outcome that is no contour the reason why; the others may stay without a result."""
    mrc = native.module()
    barriers = () if search.constraints is None else search.constraints.barriers_beside(native.contours(outcomes))
    for outcome in outcomes:
        error = mrc.check_contour(search.surface, outcome.vertices, closed=outcome.closed, barriers=barriers)
        if error is not None:
            outcome.refuse(error)


def _close(surface, outcomes, progress):
    """Closes the chains that are to be closed. Loops that meet are no contours beside each other: the first has it."""
    taken = {vertex for outcome in outcomes if not outcome.closing for vertex in outcome.vertices.tolist()}
    closing = [outcome for outcome in outcomes if outcome.closing]
    for i, outcome in enumerate(closing):
        own_progress = fraction_of(progress, i, len(closing))
        try:
            loop = native.module().close_contour(surface, outcome.vertices, progress=own_progress)
        except ValueError as error:
            outcome.refuse(error)
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
            outcome.refuse(result)
        else:
            outcome.result = result
