# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours as polylines in space, closed or open. This module uses only NumPy."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Curve:
    """A polyline on a surface and the outward normals of its points; a closed one does not repeat its first point."""

    points: np.ndarray
    normals: np.ndarray
    closed: bool = True

    def starts(self):
        return self.points if self.closed else self.points[:-1]

    def sides(self):
        return (np.roll(self.points, -1, axis=0) if self.closed else self.points[1:]) - self.starts()


def mean_distance(curve, other):
    """Return the mean distance from the curve's points to another curve."""
    apart, sides = curve.points[:, None] - other.starts()[None], other.sides()
    along = np.clip((apart * sides).sum(axis=2) / (sides**2).sum(axis=1), 0.0, 1.0)
    return np.linalg.norm(apart - along[:, :, None] * sides, axis=2).min(axis=1).mean()
