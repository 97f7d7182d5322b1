# SPDX-License-Identifier: GPL-3.0-or-later
"""What became of each contour: its result, or the problem for which it was left as it is. Needs no Blender."""

from dataclasses import dataclass

import numpy as np

from .edge_paths import contour_edges


@dataclass
class Outcome:
    """One contour of the selection: its native result, or the problem for which it was left as it is."""

    place: str  # the object's name
    edges: np.ndarray | None  # as selected, (n, 2) vertex pairs; None where nothing could be read
    vertices: np.ndarray | None = None  # in order, where the edges do not branch
    closed: bool = True
    closing: bool = False  # an open chain as selected, which is closed first
    result: object = None
    problem: str = ""
    leaving: tuple = ()  # where parts are to be separated: whether on the left, for each side that leaves

    @classmethod
    def of(cls, place, vertices, closed, **found):
        return cls(place, contour_edges(vertices, closed), vertices, closed, **found)


def network_outcomes(place, plan, why_lost):
    """What became of each chain of a network that could have moved; why_lost explains a region that would be lost."""
    taken = plan.taken_results()
    outcomes = []
    for i, chain in enumerate(plan.chains):
        if i in taken:
            outcomes.append(Outcome.of(place, chain.vertices, chain.closed, result=taken[i]))
        elif chain.movable:
            problem = plan.problems.get(i) or why_lost(plan.region_check.lost.get(i, -1))
            outcomes.append(Outcome.of(place, chain.vertices, chain.closed, problem=problem))
    return outcomes
