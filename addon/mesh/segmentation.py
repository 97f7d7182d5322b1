# SPDX-License-Identifier: GPL-3.0-or-later
"""The borders between the regions of a labeling as a network of contours, and back to labels."""

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
    """The mesh has no such labels; the message says what to do."""


@dataclass(frozen=True)
class Labeling:
    """The labels of a mesh's faces, and where they stand: a face attribute's name, or None for the material slots."""

    attribute: str
    labels: np.ndarray


def read_labeling(obj, source, attribute=""):
    """Raises NoLabels."""
    if source not in SOURCES:
        raise ValueError(f"the source is {source!r}; it must be one of {', '.join(SOURCES)}")
    name = {"FACE_SETS": FACE_SETS, "MATERIAL": None, "ATTRIBUTE": attribute}[source]
    labels = read_labels(obj, name)
    if labels is None:
        raise NoLabels(messages.no_face_sets() if source == "FACE_SETS" else messages.no_attribute(attribute))
    return Labeling(name, labels)


def read_network(obj, labeling):
    """The borders between a synchronized mesh's regions.

    A region is one connected piece of one label.
    """
    topology = make_topology(**vars(read_edge_arrays(obj)))
    return make_network(topology, label_borders(topology, labeling.labels))


def new_labels(labeling, plan):
    """The labels of all faces once the borders have moved: regions are named by a face that had their label before."""
    return labeling.labels[plan.region_check.after]


def write(obj, labeling, plan):
    """Labels the faces anew; where contours were cut in, the pieces of a face come with the label of the whole."""
    if len(labeling.labels) != plan.topology.face_count:
        labeling = replace(labeling, labels=read_labels(obj, labeling.attribute))
    labels = new_labels(labeling, plan)
    changed = np.flatnonzero(labels != labeling.labels)
    write_labels(obj.data, labeling.attribute, changed, labels[changed])


def outcomes(place, labeling, plan):
    """What became of each border that could have moved."""
    return network_outcomes(place, plan, lambda region: messages.lost_region(labeling.labels, region))
