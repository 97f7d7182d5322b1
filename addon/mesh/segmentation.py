# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the borders between the regions of a labeling as a network of contours, and writes the labels back."""

from dataclasses import dataclass, replace

import numpy as np

from ..core import messages
from ..core.chains import make_network
from ..core.outcomes import network_outcomes
from ..core.topology import label_borders, make_topology
from .arrays import read_edge_arrays, read_labels, write_labels

FACE_SETS = ".sculpt_face_set"
SOURCES = ("FACE_SETS", "MATERIAL", "ATTRIBUTE")


class NoLabels(ValueError):
    """The mesh does not have these labels; the message says what to do."""


@dataclass(frozen=True)
class Labeling:
    """The labels of a mesh's faces, and where they are stored."""

    attribute: str  # the name of a face attribute; None for the material slots
    labels: np.ndarray


def read_labeling(obj, source, attribute=""):
    """Return the labels of a synchronized mesh's faces. Raises NoLabels if there are none."""
    if source not in SOURCES:
        raise ValueError(f"the source is {source!r}; it must be one of {', '.join(SOURCES)}")
    name = {"FACE_SETS": FACE_SETS, "MATERIAL": None, "ATTRIBUTE": attribute}[source]
    labels = read_labels(obj, name)
    if labels is None:
        raise NoLabels(messages.no_face_sets() if source == "FACE_SETS" else messages.no_attribute(attribute))
    return Labeling(name, labels)


def read_network(obj, labeling):
    """Return the network of the borders between a synchronized mesh's regions: connected pieces of one label each."""
    topology = make_topology(**vars(read_edge_arrays(obj)))
    return make_network(topology, label_borders(topology, labeling.labels))


def new_labels(labeling, plan):
    """Return the labels of all faces after the borders have moved; a region's id is a face with its old label."""
    return labeling.labels[plan.region_check.after]


def write(obj, labeling, plan):
    """Write the new labels of the faces. The pieces of faces that were cut start with the label of the whole face."""
    if len(labeling.labels) != plan.topology.face_count:
        labeling = replace(labeling, labels=read_labels(obj, labeling.attribute))
    labels = new_labels(labeling, plan)
    changed = np.flatnonzero(labels != labeling.labels)
    write_labels(obj.data, labeling.attribute, changed, labels[changed])


def outcomes(place, labeling, plan):
    """Return the outcome of each border that could have moved."""
    return network_outcomes(place, plan, lambda region: messages.lost_region(labeling.labels, region))
