# SPDX-License-Identifier: GPL-3.0-or-later
"""The optimum with the region term (6.1.2): regular, against enumeration with winding numbers of faces; refined,
against the independent solver with a least-squares 1-form."""

import numpy as np
import pytest
from brute_force import edges_of
from contour_energy import PointEnergy
from contour_graph import ContourGraph
from random_cases import Case, annulus, check_optimum, cylinder, random_energy, seeds, torus

FAMILIES = [annulus, cylinder, torus]
FLOWS = ["harmonic", "gates", "harmonic", "arc_length"]
AFFORDABLE = 3000  # the maximum number of contours to enumerate


def region_case(k, side, seed):
    rng = np.random.default_rng([seed, k, len(side)])
    while True:
        mesh, contour = FAMILIES[seed % 3](rng)
        options = {
            "refinement": k,
            "width": int(rng.integers(1, 3 if k else 4)),
            "flow": FLOWS[seed % 4],
            "region_side": side,
            "region_weight": float(rng.choice([-8.0, -1.5, 0.3, 2.0, 10.0])),
            **random_energy(rng),
        }
        density = rng.uniform(-1.0, 2.0, len(mesh.faces)) * (rng.random(len(mesh.faces)) < 0.8)
        case = Case(mesh, contour, options, region_density=density)
        if k or case.graph.count() <= AFFORDABLE:
            return case


def polygon_areas(mesh):
    areas = []
    for face in mesh.faces:
        x = mesh.positions[list(face)]
        areas.append(np.linalg.norm(sum(np.cross(p, q) for p, q in edges_of(list(x)))) / 2)
    return np.array(areas)


class Winding:
    """How many more times a contour winds around each face of the band than the given one does.

    It is 0 outside the band, and changes across each edge by the number of times that either contour runs along it.
    """

    def __init__(self, case):
        geometry, faces = case.energy.geometry, set(case.space["faces"].tolist())
        self.content = case.constraints["region_density"] * polygon_areas(case.mesh)
        self.given = set(edges_of([p[0] for p in case.given]))

        def beyond(a, b):
            """The face of the band on the other side of an edge of a face, or -1."""
            other = geometry.left_face.get((b, a), -1)
            return other if other in faces else -1

        sides = [(face, edge) for face in sorted(faces) for edge in geometry.face_edges[face]]
        start, edge = next((face, edge) for face, edge in sides if beyond(*edge) == -1)
        met, self.steps = (
            {start},
            [(start, edge, -1)],
        )  # face, its edge, the face beyond: visits each face once, from outside
        for face, _, _ in self.steps:
            for a, b in geometry.face_edges[face]:
                other = beyond(a, b)
                if other not in met and other != -1:
                    met.add(other)
                    self.steps.append((other, (b, a), face))
        assert met == faces

    def change(self, corners):
        """The change of the integral enclosed on the left."""
        found = set(edges_of(corners))
        winds = {-1: 0}
        for face, edge, other in self.steps:
            runs = [(edge in one) - (edge[::-1] in one) for one in (found, self.given)]
            winds[face] = winds[other] + runs[0] - runs[1]
        return sum(self.content[face] * times for face, times in winds.items() if times)


def least_by_enumeration(case):
    plain = PointEnergy(case.mesh, case.given, True, case.options)
    winding = Winding(case)
    sums = [(F, G, [p[0] for p in path]) for path, F, G in ContourGraph(plain, case.space).paths()]
    sums.append((*plain.sums(case.given), [p[0] for p in case.given]))
    return min((F + plain.region_factor() * winding.change(corners)) / G for F, G, corners in sums)


@pytest.mark.parametrize("side", ["left", "right"])
@seeds(40)
def test_regular_optimum_with_region_matches_enumeration(side, seed):
    case = region_case(0, side, seed)
    check_optimum(case, least_by_enumeration(case))


@pytest.mark.parametrize("side", ["left", "right"])
@seeds(20)
def test_refined_optimum_with_region_matches_the_independent_solver(side, seed):
    check_optimum(region_case(1, side, seed))
