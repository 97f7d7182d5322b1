# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints one line for each of 1,000 searches. Lines are equal if the results are equal to the last bit.

python tests/python/fingerprints.py
"""

import hashlib

import mrcontour as mrc
import numpy as np
from conftest import realistic_contours, surface_of
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


def bytes_of(result):
    """Every number of a result, to the last bit, and its codes, but not its messages, which may be reworded."""
    arrays = [result.positions, result.edge_vertices, result.edge_parameters, result.history]
    numbers = [result.ratio, result.objective, result.salience, result.lower_bound, result.gap]
    counts = [result.statistics[name] for name in ("faces", "cut", "nodes", "arcs", "linear_steps", "passes")]
    plain = [np.asarray(values).tobytes() for values in (*arrays, numbers, counts)]
    return b"|".join([*plain, result.status.encode(), result.reason_code.encode()])


def fingerprint(surface, contours, closed, options):
    """The hash of a result, which must be the same for one thread and several."""
    found = set()
    for threads in (1, 3):
        try:
            chosen = mrc.Options(**options, threads=threads)
            results = mrc.optimize_all(surface, contours, closed=closed, options=chosen)
            content = b"/".join(map(bytes_of, results))
        except ValueError as error:
            content = type(error).__name__.encode()
        found.add(hashlib.sha256(content).hexdigest()[:16])
    return " ".join(sorted(found)) + (" THREADS DIFFER" if len(found) > 1 else "")


def main():
    realistic = realistic_contours()
    for seed in range(800):
        rng = np.random.default_rng(seed)
        family = FAMILIES[seed % len(FAMILIES)]
        mesh, contour = family(rng)
        closed = family not in (chain, crossing_chain)
        options = random_options(rng) | ({"ends": "border"} if family is crossing_chain else {})
        print(f"{family.__name__}-{seed}", fingerprint(surface_of(mesh), [contour], closed, options))
    for seed in range(200):
        rng = np.random.default_rng(seed)
        name, mesh, contour = realistic[seed % len(realistic)]
        others = [loop for other, same, loop in realistic if same is mesh and not set(loop) & set(contour)]
        print(f"{name}-{seed}", fingerprint(surface_of(mesh), [contour, *others[:2]], True, random_options(rng)))


if __name__ == "__main__":
    main()
