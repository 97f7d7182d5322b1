# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the seams of a mesh as a network of contours, and writes them back."""

from ..core.chains import make_network
from ..core.outcomes import network_outcomes
from ..core.topology import make_topology
from . import attributes, edge_marks
from .arrays import read_edge_arrays, read_seams, with_mirror_images, write_seams


def read_network(obj, selected_only=False):
    """Return the network of a synchronized mesh's seams, of which all may move, or only those among its selected edges.

    Every UV island stays one island, on the same side of its seams.
    """
    topology = make_topology(**vars(read_edge_arrays(obj)))
    seams, selected = read_seams(obj)
    chosen = seams & (selected | _images(obj, topology, seams & selected)) if selected_only else seams
    return make_network(topology, seams, chosen)


def lacks_images(obj):
    """Whether X Mirror is on and some selected seam of a synchronized mesh has no mirror image."""
    seams, selected = read_seams(obj)
    return obj.data.use_mirror_x and _with_images(obj, seams & selected) is None


def _images(obj, topology, chosen):
    """Return the chosen edges and, if X Mirror is on and the mesh is symmetric, their mirror images."""
    both = _with_images(obj, chosen) if obj.data.use_mirror_x and chosen.any() else None
    if both is None:
        return chosen
    images = chosen.copy()
    images[topology.find(both)[0]] = True
    return images


def _with_images(obj, chosen):
    edges = read_edge_arrays(obj).edges[chosen]
    return with_mirror_images(obj, edges, may_branch=True) if len(edges) else edges


def only_seams_selected(obj):
    """Whether only seams of a synchronized mesh are selected; then the selection moves with them."""
    seams, selected = read_seams(obj)
    return not (selected & ~seams).any()


def write(obj, plan, selection=False):
    """Move the seams and, with `selection` in Edit Mode, the selection along them."""
    if attributes.is_edited(obj):
        edge_marks.move_mark(obj.data, "SEAM", plan.old_edges(), plan.new_edges(), selection)
    else:
        edges = (plan.topology.find(pairs)[0] for pairs in (plan.old_edges(), plan.new_edges()))
        write_seams(obj.data, *edges)


def outcomes(place, plan):
    """Return the outcome of each chain that could have moved."""
    return network_outcomes(place, plan, lambda _: "a seam whose move would join or split islands")
