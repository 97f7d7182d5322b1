# SPDX-License-Identifier: GPL-3.0-or-later
"""Sorts selected edges, or the borders of faces, into loops, chains and branching pieces. Does not need Blender."""

from dataclasses import dataclass, field

import numpy as np

_MIRROR_TOLERANCE = 2e-5  # as Blender's own


@dataclass(frozen=True)
class SelectedContours:
    """The connected pieces of a selection; each list is in the order of the pieces' lowest vertices."""

    loops: list = field(default_factory=list)  # vertices in order; the first is not repeated
    chains: list = field(default_factory=list)  # vertices from one end to the other
    branching: list = field(default_factory=list)  # (n, 2) edges of a piece with a vertex of three or more edges


def sort_edges(edges):
    """Sort (n, 2) edges into closed loops, open chains and branching pieces."""
    edges = np.asarray(edges).reshape(-1, 2)
    vertices, ends = np.unique(edges, return_inverse=True)
    ends = ends.reshape(-1, 2)
    degrees = np.bincount(ends.ravel(), minlength=len(vertices))
    labels = component_labels(ends, len(vertices))
    branching = np.unique(labels[degrees > 2])
    open_ended = np.setdiff1d(labels[degrees == 1], branching)
    closed = np.setdiff1d(labels, np.union1d(branching, open_ended))

    neighbors = _neighbor_pairs(ends, degrees)
    lowest_ends = [np.flatnonzero((labels == label) & (degrees == 1))[0] for label in open_ended]
    edge_labels = labels[ends[:, 0]]
    return SelectedContours(
        loops=[vertices[_walk(neighbors, start)] for start in closed],
        chains=[vertices[_walk(neighbors, start)] for start in lowest_ends],
        branching=[edges[edge_labels == label] for label in branching],
    )


def sort_directed_edges(edges):
    """Do the same as sort_edges, and give loops and chains the direction of the edges that they are made of."""
    pieces = sort_edges(edges)
    return SelectedContours(
        [along(loop, edges) for loop in pieces.loops],
        [along(chain, edges, closed=False) for chain in pieces.chains],
        pieces.branching,
    )


def all_edges(pieces):
    """Return the (n, 2) edges of all pieces together, in the direction of loops and chains."""
    found = [contour_edges(loop) for loop in pieces.loops]
    found += [contour_edges(chain, closed=False) for chain in pieces.chains]
    return np.concatenate([np.empty((0, 2), dtype=np.int32), *found, *pieces.branching])


def branch_vertices(edges):
    """Return the vertices at which three or more of the (n, 2) edges meet."""
    vertices, counts = np.unique(edges, return_counts=True)
    return vertices[counts > 2]


def contour_edges(vertices, closed=True):
    """Return the (n, 2) vertex pairs along a contour."""
    vertices = np.asarray(vertices)
    pairs = np.column_stack([vertices, np.roll(vertices, -1)])
    return pairs if closed else pairs[:-1]


def along(vertices, directed_edges, closed=True):
    """Return a loop or chain in the direction of the (n, 2) edges it was made from, judged by its first edge."""
    first, second = vertices[:2]
    if np.any((directed_edges[:, 0] == first) & (directed_edges[:, 1] == second)):
        return vertices
    return np.roll(vertices[::-1], 1) if closed else vertices[::-1]


def with_mirror_images(edges, points, visible_edges, tolerance=_MIRROR_TOLERANCE):
    """Return the (n, 2) edges and their reversed mirror images across x = 0.

    Return None if an image is missing, or if the images and the edges would branch where the edges did not.
    """
    both = with_images(edges, points, visible_edges, tolerance)
    if both is None:
        return None
    return both if len(sort_edges(both).branching) <= len(sort_edges(edges).branching) else None


def with_images(edges, points, visible_edges, tolerance=_MIRROR_TOLERANCE):
    """Do the same as with_mirror_images, but allow images to branch off the edges.

    Images are reversed, so that what lies to the left of an edge also lies to the left of its image.
    """
    vertices, ends = np.unique(edges, return_inverse=True)
    images = _mirror_images(points, vertices, tolerance)[ends].reshape(-1, 2)[:, ::-1]
    if np.any(images < 0) or len(common_edges(images, _among(visible_edges, images))) < len(images):
        return None
    own = {frozenset(pair) for pair in edges.tolist()}
    return np.concatenate([edges, images[[frozenset(pair) not in own for pair in images.tolist()]]])


def common_edges(edges, others):
    """Return those of the (n, 2) edges that are also among the others, in either direction."""
    edges, others = (np.asarray(pairs).reshape(-1, 2) for pairs in (edges, others))
    known = {frozenset(pair) for pair in others.tolist()}
    return edges[[frozenset(pair) in known for pair in edges.tolist()]]


def region_border(face_offsets, corner_edges, selected, hidden, edge_count):
    """Return the edges between a selected face and a visible face that is not selected.

    Where the selection reaches the mesh border or hidden faces, it has no border that could move.
    """
    corner_faces = np.repeat(np.arange(len(selected)), np.diff(face_offsets))
    inside = np.zeros(edge_count, dtype=bool)
    inside[corner_edges[selected[corner_faces]]] = True
    outside = np.zeros(edge_count, dtype=bool)
    outside[corner_edges[~(selected | hidden)[corner_faces]]] = True
    return np.flatnonzero(inside & outside)


def _among(edges, some):
    """Return the edges whose ends both occur in `some`, which may be edges or vertices."""
    return edges[np.isin(edges, some).all(axis=1)]


def _mirror_images(points, vertices, tolerance):
    """Return for each of the vertices the point at its mirror image across x = 0, or -1 if there is none."""
    order = np.argsort(points[:, 0], kind="stable")
    sorted_x = points[order, 0]
    images = []
    for target in points[vertices] * (-1, 1, 1):
        first, last = np.searchsorted(sorted_x, (target[0] - tolerance, target[0] + tolerance))
        near = order[first:last]
        distances = np.linalg.norm(points[near] - target, axis=1)
        images.append(near[np.argmin(distances)] if np.any(distances <= tolerance) else -1)
    return np.array(images, dtype=np.int32)


def component_labels(ends, count):
    """Return for each element the lowest member of its connected component, given (n, 2) connections.

    Higher roots are hooked onto lower ones until nothing changes. Where several lower roots compete for a higher one,
    any of them may win: the lowest root of a component is never hooked.
    """
    labels = np.arange(count, dtype=ends.dtype)
    one, other = ends[:, 0], ends[:, 1]
    while len(one):
        labels[np.maximum(one, other)] = np.minimum(one, other)
        while not np.array_equal(labels, above := labels[labels]):
            labels = above
        one, other = labels[one], labels[other]
        apart = one != other
        one, other = one[apart], other[apart]
    return labels


def _neighbor_pairs(ends, degrees):
    """Return two neighbors of each vertex, the lower one first; -1 where there is no second. Ignore further ones."""
    tails, heads = ends.ravel(), ends[:, ::-1].ravel()
    heads = np.append(heads[np.lexsort((heads, tails))], -1)
    first = np.cumsum(degrees) - degrees
    return np.column_stack([heads[first], np.where(degrees > 1, heads[first + 1], -1)])


def _walk(neighbors, start):
    """Return the vertices from start to the end of the chain, or once around the loop."""
    path = [start]
    previous, current = -1, start
    while True:
        one, other = neighbors[current]
        following = one if one != previous else other
        if following in (-1, start):
            return np.array(path)
        path.append(following)
        previous, current = current, following
