# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults of a mesh that keep contours from being searched: their names, places and Blender's cures. Needs no Blender.

They are looked for where a search has failed or stopped, among the faces there. `arrays` are those of
mrcontour.Surface.
"""

import numpy as np

from .edge_paths import component_labels
from .refusals import Refusal

_SAME_PLACE = 1e-4  # of the mean edge length: vertices this close to each other lie at the same place

NOT_JOINED = "faces are not joined here, since each has its own vertices: select all, then Mesh > Merge > By Distance"
DOUBLED = "faces lie on top of each other, on the same vertices: delete one of each two (X > Faces)"
WALLED = (
    "walls inside the mesh, or fins on it, meet it in an edge of more than two faces: delete their faces "
    "(Select > All by Trait > Interior Faces or Non Manifold)"
)
FLIPPED = "the normals of neighboring faces disagree: select all, then Mesh > Normals > Recalculate Outside (Shift N)"
PINCHED = "faces meet in a single point: rip that vertex (V) and move the halves apart, or delete the faces on one side"


def fault_near(arrays, vertices):
    """The fault of the faces at these vertices, as a Refusal that names its elements; None where there is none."""
    near = _Faces.around(arrays, vertices)
    return _doubled(arrays, near) or _not_joined(arrays, near) or _walled(near) or _flipped(near) or _pinched(near)


def not_joined(arrays, vertices):
    """The same of a single fault: some of these vertices lie where others do, without a face that joins them."""
    return _not_joined(arrays, _Faces.around(arrays, vertices))


def ends_not_joined(arrays, vertices):
    """The fault of a chain whose ends lie at the same place: it is a loop on a mesh that is split there."""
    first, last = int(vertices[0]), int(vertices[-1])
    apart = np.linalg.norm(arrays.positions[first] - arrays.positions[last])
    steps = np.linalg.norm(np.diff(arrays.positions[np.asarray(vertices)], axis=0), axis=1)
    return Refusal(NOT_JOINED, [first, last], code="not_joined") if apart <= _SAME_PLACE * steps.mean() else None


def faces_at(arrays, vertices):
    """The faces that have one of these vertices, ascending."""
    chosen = np.zeros(len(arrays.positions), dtype=bool)
    chosen[np.asarray(vertices, dtype=int)] = True
    corners = np.flatnonzero(chosen[arrays.face_vertices])
    return np.unique(np.searchsorted(arrays.face_offsets, corners, side="right") - 1)


def vertices_of(arrays, faces):
    """The vertices of some faces, ascending."""
    return np.unique(_Faces(arrays, np.asarray(faces, dtype=int)).corners)


class _Faces:
    """Some faces, with their sides and edges."""

    whole: np.ndarray  # vertices all of whose faces are here
    complete: np.ndarray  # of each edge, whether all of its faces are here

    @classmethod
    def around(cls, arrays, vertices):
        """All faces at the vertices of the faces at these vertices."""
        near = cls(arrays, faces_at(arrays, vertices))
        whole = np.union1d(near.corners, np.asarray(vertices, dtype=int))
        found = cls(arrays, faces_at(arrays, whole))
        found.whole, found.complete = whole, np.any(np.isin(found.edges, whole), axis=1)
        return found

    def __init__(self, arrays, faces):
        counts = np.diff(arrays.face_offsets)[faces]
        starts = np.cumsum(counts) - counts
        place = np.arange(counts.sum()) - np.repeat(starts, counts)  # of each corner in its face
        first = np.repeat(arrays.face_offsets[faces], counts)
        self.faces, self.counts, self.starts = faces, counts, starts
        self.following = starts.repeat(counts) + np.where(place + 1 < np.repeat(counts, counts), place + 1, 0)
        self.corners = arrays.face_vertices[first + place]
        self.sides = np.column_stack([self.corners, self.corners[self.following]])
        self.edges, self.edge_of, self.uses = np.unique(
            np.sort(self.sides, axis=1), axis=0, return_inverse=True, return_counts=True
        )
        self.edge_of = self.edge_of.ravel()  # NumPy 2.0 alone gives it another shape

    @property
    def forward(self):
        """Which sides lead from their lower vertex to their upper one."""
        return self.sides[:, 0] < self.sides[:, 1]

    def fans(self):
        """The fan of each corner: faces at its vertex that are joined by edges there."""
        corner = np.arange(len(self.corners))
        low = np.where(self.forward, corner, self.following)
        high = np.where(self.forward, self.following, corner)
        order = np.argsort(self.edge_of, kind="stable")
        shared = self.edge_of[order[1:]] == self.edge_of[order[:-1]]
        one, other = order[:-1][shared], order[1:][shared]
        links = np.concatenate([np.column_stack([ends[one], ends[other]]) for ends in (low, high)])
        return component_labels(links, len(corner))


def _doubled(arrays, near):
    """The faces that have the same vertices as another one with a lower number, all over the mesh if some are near."""
    if not len(_copies(near)):
        return None
    everywhere = _Faces(arrays, np.arange(len(arrays.face_offsets) - 1))
    return _refusal(DOUBLED, "face", _copies(everywhere), "doubled")


def _copies(some):
    found = []
    for count in np.unique(some.counts):
        chosen = np.flatnonzero(some.counts == count)
        rows = np.sort(some.corners[some.starts[chosen][:, None] + np.arange(count)], axis=1)
        _, first, group = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        copies = np.arange(len(rows)) != first[group.ravel()]
        found.append(some.faces[chosen[copies]])
    return np.sort(np.concatenate(found)) if found else np.empty(0, dtype=int)


def _not_joined(arrays, near):
    """Vertices on borders that lie at the same place as others on borders."""
    border = np.intersect1d(near.edges[near.complete & (near.uses == 1)], near.whole)
    if not len(border):
        return None
    tolerance = _SAME_PLACE * np.linalg.norm(np.subtract(*arrays.positions[near.edges.T]), axis=1).mean()
    twins = _at_the_same_place(arrays.positions, border, tolerance)
    if len(twins) == 0:
        return None
    others = _Faces.around(arrays, twins[:, 1])
    open_ends = np.unique(others.edges[others.complete & (others.uses == 1)])
    pairs = twins[np.isin(twins[:, 1], open_ends)]
    return _refusal(NOT_JOINED, "vertex", np.unique(pairs), "not_joined") if len(pairs) else None


def _at_the_same_place(positions, vertices, tolerance):
    """Rows (vertex, other vertex) of those that are no farther from each other than this."""
    low, high = positions[vertices].min(axis=0) - tolerance, positions[vertices].max(axis=0) + tolerance
    others = np.flatnonzero(np.all((positions >= low) & (positions <= high), axis=1))
    order = others[np.argsort(positions[others, 0], kind="stable")]
    xs = positions[order, 0]
    pairs = []
    for vertex in np.asarray(vertices).tolist():
        x = positions[vertex, 0]
        some = order[np.searchsorted(xs, x - tolerance) : np.searchsorted(xs, x + tolerance, side="right")]
        close = some[np.linalg.norm(positions[some] - positions[vertex], axis=1) <= tolerance]
        pairs += [(vertex, other) for other in close.tolist() if other != vertex]
    return np.array(pairs, dtype=int).reshape(-1, 2)


def _walled(near):
    return _refusal(WALLED, "edge", near.edges[near.complete & (near.uses > 2)], "walled")


def _flipped(near):
    forward = np.bincount(near.edge_of[near.forward], minlength=len(near.edges))
    return _refusal(FLIPPED, "edge", near.edges[near.complete & (near.uses == 2) & (forward != 1)], "flipped")


def _pinched(near):
    fans = np.unique(np.column_stack([near.corners, near.fans()]), axis=0)
    vertices, counts = np.unique(fans[:, 0], return_counts=True)
    return _refusal(PINCHED, "vertex", np.intersect1d(vertices[counts > 1], near.whole), "pinched")


def _refusal(message, kind, elements, code):
    """A Refusal that names these elements; None where there are none."""
    ids = [tuple(one) if kind == "edge" else one for one in np.asarray(elements).tolist()]
    return Refusal(message, elements=[(kind, one) for one in ids], code=code) if ids else None
