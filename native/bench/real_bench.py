# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures real contours through the Python module, and NumPy and PyMaxflow for comparison. Writes JSON.

Calls that are compared are timed alternately in one process; each time is the median over its rounds.
"""

import argparse
import itertools
import json
import time
from functools import partial
from pathlib import Path

import mrcontour as mrc
import numpy as np
from min_cut import cut_band, minimum_cut
from real_contours import demo_contours, folder_contours, spread

# The options with which the add-on's contours are closest to those that people draw, except min_salience.
CLOSEST = {
    "width": 8,
    "band_distance": 0.16,
    "iterations": 2,
    "length_floor": 0.5,
    "anchor": 0.5,
    "feature_clamp": 0.9,
    "crease": 0.5,
}
LENGTH_BIAS = 2.0

# Tables 5.1 and 5.2: mesh, k, width, and number of faces of the band.
THESIS_BANDS = [
    ("Horse", 0, 2, 979),
    ("Horse", 1, 2, 979),
    ("Horse", 2, 2, 979),
    ("Hand-finger", 0, 9, 971),
    ("Hand-thumb", 0, 4, 941),
    ("Hand-thumb", 0, 8, 1934),
    ("Headless", 0, 12, 3563),
    ("Venus-left eye", 0, 2, 644),
    ("Venus-right eye", 0, 2, 740),
]


def seconds_of(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def in_turn(calls, rounds):
    """The median seconds of each call; every round makes each call once."""
    return np.median([[seconds_of(call) for call in calls] for _ in range(rounds)], axis=0)


def optimize(contour, rounds=1, **options):
    """The statistics of the result, with the median seconds of every stage and of the whole call."""
    runs = []
    for _ in range(rounds):
        start = time.perf_counter()
        result = mrc.optimize(contour.body.surface, contour.vertices, options=mrc.Options(**options))
        runs.append({**result.statistics["seconds"], "call": time.perf_counter() - start})
    seconds = {stage: float(np.median([run[stage] for run in runs])) for stage in runs[0]}
    return {**result.statistics, "seconds": seconds, "gap": result.gap, "objective": result.objective}


def bands_of(contours, faces, count):
    """Up to `count` contours that have a band of about this many faces, with its width."""
    sized = ((contour, contour.width_for(faces)) for contour in contours)
    return list(itertools.islice(((contour, width) for contour, width in sized if width), count))


def passes(contours, count):
    """The passes of calls with k = 2 and bands of about 1,000 faces."""
    calls = [optimize(contour, width=width, refinement=2) for contour, width in bands_of(contours, 1000, count)]
    return {
        "contours": len(calls),
        "faces": float(np.median([call["faces"] for call in calls])),
        "passes": [call["passes"] for call in calls],
    }


def stages(contours, count, sizes):
    """The median seconds of every stage by band size and k."""
    rows = []
    for faces in sizes:
        bands = bands_of(contours, faces, count)
        for k in (0, 1, 2, 4):
            calls = [optimize(contour, 3, width=width, refinement=k) for contour, width in bands]
            rows.append({"k": k, "contours": len(calls), **medians(calls)})
    return rows


def medians(calls):
    names = calls[0]["seconds"]
    return {
        "seconds": {name: float(np.median([call["seconds"][name] for call in calls])) for name in names},
        **{name: float(np.median([call[name] for call in calls])) for name in ("faces", "nodes", "arcs", "passes")},
    }


def against_minimum_cut(contours, rounds):
    """The whole call with k = 0, compared with the minimum cut of the same band."""
    options, ours, cuts, faces = mrc.Options(), [], [], []
    for contour in contours:
        body = contour.body
        band = cut_band(body, contour.vertices, options)
        if band is None:
            continue
        call = partial(mrc.optimize, body.surface, contour.vertices, options=options)
        times = in_turn([call, partial(minimum_cut, body.positions, band)], rounds)
        ours.append(times[0])
        cuts.append(times[1])
        faces.append(len(band.triangles))
    return {
        "contours": len(faces),
        "faces": float(np.median(faces)),
        "seconds": float(np.median(ours)),
        "cut_seconds": float(np.median(cuts)),
        "ratio": float(np.median(np.divide(ours, cuts))),
    }


def torus(triangles):
    """A torus of about this many triangles, in regular order."""
    side = int(np.sqrt(triangles / 2))
    u, v = np.meshgrid(*[np.arange(side) * 2 * np.pi / side] * 2, indexing="ij")
    ring = 1 + 0.3 * np.cos(v)
    positions = np.stack([ring * np.cos(u), ring * np.sin(u), 0.3 * np.sin(v)], axis=-1).reshape(-1, 3)
    at = np.arange(side * side, dtype=np.int32).reshape(side, side)
    right, up = np.roll(at, -1, axis=0), np.roll(at, -1, axis=1)
    over = np.roll(right, -1, axis=1)
    halves = np.stack([at, right, over, at, over, up], axis=-1)
    return positions, np.ascontiguousarray(halves.reshape(-1, 3))


def surface(triangle_count, rounds):
    """`Surface` from arrays, compared with NumPy's default sort of the keys of the same directed edges."""
    positions, triangles = torus(triangle_count)
    keys = (triangles.astype(np.int64) * len(positions) + np.roll(triangles, -1, axis=1)).ravel()
    times = in_turn([lambda: mrc.Surface(positions, None, triangles), lambda: np.argsort(keys)], rounds)
    return {
        "triangles": len(triangles),
        "seconds": float(times[0]),
        "argsort_seconds": float(times[1]),
        "ratio": float(times[0] / times[1]),
        "numpy": np.__version__,
    }


def length_bias(contours):
    """Calls with k = 0, with and without length bias: the fraction that closes the gap, and the time it takes."""
    closed, stage, whole = [], [], []
    for contour in contours:
        biased = optimize(contour, **CLOSEST, length_bias=LENGTH_BIAS)
        plain = optimize(contour, **CLOSEST)
        closed.append(biased["gap"] <= 1e-9 * abs(biased["objective"]))
        stage.append(biased["seconds"]["ratio"] / plain["seconds"]["ratio"])
        whole.append(biased["seconds"]["call"] / plain["seconds"]["call"])
    return {
        "contours": len(closed),
        "closed": float(np.mean(closed)),
        "stage": float(np.median(stage)),
        "call": float(np.median(whole)),
    }


def thesis_rows(contours, rounds):
    """For each band of table 5.1, the real contour whose band of the same width has the closest number of faces."""
    rows = []
    for name, k, width, faces in THESIS_BANDS:
        off = [abs(contour.band_faces(width) - faces) for contour in contours]
        nearest = contours[int(np.argmin(off))]
        ours = optimize(nearest, rounds, width=width, refinement=k)
        rows.append({"thesis": name, "k": k, "width": width, "mesh": nearest.body.name, **ours})
    return rows


def measure(arguments):
    quick = arguments.quick
    demo = demo_contours(arguments.scratch, 2 if quick else 10)
    sources = {"libcgal-demo": demo}
    if arguments.contours:
        sources[Path(arguments.contours).resolve().name] = folder_contours(arguments.contours)
    count, rounds = (10, 1) if quick else (120, 5)
    results = {"surface": surface(10_000 if quick else 1_000_000, rounds + 2)}
    results["passes"] = {name: passes(spread(all_, count), count) for name, all_ in sources.items()}
    results["minimum_cut"] = {name: against_minimum_cut(spread(all_, count), rounds) for name, all_ in sources.items()}
    results["length_bias"] = {name: length_bias(spread(all_, 20 if quick else 500)) for name, all_ in sources.items()}
    results["stages"] = stages(spread(demo, count), 3 if quick else 20, (250, 1000) if quick else (250, 1000, 5000))
    results["thesis"] = thesis_rows(demo, rounds)
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("output", type=Path, help="the JSON file to write")
    parser.add_argument("--scratch", required=True, help="a folder for downloads")
    parser.add_argument("--contours", help="a folder with contours drawn on real meshes")
    parser.add_argument("--quick", action="store_true", help="few contours, small meshes")
    arguments = parser.parse_args()
    arguments.output.write_text(json.dumps(measure(arguments), indent=1))


if __name__ == "__main__":
    main()
