# SPDX-License-Identifier: GPL-3.0-or-later
"""Length bias (6.1.1): by arc length, against enumeration and (refined) the independent solver with labels of length
and energy; by the number of edges, against the dynamic program of appendix A."""

from math import inf

import numpy as np
import pytest
from random_cases import Case, annulus, chain, check_optimum, cylinder, random_energy, seeds, torus

FAMILIES = [annulus, cylinder, torus, chain]
AFFORDABLE = 20000  # the maximum number of contours to enumerate


def biased_case(seed, k, **more):
    rng = np.random.default_rng([seed, k, len(more)])
    family = FAMILIES[seed % 4]
    while True:
        mesh, contour = family(rng)
        options = {
            "refinement": k,
            "width": int(rng.integers(1, 4)),
            "ends": "vertices",
            "length_bias": float(rng.choice([0.05, 0.5, 2.0, 10.0])),
            "length_floor": float(rng.choice([0.0, 0.8, 1.1])),
            **random_energy(rng),
            **more,
        }
        case = Case(mesh, contour, options, closed=family is not chain, dense="denominator" in more)
        if k > 0 or "denominator" in more or case.graph.count() <= AFFORDABLE:
            return case


@seeds(60)
def test_matches_enumeration_by_arc_length(seed):
    case = biased_case(seed, 0)
    objective = case.energy.objective
    least = min((objective(F, G) for _, F, G in case.graph.paths()), default=inf)
    check_optimum(case, min(least, case.given_objective()))


@pytest.mark.parametrize("floor", [0.0, 0.8, 1.1])
@seeds(20, 70)
def test_matches_the_independent_solver_by_arc_length_refined(floor, seed):
    case = biased_case(seed, 1, width=1 + seed % 2, length_floor=floor)
    check_optimum(case, case.graph.best_with_bias(case.given_objective()))


@pytest.mark.parametrize("k", [0, 1])
@seeds(60)
def test_matches_the_dynamic_program_by_number_of_edges(seed, k):
    case = biased_case(seed, k, denominator="arcs", length_measure="edges")
    least = case.graph.best_by_count(case.energy.objective)
    check_optimum(case, min(least, case.given_objective()))
