# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors that say where in the mesh their cause lies, so that operators can show the place. Does not need Blender."""

import numpy as np


class Refusal(ValueError):
    """Why something cannot be done, in the user's words, and the elements at which the cause lies.

    `code` is the same for all errors of one kind, whatever they name.
    """

    def __init__(self, message, vertices=(), elements=(), code=""):
        super().__init__(message)
        named = np.unique(np.asarray(vertices, dtype=int)).tolist()
        self.elements = tuple(("vertex", vertex) for vertex in named) + tuple(elements)
        self.code = code


def culprits(error):
    """Return the elements that an error names, (kind, id); the id of an edge is a pair of vertices."""
    return tuple(getattr(error, "elements", ()))


def vertices_of(error):
    """Return the vertices among what an error names, and those of its edges."""
    found = []
    for kind_of, one in culprits(error):
        found += {"vertex": [one], "edge": one}.get(kind_of, [])
    return found


def kind(error):
    """Return what errors have in common that differ in the elements they name alone."""
    return getattr(error, "code", "") or str(error)
