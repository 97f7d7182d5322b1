# SPDX-License-Identifier: GPL-3.0-or-later
"""Optimizes the rough loops of all samples with the add-on, and writes .blend files, pictures and a table:

    blender -b --factory-startup --python-exit-code 1 --python blend_samples/run_samples.py -- --output build/samples

`--only figures` runs only the figures of the thesis, `--only 5.4` one of them, `--only gallery` only the gallery.
Pictures that have not changed are drawn again only with `--redraw`.

With `--overview blend_samples/pictures/overview.png` it only draws the picture of the README; with
`--gallery blend_samples/pictures` it only draws those of the gallery.

BLENDER_USER_SCRIPTS names the folder whose `addons` holds the add-on with its native module. Every contour is optimized
as by a modeler, with the operator in Edit Mode and output Seam; the numbers are those of the add-on's `api` for the
same loop. The script fails if any contour does: on an error, a seam that is not the contour found, or an objective that
rises.
"""

import argparse
import sys
import tempfile
import traceback
from dataclasses import dataclass
from pathlib import Path

import addon_utils
import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import blender_meshes  # noqa: E402
import gallery  # noqa: E402
import pictures  # noqa: E402
import real_meshes  # noqa: E402
import report  # noqa: E402
import run_figures  # noqa: E402
import stamps  # noqa: E402
from curves import mean_distance  # noqa: E402
from rough_loops import rough_loop, settings  # noqa: E402

FOUND = "found_loop."  # a boolean edge attribute for each contour found
WORDS = ("given: rough loops", "found: part boundaries")
OVERVIEW = {  # the samples in the README's picture, with their captions
    "hand": ("Five fingers", *WORDS),
    "bear.off": ("Bear: ear, arm, neck", *WORDS),
    "armadillo.off": ("Scan: ear, arm, knee, tail", *WORDS),
    "head": ("Head: nose, ear, neck", *WORDS),
}


@dataclass
class Sample:
    """A mesh object, its rough loops (name -> vertices in order) and their settings that differ from the defaults."""

    name: str
    ob: bpy.types.Object
    loops: dict
    settings: dict
    truths: dict
    up: tuple


def made_sample(path):
    bpy.ops.wm.open_mainfile(filepath=str(path))
    ob = bpy.context.view_layer.objects.active
    loops = blender_meshes.stored_loops(ob.data, blender_meshes.ROUGH)
    truths = blender_meshes.stored_loops(ob.data, blender_meshes.TRUE)
    blender_meshes.mark_seams(ob.data, np.zeros(len(ob.data.edges), bool))  # only the contours found will be seams
    return Sample(path.stem, ob, loops, stored_settings(ob, loops), truths, (0, 0, 1))


def stored_settings(ob, names):
    stored = {name: ob.get(blender_meshes.SETTINGS + name) for name in names}
    return {name: group.to_dict() if group else {} for name, group in stored.items()}


def real_sample(name, archive):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    triangles = real_meshes.read_off(archive, name)
    ob = blender_meshes.new_object(name, triangles.positions, triangles.vertices.reshape(-1, 3).tolist())
    bpy.context.view_layer.objects.active = ob
    mesh = blender_meshes.polygons(ob.data)
    cuts = real_meshes.cuts(name, mesh)
    for cut in cuts:
        blender_meshes.store_loop(ob.data, blender_meshes.ROUGH + cut.name, rough_loop(mesh, cut))
    loops = blender_meshes.stored_loops(ob.data, blender_meshes.ROUGH)
    needed = {cut.name: settings(mesh, cut, loops[cut.name]) for cut in cuts}
    return Sample(name, ob, loops, needed, {}, real_meshes.up(name))


def samples(only, output):
    """Yield one sample after the other, each of which replaces the open file; with the add-on enabled."""
    for path in sorted(HERE.glob("*.blend")):
        if only in (None, path.stem):
            sample = made_sample(path)
            if sample.loops:
                yield sample
    wanted = [name for name in real_meshes.CUTS if only in (None, name)]
    if wanted:
        with real_meshes.open_archive(output / "libcgal-demo") as archive:
            for name in wanted:
                yield real_sample(name, archive)


def enable_addon():
    module = addon_utils.enable("minimum_ratio_contours", default_set=True)
    if module is None:
        raise SystemExit("The add-on minimum_ratio_contours is not in the folder given by BLENDER_USER_SCRIPTS.")
    from minimum_ratio_contours import api

    return api, api.native_module()


def mark_seam(sample, name, found):
    """Run the operator on the selected loop and check that the seams it adds are the contour found."""
    mesh = sample.ob.data
    blender_meshes.select_edges(mesh, blender_meshes.edge_mask(mesh, sample.loops[name]))
    wanted = blender_meshes.read(mesh.edges, "use_seam", 1, bool) | found
    bpy.context.scene.tool_settings.mesh_select_mode = (False, True, False)
    bpy.ops.object.mode_set(mode="EDIT")
    done = bpy.ops.mesh.optimize_contour(output="SEAM", keep_old=True, **sample.settings[name])
    bpy.ops.object.mode_set(mode="OBJECT")
    if done != {"FINISHED"} or not np.array_equal(blender_meshes.read(mesh.edges, "use_seam", 1, bool), wanted):
        raise RuntimeError(f"the operator returned {done}, or did not mark exactly the contour found")


def run_contour(sample, name, output, api, mrc):
    """Process one contour: result, seam, picture. Return its row of the table."""
    mesh, loop = sample.ob.data, sample.loops[name]
    result = api.optimize_contour(sample.ob, loop, **sample.settings[name])
    if result.objective > result.initial_objective:
        raise RuntimeError(f"the objective rose from {result.initial_objective} to {result.objective}")
    found = list(result.vertices)
    mark_seam(sample, name, blender_meshes.edge_mask(mesh, found))
    blender_meshes.store_loop(mesh, FOUND + name, found)
    words = (
        f"{sample.name}: {name.replace('_', ' ')}",
        f"given loop: ratio {result.initial_ratio:.3g}",
        outcome(result),
    )
    truths = curves(sample, [sample.truths[name]] if name in sample.truths else [])
    given_and_found = curves(sample, [loop]), curves(sample, [found])
    comparison = pictures.Comparison(*words, *given_and_found, searched(sample, name, api, mrc), truths)
    pictures.draw_if_changed(output / "pictures" / f"{sample.name}.{name}.png", sample.ob, sample.up, comparison)
    return report.row(
        sample.name, name, len(mesh.polygons), sample.settings[name], result, off_truth(sample, name, found)
    )


def outcome(result):
    """Return a line of text for the picture."""
    if result.status == "unchanged":
        return f"left as it is: nothing clear to find (salience {result.salience:.2g})"
    return f"contour found: ratio {result.ratio:.3g}, salience {result.salience:.2g}"


def searched(sample, name, api, mrc):
    """Return the faces of the bands of all iterations, each grown from the contour of the previous one."""
    surface, faces, loop = api.surface_of(sample.ob), [], sample.loops[name]
    options = api.native_options(**sample.settings[name])
    for done in range(1, options["iterations"] + 1):
        faces.append(mrc.band(surface, loop, options=mrc.Options(**options)))
        loop = api.optimize_on(surface, sample.loops[name], **sample.settings[name], iterations=done).vertices
    return np.unique(np.concatenate(faces))


def curves(sample, loops):
    return [blender_meshes.curve(sample.ob.data, loop) for loop in loops]


def off_truth(sample, name, found):
    """Return the mean distance from the contour found to the correct loop, in mean edge lengths."""
    if name not in sample.truths:
        return None
    contour, truth = curves(sample, [found, sample.truths[name]])
    return mean_distance(contour, truth) / blender_meshes.mean_edge_length(sample.ob.data)


def save(sample, output):
    """Save the result as a .blend: rough and found loops as edge attributes, the found ones as seams and selected."""
    mesh = sample.ob.data
    seams = blender_meshes.read(mesh.edges, "use_seam", 1, bool)
    blender_meshes.mark_seams(mesh, seams)
    blender_meshes.select_edges(mesh, seams)
    bpy.context.preferences.filepaths.save_version = 0
    bpy.ops.wm.save_as_mainfile(filepath=str(output / f"{sample.name}.result.blend"), compress=True, copy=True)


def run(output, only):
    """Run all contours. Return the rows of the table and the failures."""
    api, mrc = enable_addon()
    rows, failures = [], []
    for sample in samples(only, output):
        enable_addon()
        for name in sample.loops:
            try:
                rows.append(run_contour(sample, name, output, api, mrc))
            except Exception as error:  # run the others all the same; the failure is reported at the end
                traceback.print_exc()
                failures.append(f"{sample.name}, {name}: {error}")
        save(sample, output)
    others = [run_gallery(output / "gallery", only), run_figures.run(output / "figures", only, mrc)]
    for found_rows, found_failures in others:
        rows += found_rows
        failures += found_failures
    return rows, failures


def run_gallery(output, only=None):
    """Run the gallery's jobs. Return the rows of the table and the failures."""
    rows, failures = [], []
    for job, sample in gallery.JOBS.items():
        if only not in (None, "gallery", job):
            continue
        try:
            api, _ = enable_addon()
            rows += getattr(gallery, job)(HERE / f"{sample}.blend", output, api)
        except Exception as error:  # as above
            traceback.print_exc()
            failures.append(f"{job}: {error}")
    return rows, failures


def draw_gallery(folder, only):
    """Draw the gallery's pictures, and one of the figures."""
    rows, failures = run_gallery(folder, only)
    if only in (None, "figures"):
        run_figures.draw_selection(folder / "figures.png", enable_addon()[1])
    finish(rows, failures)


def draw_overview(path):
    """Draw the picture of the README: all loops of a few samples, before and after."""
    api, mrc = enable_addon()
    pairs = []
    with tempfile.TemporaryDirectory() as folder:
        for name, words in OVERVIEW.items():
            for sample in samples(name, Path(folder)):
                enable_addon()
                pairs.append(overview_pair(sample, words, api, mrc))
    path.parent.mkdir(parents=True, exist_ok=True)
    pictures.draw_overview(path, pairs)
    print(f"{path}: {path.stat().st_size // 1024} KiB")


def overview_pair(sample, words, api, mrc):
    """Draw all loops of a sample in one small picture."""
    given = list(sample.loops.values())
    found = [
        list(api.optimize_contour(sample.ob, sample.loops[n], **sample.settings[n]).vertices) for n in sample.loops
    ]
    faces = np.unique(np.concatenate([searched(sample, name, api, mrc) for name in sample.loops]))
    comparison = pictures.Comparison(*words, curves(sample, given), curves(sample, found), faces)
    return pictures.overview_pair(sample.ob, sample.up, comparison)


def main():
    parser = argparse.ArgumentParser(prog="run_samples.py")
    task = parser.add_mutually_exclusive_group(required=True)
    task.add_argument("--output", type=Path, help="folder for .blend files, pictures and the table")
    task.add_argument("--overview", type=Path, metavar="PATH", help="draw only the picture of the README")
    task.add_argument(
        "--gallery", type=Path, metavar="FOLDER", help="draw only the gallery's pictures, into this folder"
    )
    parser.add_argument("--redraw", action="store_true", help="also draw pictures that have not changed")
    parser.add_argument("--only", metavar="NAME", help="only this sample or figure")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    stamps.redraw = arguments.redraw
    if arguments.overview:
        return draw_overview(arguments.overview.resolve())
    if arguments.gallery:
        return draw_gallery(arguments.gallery.resolve(), arguments.only)
    output = arguments.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    rows, failures = run(output, arguments.only)
    report.write(output, rows)
    finish(rows, failures or ([] if rows else [f"nothing is called {arguments.only}"]))


def finish(rows, failures):
    """Print the table and the failures."""
    print("\n".join(report.lines(rows)))
    print(f"{len(rows)} contours done, {len(failures)} failed.", *failures, sep="\n")
    if failures:
        raise SystemExit(1)


main()
