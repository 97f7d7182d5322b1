# SPDX-License-Identifier: GPL-3.0-or-later
"""The outcome of each contour: its result, or the problem because of which it was not moved. Does not need Blender."""

from dataclasses import dataclass

import numpy as np

from . import messages, refusals
from .edge_paths import contour_edges


@dataclass
class Outcome:
    """One contour of the selection: its native result, or the problem because of which it was not moved."""

    place: str  # the object's name
    edges: np.ndarray | None  # as selected, (n, 2) vertex pairs; None if nothing could be read
    vertices: np.ndarray | None = None  # in order; None if the edges branch
    closed: bool = True
    closing: bool = False  # whether it is an open chain that is to be closed first
    as_selected: bool = True  # whether just its edges are selected
    beside: np.ndarray | None = None  # (n, 2) edges that are selected too, but hardly meant
    result: object = None
    problem: str = ""
    culprits: tuple = ()  # the elements at which the problem lies, (kind, id), to be shown to the user
    kind: str = ""  # of the problem: the same where only the elements differ
    fault: object = None  # a Refusal that names the fault of the mesh that dents the result, or ended its search
    leaving: tuple = ()  # for each side that is to be separated, whether it is the left one

    @classmethod
    def of(cls, place, vertices, closed, **found):
        return cls(place, contour_edges(vertices, closed), vertices, closed, **found)

    def refuse(self, error):
        """Give it the problem that an error states, and what the error names."""
        self.problem, self.culprits = messages.problem(error), refusals.culprits(error)
        self.kind = refusals.kind(error)


def network_outcomes(place, plan, why_lost):
    """Return the outcome of each chain that could have moved; why_lost(region) says why its region would be lost."""
    taken = plan.taken_results()
    outcomes = []
    for i, chain in enumerate(plan.chains):
        if i in taken:
            outcomes.append(Outcome.of(place, chain.vertices, chain.closed, result=taken[i]))
        elif chain.movable:
            problem = plan.problems.get(i) or why_lost(plan.region_check.lost.get(i, -1))
            outcomes.append(Outcome.of(place, chain.vertices, chain.closed, problem=problem))
    return outcomes
