# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the 1,000 searches of fingerprints.py."""

import numpy as np
from conftest import realistic_contours
from random_cases import annulus, chain, crossing_chain, cylinder, random_energy, torus

FAMILIES = [annulus, cylinder, torus, chain, crossing_chain]
FLOWS = ["gates", "arc_length", "harmonic"]


def random_options(rng):
    return {
        "flow": str(rng.choice(FLOWS)),
        "width": int(rng.integers(1, 6)),
        "refinement": int(rng.choice([0, 0, 1, 2])),
        "iterations": int(rng.integers(1, 4)),
        "length_bias": float(rng.choice([0.0, 0.0, 1.5])),
        "anchor": float(rng.choice([0.0, 0.7])),
        **random_energy(rng),
    }


def case(name, mesh, contours, closed, options):
    return {
        "name": name,
        "mesh": [part.tolist() for part in mesh.arguments()],
        "contours": [np.asarray(contour).tolist() for contour in contours],
        "closed": closed,
        "options": options,
    }


def made_cases():
    """Yields the cases, ready for JSON, which keeps numbers exactly. As NumPy does, they may differ by processor."""
    for seed in range(800):
        rng = np.random.default_rng(seed)
        family = FAMILIES[seed % len(FAMILIES)]
        mesh, contour = family(rng)
        closed = family not in (chain, crossing_chain)
        options = random_options(rng) | ({"ends": "border"} if family is crossing_chain else {})
        yield case(f"{family.__name__}-{seed}", mesh, [contour], closed, options)
    realistic = realistic_contours()
    for seed in range(200):
        rng = np.random.default_rng(seed)
        name, mesh, contour = realistic[seed % len(realistic)]
        others = [loop for other, same, loop in realistic if same is mesh and not set(loop) & set(contour)]
        yield case(f"{name}-{seed}", mesh, [contour, *others[:2]], True, random_options(rng))
