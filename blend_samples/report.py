# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of results, as Markdown and as CSV."""

import csv

COLUMNS = [
    *("sample", "contour", "mesh faces", "band faces", "cut", "nodes", "arcs", "nodes/face", "arcs/node", "passes"),
    *("status", "salience", "ratio before", "ratio after", "ms", "off truth", "settings"),
]
NOTE = (
    "Band, cut, nodes and arcs are those of the last iteration; ms is the time of the native stages. Salience says how "
    "far to trust a result: above 2 it is nearly always right, below 0.5 seldom. 'off truth': the mean distance to the "
    "correct loop known by construction (the nearest of several), in mean edge lengths of the mesh. 'settings': those "
    "that differ from the add-on's defaults; for the thesis's figures, which call the native module, from the module's."
)


def row(sample, contour, mesh_faces, settings, result, off_truth):
    """Return the row of one contour."""
    counts = result.statistics
    faces, nodes, arcs = counts["faces"], counts["nodes"], counts["arcs"]
    sizes = [mesh_faces, faces, counts["cut"], nodes, arcs, f"{nodes / faces:.2f}", f"{arcs / nodes:.2f}"]
    milliseconds = 1000.0 * sum(counts["seconds"].values())
    outcome = [result.status, f"{result.salience:.2f}", f"{result.initial_ratio:.4g}", f"{result.ratio:.4g}"]
    off = "" if off_truth is None else f"{off_truth:.2f}"
    differs = ", ".join(f"{name} {_shortened(value)}" for name, value in settings.items())
    return [sample, contour, *map(str, sizes), str(counts["passes"]), *outcome, f"{milliseconds:.1f}", off, differs]


def _shortened(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def lines(rows):
    """Return the table as lines of aligned Markdown."""
    table = [COLUMNS, *rows]
    widths = [max(len(line[i]) for line in table) for i in range(len(COLUMNS))]
    text = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths)) + " |" for line in table]
    return [text[0], "|" + "|".join("-" * (width + 2) for width in widths) + "|", *text[1:]]


def write(folder, rows):
    (folder / "table.md").write_text("\n".join([*lines(rows), "", NOTE, ""]))
    with open(folder / "table.csv", "w", newline="") as file:
        csv.writer(file).writerows([COLUMNS, *rows])
