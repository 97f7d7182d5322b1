# SPDX-License-Identifier: GPL-3.0-or-later
"""For scripts: functions that do the same as the operators, without a selection, and return the native results.

>>> from minimum_ratio_contours import api
>>> result = api.optimize_contour(bpy.data.objects["Hand"], [12, 13, 40, 39], width=8)
>>> result.status, result.ratio, result.vertices

Common to all functions:

- `obj` is a mesh object, in Edit Mode or not. Hidden faces are not searched.
- `vertices` are vertex indices in order along a contour, (N,) int; a closed contour does not repeat its first vertex.
- Settings are keyword arguments named as in `core.parameters.SETTINGS`, with the add-on's defaults.
  `optimize_contour` also takes those of `core.parameters.CONSTRAINTS`, which name vertex groups, attributes and marked
  edges of the object.
- Lengths are in units of object space, angles in radians.
- Results are those of `mrcontour.optimize`; see `help(mrcontour.Result)`.
- Errors: TypeError for an unknown setting, ValueError for bad input, with a message that names the elements.

`native_module()` returns the module `mrcontour`, wherever the add-on has it, and `native_options(**settings)` returns
the keyword arguments of its `Options`. Functions whose names end in `_on` take a Surface, as returned by
`surface_of(obj)`, instead of an object.
"""

import bpy

from .core import networks, parameters
from .core.native import module as native_module
from .core.parameters import native_options
from .core.search import optimize_all_on, optimize_on, problem_on
from .mesh import constraint_layers, network_cutting, seam_network, segmentation, surface_cache
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


def optimize_contour(obj, vertices, closed=True, around_limb=False, **settings):
    """Return the minimum ratio contour near a given one, an `mrcontour.Result`. The mesh is not changed.

    vertices: (N,) int, the given contour in order along edges of the mesh.
    closed: whether it is a loop (default) or an open chain.
    around_limb: whether the vertices are an open chain on a limb, which is first completed to a loop around it; a
        quarter of a loop is enough. `closed` does not matter then, and the setting `anchor` (default 0.5; 0: not at
        all) says how strongly the result is held near the loop that this gives. Also accepted as `close`.
    settings: those of `core.parameters.SETTINGS` and `core.parameters.CONSTRAINTS`.

    Raises TypeError for unknown settings, and ValueError if the vertices are not a contour, a layer is missing, or no
    contour meets the constraints.
    """
    synchronize(obj)
    settings, layer_settings = parameters.split(settings)
    constraints = constraint_layers.read(obj, **layer_settings)
    surface = surface_cache.surface_of(obj)
    return optimize_on(surface, vertices, closed, around_limb, constraints=constraints, **settings)


def optimize_seams(obj, selected_only=False, apply=False, merge=0.0, **settings):
    """Optimize the seams of a mesh. Return a list of `mrcontour.Result`.

    There is one result for each closed loop and each chain between junctions that could move and would not join, split
    or remove an island.

    selected_only: whether only the seams among the selected edges may move (default: all).
    apply: whether to move the seams in the mesh (default: leave the mesh unchanged). With the setting `refinement` they
        run across faces, and are cut into the mesh.
    merge: when contours are cut, points closer to a vertex than this fraction of their edge, 0 to 0.5, are moved onto
        it (default: 0).
    settings: those of `core.parameters.NETWORK`.

    Raises TypeError for unknown settings, and ValueError if the mesh is not a valid surface.
    """
    synchronize(obj)
    plan = _plan(obj, seam_network.read_network(obj, selected_only), merge, settings)
    if apply and plan.changed:
        seam_network.write(obj, network_cutting.cut(obj, plan, merge))
        network_cutting.restore_normals(bpy.context, obj)
    return list(plan.taken_results().values())


def optimize_segmentation(obj, source="FACE_SETS", attribute="", apply=False, merge=0.0, **settings):
    """Optimize the borders between the regions of a labeling. Return a list of `mrcontour.Result`, as optimize_seams.

    source: "FACE_SETS" (default), "MATERIAL" or "ATTRIBUTE".
    attribute: the name of an integer face attribute; if given, the source is "ATTRIBUTE".
    apply: whether to move the labels with the borders (default: leave the mesh unchanged). With the setting
        `refinement` the borders run across faces, and are cut into the mesh.
    merge: when contours are cut, points closer to a vertex than this fraction of their edge, 0 to 0.5, are moved onto
        it (default: 0).
    settings: those of `core.parameters.NETWORK`.

    Raises TypeError for unknown settings, and ValueError for an unknown source, if the mesh does not have these labels,
    or if it is not a valid surface.
    """
    synchronize(obj)
    labeling = segmentation.read_labeling(obj, "ATTRIBUTE" if attribute else source, attribute)
    plan = _plan(obj, segmentation.read_network(obj, labeling), merge, settings)
    if apply and plan.changed:
        segmentation.write(obj, labeling, network_cutting.cut(obj, plan, merge))
        network_cutting.restore_normals(bpy.context, obj)
    return list(plan.taken_results().values())


def curvature(obj, **options):
    """Return the principal curvatures at all V vertices, an `mrcontour.Curvature`.

    It has `kappa_min` and `kappa_max`, (V,) float64 in 1 / length of object space, and the unit vectors `direction_min`
    and `direction_max`, (V, 3) float64.

    options: those of `mrcontour.Options`, with its defaults; for example `curvature_radius=1.6`.

    Raises TypeError for unknown options, and ValueError if the mesh is not a valid surface.
    """
    synchronize(obj)
    mrc = native_module()
    return mrc.curvature(surface_cache.surface_of(obj), mrc.Options(**options))


def surface_of(obj, beside=()):
    """Return the `mrcontour.Surface` of a mesh object, in Edit Mode or not. It is cached while the mesh is unchanged.

    beside: other objects whose surfaces stay in the cache (default: none). All others are dropped.

    Raises ValueError if the mesh is not a valid surface.
    """
    synchronize(obj)
    return surface_cache.surface_of(obj, beside)


def _plan(obj, network, merge, settings):
    plan = networks.optimize(surface_cache.surface_of(obj) if network.movable else None, network, **settings)
    return network_cutting.check_when_cut(obj, plan, merge)
