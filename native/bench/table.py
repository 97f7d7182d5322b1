# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the benchmarks' results as Markdown: one row for each target, then the measurements in detail."""

import argparse
import json
from pathlib import Path

import numpy as np
from runs import Runs

BEFORE_RATIO = ["patch", "curvature", "band", "flow", "graph"]
STAGES = [*BEFORE_RATIO, "ratio"]
TABLE = Path(__file__).with_name("TABLE.md")
BY_HAND = "<!-- Written by hand from here on; kept by native/bench/run. -->"

# Tables 5.1 and 5.2, in the order of real_bench.THESIS_BANDS: faces, size of cut, nodes, arcs, most linear steps,
# and, for one iteration, seconds before the minimum ratio stage and in it.
THESIS = [
    (979, 9, 1356, 3588, 4, 0.10, 0.01),
    (979, 34, 8535, 35833, 5, 0.14, 0.33),
    (979, 78, 21332, 125258, 6, 0.22, 2.47),
    (971, 39, 1482, 4075, 5, 0.02, 0.01),
    (941, 17, 1414, 3785, 6, 0.05, 0.01),
    (1934, 33, 2915, 8167, 6, 0.09, 0.06),
    (3563, 49, 5386, 15342, 6, 0.21, 0.18),
    (644, 9, 964, 2476, 4, 0.00, 0.04),
    (740, 9, 1118, 2853, 5, 0.00, 0.06),
]


def markdown(columns, rows):
    """A Markdown table; rows that are None are left out."""
    lines = [columns, ["---"] * len(columns), *(row for row in rows if row)]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def number(value):
    """Three significant digits, without an exponent."""
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.3g}"


def ms(seconds):
    return number(1e3 * seconds)


def target(what, measured, text, met):
    return [what, measured, text, "met" if met else "**not met**"]


def at_most(what, value, most, note=""):
    return target(what, number(value) + note, f"at most {most}", value <= most)


def at_least(what, value, least, note="", unit=" times"):
    return target(what, number(value) + note, f"at least {least}{unit}", value >= least)


def slope(sizes, values):
    """The log-log slope of the values as a function of the sizes."""
    return float(np.polyfit(np.log(sizes), np.log(values), 1)[0])


def joined(values):
    return ", ".join(number(value) for value in values)


def passes_targets(real):
    for name, found in real["passes"].items():
        median, most, worst = np.percentile(found["passes"], [50, 95, 100])
        what = f"passes, k = 2, {found['contours']} contours of {name}, {found['faces']:,.0f} faces in the median"
        yield target(
            what,
            f"median {number(median)}, 95 % within {number(np.ceil(most))}, worst {number(worst)}",
            "median at most 8, 95 % within 16, worst at most 30",
            median <= 8 and most <= 16 and worst <= 30,
        )


def large_passes_target(runs):
    found = [run["passes"] for run in runs.of("passes")]
    if found:
        yield at_most(f"the same, 20,000 faces, worst of {len(found)} tubes", max(found), 25)


def solver_targets(runs):
    for k, least in ((2, 50), (0, 8)):
        times = [thesis.seconds / ours.seconds for ours, thesis in runs.pairs("ratio", "thesis", k=k)]
        if times:
            mean = float(np.exp(np.mean(np.log(times))))
            yield at_least(f"`ratio` relative to the thesis's search, k = {k}, geometric mean", mean, least)
    ours = [ratio.seconds / bare.seconds for ratio, bare in runs.pairs("ratio", "bare_pass", k=2)]
    yield at_most("`ratio` relative to one bare pass, k = 2, median over the bands", float(np.median(ours)), 12)
    call, bare = (runs.one(name, faces=1000, k=2) for name in ("optimize", "bare_pass"))
    yield at_most(
        "the whole call relative to one bare pass, k = 2, tube of 1,000 faces", call.seconds / bare.seconds, 40
    )


def pass_slope(runs, k):
    bands = runs.of("ratio", k=k)
    return slope([run["faces"] for run in bands], [run.seconds / run["arcs"] / run["passes"] for run in bands])


def before_ratio(run):
    return sum(run[stage] for stage in BEFORE_RATIO)


def stage_slope(runs, k, value):
    bands = runs.of("optimize", k=k)
    return slope([run["faces"] for run in bands], [value(run) for run in bands])


def growth_targets(runs):
    faces = [run["faces"] for run in runs.of("ratio", k=0)]
    span = f"log-log slope, {min(faces):,} to {max(faces):,} faces, k = 0, 1, 2"
    arcs = [pass_slope(runs, k) for k in (0, 1, 2)]
    yield target(
        f"time per arc and pass as a function of faces, {span}", joined(arcs), "at most 0.15", max(arcs) <= 0.15
    )
    stages = [stage_slope(runs, k, before_ratio) for k in (0, 1, 2)]
    yield target(f"the stages before `ratio`, {span}", joined(stages), "at most 1.15", max(stages) <= 1.15)


def sameness(*found):
    return ", same bytes" if all(run["same"] for run in found) else ", **different bytes**"


def mesh_size_target(runs):
    in_mesh = runs.of("optimize_in_mesh")
    small, large = in_mesh[0], in_mesh[-1]
    what = f"the same band within {large['triangles']:,} triangles, relative to within {small['triangles']:,}"
    value = large.seconds / small.seconds
    met = value <= 1.2 and small["same"] and large["same"]
    yield target(what, number(value) + sameness(small, large), "at most 1.2, same bytes", met)


def surface_target(real):
    found = real["surface"]
    what = f"`Surface` from arrays, {found['triangles']:,} triangles, "
    what += f"relative to NumPy {found['numpy']} argsort of its keys"
    note = f" ({ms(found['seconds'])} to {ms(found['argsort_seconds'])} ms)"
    yield at_most(what, found["ratio"], 1.5, note)


def cut_targets(real):
    for name, found in real["minimum_cut"].items():
        what = (
            f"the whole call, k = 0, relative to the minimum cut of the same band, median over {found['contours']} "
            f"contours of {name}, {found['faces']:,.0f} faces in the median"
        )
        yield at_most(what, found["ratio"], 1, f" ({ms(found['seconds'])} to {ms(found['cut_seconds'])} ms)")


def memory_target(runs):
    found = runs.of("memory", k=2)
    peaks = [run["bytes_per_arc"] for run in found]
    faces = ", ".join(f"{run['faces']:,.0f}" for run in found)
    what = f"peak memory of a call, k = 2, bytes per arc, bands of {faces} faces"
    yield target(what, joined(peaks), "at most 64", max(peaks) <= 64)


def threads_target(runs):
    one, two = (runs.one("optimize_all", threads=threads) for threads in (1, 2))
    value = one.real_seconds / two.real_seconds
    met = value >= 1.7 and one["same"] and two["same"]
    what = "two threads relative to one, 16 contours"
    yield target(what, number(value) + sameness(one, two), "at least 1.7 times, same bytes", met)


def bias_targets(real):
    for name, found in real["length_bias"].items():
        what = (
            f"length bias, k = 0, {found['contours']} contours of {name}: gap below 1e-9 of the objective; "
            "time relative to the plain ratio, median"
        )
        measured = (
            f"{100 * found['closed']:.1f} %; stage {number(found['stage'])}, whole call {number(found['call'])} times"
        )
        met = found["closed"] >= 0.99 and max(found["stage"], found["call"]) <= 6
        yield target(what, measured, "at least 99 %, at most 6 times", met)


def targets(runs, real):
    rows = [
        *passes_targets(real),
        *large_passes_target(runs),
        *solver_targets(runs),
        *growth_targets(runs),
        *mesh_size_target(runs),
    ]
    rows += [
        *surface_target(real),
        *cut_targets(real),
        *memory_target(runs),
        *threads_target(runs),
        *bias_targets(real),
    ]
    return markdown(["what", "measured", "target", ""], rows)


def stage_rows(runs):
    for run in runs.of("optimize"):
        times = [number(run[stage] / 1e3) for stage in STAGES]
        counts = [f"{run.counters[name]:,.0f}" for name in ("arcs", "passes")]
        yield [f"{run.counters['faces']:,.0f}", run["k"], *counts, *times, ms(run.real_seconds)]


def real_stage_rows(real):
    for row in real["stages"]:
        counts = [f"{row[name]:,.0f}" for name in ("arcs", "passes")]
        times = [ms(row["seconds"][name]) for name in [*STAGES, "call"]]
        yield [f"{row['faces']:,.0f}", row["k"], *counts, *times]


def baseline_rows(runs):
    for run in runs.of("ratio"):
        found = [runs.one(name, **run.arguments) for name in ("bare_pass", "ratio", "shared_lambda", "thesis")]
        texts = [f"{ms(other.seconds)} ({other['passes']:,.0f})" if other else "" for other in found]
        yield [f"{run['faces']:,}", run["k"], f"{run['nodes']:,.0f}", f"{run['arcs']:,.0f}", *texts]


def karp_rows(runs):
    for ours, karp in runs.pairs("ratio_by_counts", "karp"):
        yield [f"{ours['faces']:,}", f"{ours['nodes']:,.0f}", ms(ours.seconds), ms(karp.seconds)]


def growth_rows(runs):
    for k in (0, 1, 2):
        slopes = [stage_slope(runs, k, lambda run, stage=stage: run[stage]) for stage in STAGES]
        yield [
            k,
            *map(number, slopes),
            number(stage_slope(runs, k, lambda run: run.seconds)),
            number(pass_slope(runs, k)),
        ]


def memory_rows(runs):
    for run in runs.of("memory"):
        counts = [f"{run.counters[name]:,.0f}" for name in ("faces", "arcs")]
        yield [counts[0], run["k"], counts[1], number(run["bytes"] / 1e6), number(run["bytes_per_arc"])]


def mesh_rows(runs):
    for run in runs.of("optimize_in_mesh"):
        surface = runs.one("surface", **run.arguments)
        yield [f"{run['triangles']:,}", ms(surface.seconds) if surface else "", ms(run.seconds)]


def thesis_rows(real):
    for theirs, ours in zip(THESIS, real["thesis"], strict=True):
        faces, cut, nodes, arcs, steps, before, ratio = theirs
        yield [
            f"{ours['thesis']} / {ours['mesh']}",
            ours["k"],
            ours["width"],
            *(
                f"{a:,} / {b:,}"
                for a, b in zip((faces, cut, nodes, arcs), (ours[x] for x in ("faces", "cut", "nodes", "arcs")))
            ),
            f"{steps} / {ours['linear_steps']}",
            f"{1e3 * before:,.0f} / {ms(sum(ours['seconds'][stage] for stage in BEFORE_RATIO))}",
            f"{1e3 * ratio:,.0f} / {ms(ours['seconds']['ratio'])}",
            f"{1e3 * (before + ratio):,.0f} / {ms(ours['seconds']['call'])}",
        ]


def sections(runs, real):
    yield "Targets", "", targets(runs, real)
    columns = ["faces", "k", "arcs", "passes", *STAGES, "call"]
    yield "Stages of one call on tubes", "Milliseconds.", markdown(columns, stage_rows(runs))
    note = "Milliseconds, medians over contours on the meshes of libcgal-demo."
    yield "Stages of one call on real meshes", note, markdown(columns, real_stage_rows(real))
    note = "Log-log slopes, over the number of faces, of the time of each stage and of the time per arc and pass."
    yield "How cost grows", note, markdown(["k", *STAGES, "call", "per arc and pass"], growth_rows(runs))
    note = "Milliseconds on the same graph, and the number of passes in parentheses."
    columns = ["faces", "k", "nodes", "arcs", "bare pass", "`ratio`", "one lambda, no bounds", "the thesis's search"]
    yield "The solver compared with its baselines", note, markdown(columns, baseline_rows(runs))
    note = "Milliseconds; every arc counts 1."
    yield "The solver with counts", note, markdown(["faces", "nodes", "`ratio`", "Karp"], karp_rows(runs))
    note = (
        "Milliseconds for `Surface` with this many triangles, and for a call with k = 0 and 1,000 faces in such a mesh."
    )
    yield "Meshes of different sizes", note, markdown(["triangles", "`Surface`", "call"], mesh_rows(runs))
    yield "Peak memory of a call", "", markdown(["faces", "k", "arcs", "megabytes", "bytes per arc"], memory_rows(runs))
    note = (
        "Figures of the thesis (2006, 2.80 GHz) / ours, for one iteration on the real contour whose band of the same "
        "width has the closest number of faces. Milliseconds; before: all stages before the minimum ratio, "
        "curvature included."
    )
    columns = ["mesh", "k", "width", "faces", "cut", "nodes", "arcs", "linear steps", "before", "ratio", "iteration"]
    yield "Comparison with tables 5.1 and 5.2", note, markdown(columns, thesis_rows(real))


def document(runs, real, quick):
    context = runs.context
    yield "# Benchmarks"
    about = f"Written by `native/bench/run` on {context['num_cpus']} processors of {context['mhz_per_cpu']:,} MHz. "
    about += "Each ratio is measured in one run. Times are medians, and processor times if only one thread works. "
    about += "Their meaning is explained [at the end](#what-the-figures-mean)."
    if quick:
        about += " **A smoke run with `--quick`: its figures mean nothing.**"
    yield about
    for title, note, table in sections(runs, real):
        yield f"## {title}"
        if note:
            yield note
        yield table
    yield explanations()


def explanations():
    """The end of TABLE.md, which is written by hand."""
    return BY_HAND + TABLE.read_text(encoding="utf-8").partition(BY_HAND)[2].rstrip("\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--benchmarks", type=Path, nargs="+", required=True, help="JSON files written by the C++ programs"
    )
    parser.add_argument("--real", type=Path, required=True, help="JSON file written by real_bench.py")
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    parts = document(Runs(*arguments.benchmarks), json.loads(arguments.real.read_text()), arguments.quick)
    text = "\n\n".join(parts) + "\n"  # before the file is overwritten, whose end is kept
    arguments.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
