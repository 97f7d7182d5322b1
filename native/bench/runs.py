# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the output of Google Benchmark: the median over the repetitions of each benchmark."""

import json
from collections import defaultdict
from dataclasses import dataclass

import numpy as np

UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


@dataclass(frozen=True)
class Run:
    """One benchmark: its arguments and measurements. `seconds` is processor time, `real_seconds` wall-clock time."""

    arguments: dict
    seconds: float
    real_seconds: float
    counters: dict

    def __getitem__(self, name):
        return self.arguments[name] if name in self.arguments else self.counters[name]


class Runs:
    """All benchmarks of one or more JSON files."""

    def __init__(self, *paths):
        repetitions = defaultdict(list)
        for path in paths:
            report = json.loads(path.read_text())
            self.context = report["context"]
            for row in report["benchmarks"]:
                if row["run_type"] == "iteration":
                    repetitions[row["run_name"]].append(row)
        self._runs = defaultdict(list)
        for name, rows in repetitions.items():
            self._runs[name.split("/")[0]].append(run_of(name, rows))
        for runs in self._runs.values():  # being interleaved, they were written in any order
            runs.sort(key=lambda run: tuple(reversed(run.arguments.values())))

    def of(self, function, **arguments):
        """The runs of a benchmark with these arguments."""
        return [run for run in self._runs[function] if arguments.items() <= run.arguments.items()]

    def one(self, function, **arguments):
        """The only run of a benchmark with these arguments, or None."""
        return next(iter(self.of(function, **arguments)), None)

    def pairs(self, function, other, **arguments):
        """The runs of two benchmarks with the same arguments."""
        return [(run, twin) for run in self.of(function, **arguments) if (twin := self.one(other, **run.arguments))]


def run_of(name, rows):
    def median(key):
        return float(np.median([row[key] for row in rows]))

    arguments = dict(part.split(":") for part in name.split("/") if ":" in part)
    counters = {key: median(key) for key, value in rows[0].items() if isinstance(value, (int, float))}
    unit = UNITS[rows[0]["time_unit"]]
    ours = {key: int(value) for key, value in arguments.items() if key not in ("iterations", "repeats")}
    return Run(ours, unit * median("cpu_time"), unit * median("real_time"), counters)
