# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of results: printed, as Markdown and as CSV."""

import csv

COLUMNS = [
    *("sample", "contour", "mesh faces", "band faces", "cut", "nodes", "arcs", "nodes/face", "arcs/node", "passes"),
    *("status", "ratio before", "ratio after", "ms", "off truth"),
]
NOTE = (
    "Band, cut, nodes and arcs are those of the last iteration; ms is the time of the native stages. 'off truth': the "
    "mean distance to the loop known by construction, in mean edge lengths of the mesh."
)


def row(sample, contour, mesh_faces, result, off_truth):
    """The columns of one contour."""
    counts = result.statistics
    faces, nodes, arcs = counts["faces"], counts["nodes"], counts["arcs"]
    sizes = [mesh_faces, faces, counts["cut"], nodes, arcs, f"{nodes / faces:.2f}", f"{arcs / nodes:.2f}"]
    milliseconds = 1000.0 * sum(counts["seconds"].values())
    outcome = [result.status, f"{result.initial_ratio:.5g}", f"{result.ratio:.5g}", f"{milliseconds:.1f}"]
    off = "" if off_truth is None else f"{off_truth:.2f}"
    return [sample, contour, *map(str, sizes), str(counts["passes"]), *outcome, off]


def lines(rows):
    """The table as aligned Markdown."""
    table = [COLUMNS, *rows]
    widths = [max(len(line[i]) for line in table) for i in range(len(COLUMNS))]
    text = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths)) + " |" for line in table]
    return [text[0], "|" + "|".join("-" * (width + 2) for width in widths) + "|", *text[1:]]


def write(folder, rows):
    (folder / "table.md").write_text("\n".join([*lines(rows), "", NOTE, ""]))
    with open(folder / "table.csv", "w", newline="") as file:
        csv.writer(file).writerows([COLUMNS, *rows])
