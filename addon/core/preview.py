# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours of one mesh that are searched again at every change, and what to show of them. Needs no Blender.

The surface and the mesh's arrays are made once; every later step touches the faces of the bands alone.
"""

from dataclasses import dataclass

import numpy as np

from . import native, parameters
from .native_constraints import native_keywords

_PARALLEL = 1e-12  # of the product of lengths: a triangle seen edge on is not hit


@dataclass(frozen=True)
class Shapes:
    """What is drawn of one mesh, as float32 points in object space."""

    band: np.ndarray  # (3 n, 3): the corners of triangles
    given: np.ndarray  # (2 n, 3): the ends of segments
    found: np.ndarray  # (2 n, 3)
    pins: np.ndarray  # (n, 3)


class Preview:
    """The contours of one mesh; `first` is the place of its first contour among those of all meshes."""

    def __init__(self, arrays, surface, outcomes, first=0, constraints=None):
        self.arrays, self.surface, self.outcomes, self.first = arrays, surface, outcomes, first
        self._constraints = constraints
        self.bands = [np.empty(0, dtype=np.int32) for _ in outcomes]  # face ids
        self._given = _joined([_segments(arrays.positions[outcome.vertices], outcome.closed) for outcome in outcomes])

    def search(self, state):
        """Gives each outcome its result for these settings and pins; a ValueError leaves bands alone."""
        mrc = native.module()
        for outcome in self.outcomes:
            outcome.result = None
        contours = native.contours(self.outcomes)
        options = mrc.Options(**parameters.native_options(**state.settings))
        self.bands = [mrc.band(self.surface, contour, options=options) for contour in contours]
        keywords = native_keywords(mrc, self.surface, contours, state.settings, self._constraints)
        pins = [state.pins_of(self.first + place) for place in range(len(contours))]
        required = keywords.setdefault("required_vertices", [[] for _ in pins])
        keywords["required_vertices"] = [np.union1d(*lists).astype(np.int32) for lists in zip(required, pins)]
        found = mrc.optimize_all(self.surface, contours, errors="return", **keywords)
        for error in found:
            if isinstance(error, ValueError):
                raise error
        for outcome, result in zip(self.outcomes, found):
            outcome.result = result

    def pins_outside(self, state):
        """How many pins lie outside the band of their contour."""
        return sum(
            np.count_nonzero(~np.isin(state.pins_of(self.first + place), self._triangles(band)))
            for place, band in enumerate(self.bands)
        )

    def shapes(self, state):
        """What to draw after a search."""
        positions = self.arrays.positions
        triangles = self._triangles(np.unique(np.concatenate(self.bands)))
        found = [outcome.result for outcome in self.outcomes if outcome.result is not None]
        pins = [vertex for place in range(len(self.outcomes)) for vertex in state.pins_of(self.first + place)]
        return Shapes(
            band=positions[triangles.ravel()].astype(np.float32),
            given=self._given,
            found=_joined([_segments(result.positions, result.closed) for result in found]),
            pins=positions[np.array(pins, dtype=np.intp)].astype(np.float32),
        )

    def pick(self, origin, direction):
        """What a ray hits: (fraction of the ray, contour, vertex), the corner of the band's face nearest to the hit.

        None where it passes the bands by. Where bands overlap, the nearest contour gets the vertex.
        """
        origin, direction = np.asarray(origin, dtype=float), np.asarray(direction, dtype=float)
        faces = np.unique(np.concatenate(self.bands))
        triangles, owners = self._triangles(faces), np.repeat(faces, self._triangle_counts(faces))
        fraction, hit = _first_hit(origin, direction, self.arrays.positions[triangles])
        if hit is None:
            return None
        offsets, positions = self.arrays.face_offsets, self.arrays.positions
        corners = self.arrays.face_vertices[offsets[owners[hit]] : offsets[owners[hit] + 1]]
        point = origin + fraction * direction
        vertex = corners[np.argmin(np.linalg.norm(positions[corners] - point, axis=1))]
        return fraction, self.first + self._nearest_contour(owners[hit], vertex), int(vertex)

    def _nearest_contour(self, face, vertex):
        positions = self.arrays.positions
        distances = [
            np.linalg.norm(positions[outcome.vertices] - positions[vertex], axis=1).min() if face in band else np.inf
            for outcome, band in zip(self.outcomes, self.bands)
        ]
        return int(np.argmin(distances))

    def _triangle_counts(self, faces):
        offsets = self.arrays.face_offsets
        return offsets[faces + 1] - offsets[faces] - 2

    def _triangles(self, faces):
        """The (n, 3) triangles of some faces: a face of n corners has n - 2, in face order."""
        counts = self._triangle_counts(faces)
        before = np.cumsum(counts) - counts
        first = self.arrays.face_offsets[faces] - 2 * faces
        return self.arrays.triangles[np.repeat(first - before, counts) + np.arange(counts.sum())]


def _segments(points, closed):
    """The ends of the segments from each point to the next."""
    following = np.roll(points, -1, axis=0)
    pairs = np.stack([points, following], axis=1).astype(np.float32)
    return (pairs if closed else pairs[:-1]).reshape(-1, 3)


def _joined(point_lists):
    return np.concatenate([np.empty((0, 3), dtype=np.float32), *point_lists])


def _first_hit(origin, direction, corners):
    """The first of (n, 3, 3) triangles that a ray hits: (fraction of the direction, place); by Moller and Trumbore."""
    start = corners[:, 0]
    first, second = corners[:, 1] - start, corners[:, 2] - start
    across = np.cross(direction, second)
    determinant = np.einsum("ij,ij->i", first, across)
    size = np.linalg.norm(direction) * np.linalg.norm(first, axis=1) * np.linalg.norm(second, axis=1)
    determinant = np.where(np.abs(determinant) > _PARALLEL * size, determinant, np.nan)
    offset = origin - start
    normal = np.cross(offset, first)
    u = np.einsum("ij,ij->i", offset, across) / determinant
    v = normal @ direction / determinant
    fraction = np.einsum("ij,ij->i", second, normal) / determinant
    hits = np.flatnonzero((u >= 0) & (v >= 0) & (u + v <= 1) & (fraction > 0))
    if len(hits) == 0:
        return None, None
    nearest = hits[np.argmin(fraction[hits])]
    return fraction[nearest], nearest
