# SPDX-License-Identifier: GPL-3.0-or-later
"""The thesis's figures: runs their searches with the native module, and draws each before and after.

It draws one picture per search, and `overview.png` with all of them. The tests assert the numbers of the figures.
"""

import re
import traceback

import blender_meshes
import bpy
import numpy as np
import pictures
import report
import stamps
from curves import mean_distance
from figures import FIGURES

SHOWN = {"1.1": 3}  # the search of a figure in the small picture, if it is not the last
SMALL, SHADES = 160, 28  # of the small picture: pixels of a half, and shades of each color (the paper stays gray)


def run(output, only, mrc):
    """Run the selected figures. Return the rows of the table and the failures."""
    wanted = [name for name in FIGURES if only in (None, "figures", name)]
    rows, failures, drawn = [], [], []
    for name in wanted:
        try:
            rows += run_figure(FIGURES[name](), output, mrc, drawn)
        except Exception as error:  # run the others all the same; the failure is reported at the end
            traceback.print_exc()
            failures.append(f"figure {name}: {error}")
    if drawn and len(wanted) == len(FIGURES):
        draw_overview(output / "overview.png", drawn)
    return rows, failures


def run_figure(figure, output, mrc, drawn):
    """Run all searches of a figure and add their pictures to `drawn`. Return its rows of the table."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    ob = blender_meshes.new_object(f"figure {figure.name}", figure.positions, figure.faces)
    surface = native_surface(figure, mrc)
    results = [optimize(surface, search, mrc) for search in figure.searches]
    comparisons = [compare(figure, ob.data, *pair, surface, mrc) for pair in zip(figure.searches, results)]
    shown = [curve for comparison in comparisons for curve in (*comparison.given, *comparison.found)]
    for number, comparison in enumerate(comparisons, 1):
        comparison.in_view = shown  # one view for the whole figure
        name = re.sub(r"\W+", "_", f"{number} {comparison.title}")
        drawn.append(output / f"{figure.name}.{name}.png")
        pictures.draw_if_changed(drawn[-1], ob, figure.up, comparison)
    return [line(figure, ob.data, *each) for each in zip(figure.searches, results, comparisons)]


def draw_selection(path, mrc):
    """Draw one small picture of all figures, with one search of each."""
    made_of = stamps.stamp([], [shown_search(name, mrc, stamp_of) for name in FIGURES])
    stamps.draw_if_changed(path, made_of, lambda: draw_pairs(path, mrc))


def draw_pairs(path, mrc):
    pairs = [shown_search(name, mrc, small_pair) for name in FIGURES]
    pictures.draw_overview(path, pairs, pictures.SHEET_COLUMNS, SHADES)


def shown_search(name, mrc, use):
    """Return `use` of a figure's object, its upward axis and the comparison of the search that is shown."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    figure = FIGURES[name]()
    ob = blender_meshes.new_object(f"figure {name}", figure.positions, figure.faces)
    search, surface = figure.searches[SHOWN.get(name, -1)], native_surface(figure, mrc)
    comparison = compare(figure, ob.data, search, optimize(surface, search, mrc), surface, mrc)
    comparison.before, comparison.after = "given", "found"
    return use(ob, figure.up, comparison)


def stamp_of(ob, _, comparison):
    return comparison.stamp(blender_meshes.polygons(ob.data))


def small_pair(ob, up, comparison):
    return pictures.overview_pair(ob, up, comparison, SMALL)


def native_surface(figure, mrc):
    offsets = np.cumsum([0, *map(len, figure.faces)], dtype=np.int32)
    return mrc.Surface(np.ascontiguousarray(figure.positions), offsets, np.concatenate(figure.faces).astype(np.int32))


def optimize(surface, search, mrc):
    options = mrc.Options(**search.options)
    result = mrc.optimize(surface, search.given, closed=search.closed, options=options, **search.constraints)
    # A given contour without the required elements cannot be compared with those that have them.
    if result.status != "constrained" and result.objective > result.initial_objective:
        raise RuntimeError(f"the objective rose from {result.initial_objective} to {result.objective}: {search.title}")
    return result


def compare(figure, mesh, search, result, surface, mrc):
    """Return the picture of a search and its result."""
    found = blender_meshes.surface_curve(mesh, result.edge_vertices, result.edge_parameters, search.closed)
    outcome = "left as it is" if result.status == "unchanged" else "contour found"
    return pictures.Comparison(
        search.title,
        f"given contour: ratio {result.initial_ratio:.3g}",
        f"{outcome}: ratio {result.ratio:.3g}, salience {result.salience:.3g}",
        [blender_meshes.curve(mesh, search.given, search.closed)],
        [found],
        mrc.band(surface, search.given, closed=search.closed, options=mrc.Options(**search.options)),
        [blender_meshes.curve(mesh, truth, is_loop(mesh, truth)) for truth in figure.truths],
        legend="faces searched (green)" if result.statistics["iterations"] == 1 else "faces searched first (green)",
        heading=f"Figure {figure.name}: {figure.title}",
        held=search.constraints.get("required_vertices", ()),
    )


def is_loop(mesh, vertices):
    """Whether an edge joins the last vertex to the first."""
    return sorted((vertices[0], vertices[-1])) in blender_meshes.edge_pairs(mesh).tolist()


def line(figure, mesh, search, result, comparison):
    """Return the search's row of the table."""
    constraints = {name.replace("_", " "): len(elements) for name, elements in search.constraints.items()}
    away = [mean_distance(comparison.found[0], truth) for truth in comparison.truths]
    off = min(away) / blender_meshes.mean_edge_length(mesh) if away else None
    settings = {**search.options, **constraints}
    return report.row(f"figure {figure.name}", search.title, len(mesh.polygons), settings, result, off)


def draw_overview(path, drawn):
    """Draw all pictures at half their size."""
    made_of = stamps.stamp([], [picture.with_suffix(".sha256").read_text() for picture in drawn])
    stamps.draw_if_changed(path, made_of, lambda: pictures.draw_sheet(path, drawn))
