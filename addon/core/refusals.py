# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors that say where in the mesh their cause lies, so that operators can show the place. Does not need Blender."""

import numpy as np


class Refusal(ValueError):
    """Why something cannot be done, in the user's words, and the vertices at which the cause lies."""

    def __init__(self, message, vertices=()):
        super().__init__(message)
        self.elements = tuple(("vertex", vertex) for vertex in np.unique(np.asarray(vertices, dtype=int)).tolist())


def culprits(error):
    """Return the elements that an error names, (kind, id); the id of an edge is a pair of vertices."""
    return tuple(getattr(error, "elements", ()))
