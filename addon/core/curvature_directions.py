# SPDX-License-Identifier: GPL-3.0-or-later
"""Short lines along the valleys that attract contours. Does not need Blender."""

import numpy as np

_NOTABLE = 0.25  # fraction of the curvature that has the full color
_FLAT = 1e-4  # divided by the edge length; smaller curvatures are rounding errors, as in the native module
_LENGTH = 0.6  # fraction of the mean edge length around a vertex, so that the lines of neighbors do not touch


def segments(arrays, curvature, full):
    """Return the ends of a line at each visible vertex that is notably concave, (2 n, 3) float32.

    The direction of kappa_max runs along a valley, since kappa_min is the curvature across it (3.4).
    """
    lengths = edge_lengths(arrays)
    concave = -np.asarray(curvature.kappa_min)
    shown = _visible(arrays) & (concave >= _NOTABLE * full) & (concave * lengths > _FLAT)
    middles = arrays.positions[shown]
    halves = np.asarray(curvature.direction_max)[shown] * (_LENGTH / 2 * lengths[shown, None])
    return np.stack([middles - halves, middles + halves], axis=1).reshape(-1, 3).astype(np.float32)


def edge_lengths(arrays):
    """Return the mean edge length around each vertex, with edges of two faces counted twice; 0 where no face is."""
    tails, heads = arrays.face_vertices, arrays.face_vertices[_following_corners(arrays.face_offsets)]
    lengths = np.linalg.norm(arrays.positions[heads] - arrays.positions[tails], axis=1)
    ends, count = np.concatenate([tails, heads]), len(arrays.positions)
    sums = np.bincount(ends, np.tile(lengths, 2), minlength=count)
    return sums / np.maximum(np.bincount(ends, minlength=count), 1)


def _following_corners(face_offsets):
    following = np.arange(1, face_offsets[-1] + 1)
    following[face_offsets[1:] - 1] = face_offsets[:-1]
    return following


def _visible(arrays):
    """Return for each vertex whether a visible face uses it."""
    face_shown = np.ones(len(arrays.face_offsets) - 1, dtype=bool)
    face_shown[arrays.hidden_faces] = False
    visible = np.zeros(len(arrays.positions), dtype=bool)
    visible[arrays.face_vertices[np.repeat(face_shown, np.diff(arrays.face_offsets))]] = True
    return visible
