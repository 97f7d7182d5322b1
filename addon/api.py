# SPDX-License-Identifier: GPL-3.0-or-later
"""For scripts: the same as the operators, without a selection, returning the native results.

>>> from minimum_ratio_contours import api
>>> result = api.optimize_contour(bpy.data.objects["Hand"], [12, 13, 40, 39], width=8)
>>> result.status, result.ratio, result.vertices

The settings are those of `core.parameters.SETTINGS`, with the add-on's defaults, for a mesh object also those of
`core.parameters.CONSTRAINTS`, which name its vertex groups, attributes and marked edges. Unknown settings raise a
TypeError, bad input a ValueError that names the elements. Vertices are ids, (N,) int; lengths are in the mesh's own
space, angles in radians. Results are those of `mrcontour.optimize`; `help(mrcontour.Result)` explains them.

`native_module()` is that module, wherever the add-on has it, and `native_options(**settings)` are the keyword arguments
of its `Options`. Functions whose names end in `_on` take its Surface, of `surface_of(obj)`, instead of an object.
"""

import bpy

from .core import networks, parameters
from .core.native import module as native_module
from .core.parameters import native_options
from .core.search import optimize_all_on, optimize_on, problem_on
from .mesh import constraint_layers, network_cutting, seams, segmentation, surface_cache
from .mesh.arrays import synchronize
from .mesh.surface_cache import are_current, arrays_and_surface_of, forget

__all__ = [
    "are_current",
    "arrays_and_surface_of",
    "curvature",
    "forget",
    "native_module",
    "native_options",
    "optimize_all_on",
    "optimize_contour",
    "optimize_on",
    "optimize_seams",
    "optimize_segmentation",
    "problem_on",
    "surface_of",
]


def optimize_contour(obj, vertices, closed=True, close=False, **settings):
    """The minimum ratio contour near a given one, given by its vertices in order; the mesh stays as it is.

    `obj` is a mesh object, in Edit Mode or not; a closed contour does not repeat its first vertex. Returns an
    `mrcontour.Result`.
    With `close`, the vertices are a chain, a quarter of a loop or more, that is closed round its limb first. The
    setting `anchor` says how strongly the result is held near the loop so closed; 0: not at all.
    """
    synchronize(obj)
    settings, wanted = parameters.split(settings)
    asked = constraint_layers.read(obj, **wanted)
    return optimize_on(
        surface_cache.surface_of(obj), vertices, closed=closed, close=close, constraints=asked, **settings
    )


def optimize_seams(obj, selected_only=False, apply=False, merge=0.0, **settings):
    """Optimizes all seams of a mesh, or those among its selected edges; with apply they move there.

    Those across faces, with the setting `refinement`, are cut into the mesh; `merge` is that of Optimize Contour.
    The settings are those of `parameters.NETWORK`. Returns the native results, one for each chain between junctions and
    each closed loop that could move.
    """
    synchronize(obj)
    plan = _plan(obj, seams.read_network(obj, selected_only), merge, settings)
    if apply and plan.changed:
        seams.write(obj, network_cutting.cut(obj, plan, merge))
        network_cutting.restore_normals(bpy.context, obj)
    return list(plan.taken_results().values())


def optimize_segmentation(obj, source="FACE_SETS", attribute="", apply=False, merge=0.0, **settings):
    """Optimizes the borders between the regions of a labeling; with apply the labels move with them.

    source: FACE_SETS, MATERIAL or ATTRIBUTE; an attribute's name alone is enough.
    Returns the native results, as optimize_seams does, takes the same settings, and cuts what runs across faces.
    """
    synchronize(obj)
    labeling = segmentation.read_labeling(obj, "ATTRIBUTE" if attribute else source, attribute)
    plan = _plan(obj, segmentation.read_network(obj, labeling), merge, settings)
    if apply and plan.changed:
        segmentation.write(obj, labeling, network_cutting.cut(obj, plan, merge))
        network_cutting.restore_normals(bpy.context, obj)
    return list(plan.taken_results().values())


def curvature(obj, **options):
    """The native principal curvatures at all vertices, an `mrcontour.Curvature`, in one over the mesh's unit of length.

    The options are those of mrcontour.Options.
    """
    synchronize(obj)
    mrc = native_module()
    return mrc.curvature(surface_cache.surface_of(obj), mrc.Options(**options))


def surface_of(obj, beside=()):
    """The native surface of a mesh object, in Edit Mode or not; kept while the mesh is unchanged.

    Only those of the last object asked for, and of the objects `beside` it, are kept.
    """
    synchronize(obj)
    return surface_cache.surface_of(obj, beside)


def _plan(obj, network, merge, settings):
    plan = networks.optimize(surface_cache.surface_of(obj) if network.movable else None, network, **settings)
    return network_cutting.check_when_cut(obj, plan, merge)
