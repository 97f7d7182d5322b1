# SPDX-License-Identifier: GPL-3.0-or-later
"""For scripts: the same as the operators, without a selection, returning the native results.

>>> from minimum_ratio_contours import api
>>> result = api.optimize_contour(bpy.data.objects["Hand"], [12, 13, 40, 39], width=8)
>>> result.status, result.ratio, result.vertices

The settings are those of `parameters.SETTINGS`, with the add-on's defaults, for a mesh object also those of
`parameters.CONSTRAINTS`, which name its vertex groups, attributes and marked edges. Unknown settings raise a TypeError,
bad input a ValueError that names the elements. Vertices are ids, (N,) int; lengths are in the mesh's own space, angles
in radians. Results are those of `mrcontour.optimize`; `help(mrcontour.Result)` explains them.
"""

import bpy

from . import constraints, jobs, mesh_access, native, network_cutting, networks, parameters, seams, segmentation
from .constraint_arrays import native_keywords

_kept = {}  # mesh name -> (MeshArrays, Surface), of the meshes of the last call


def optimize_contour(obj, vertices, closed=True, close=False, **settings):
    """The minimum ratio contour near a given one, given by its vertices in order; the mesh stays as it is.

    `obj` is a mesh object, in Edit Mode or not; a closed contour does not repeat its first vertex. Returns an
    `mrcontour.Result`.
    With `close`, the vertices are a chain, a quarter of a loop or more, that is closed round its limb first. The
    setting `anchor` says how strongly the result is held near the loop so closed; 0: not at all.
    """
    mesh_access.synchronize(obj)
    settings, wanted = parameters.split(settings)
    asked = constraints.read(obj, **wanted)
    return optimize_on(surface_of(obj), vertices, closed=closed, close=close, constraints=asked, **settings)


def optimize_on(surface, vertices, closed=True, close=False, progress=None, **settings):
    """The same on a native surface, of `surface_of`; `progress` and `constraints` as in optimize_all_on."""
    if close:
        closing, progress = jobs.share_of(progress, 0, 2), jobs.share_of(progress, 1, 2)
        loop = native.module().close_contour(surface, vertices, progress=closing)
        if loop is None:  # cancelled: so is the search
            return optimize_all_on(surface, [vertices], closed=False, progress=lambda _: False, **settings)[0]
        vertices, closed = loop, True
    return optimize_all_on(surface, [vertices], closed=closed, progress=progress, **settings)[0]


def optimize_all_on(surface, contours, closed=True, progress=None, constraints=None, **settings):
    """Several contours of a native surface together, which never cross; `closed` is one for all or one for each.

    `contours` are sequences of vertices or earlier results. `progress` is called with the share done, 0 to 1; where it
    returns False the search ends, status "cancelled", and an exception that it raises passes through. `constraints` is
    what `constraints.read` gives. Returns an `mrcontour.Result` for each contour.
    """
    mrc = native.module()
    each_closed = [closed] * len(contours) if isinstance(closed, bool) else closed
    keywords = native_keywords(mrc, surface, contours, each_closed, settings, constraints)
    return mrc.optimize_all(surface, contours, closed=closed, progress=progress, **keywords)


def problem_on(surface, vertices, closed=True, barriers=()):
    """Why these vertices are no contour that could be optimized, in words; empty where they are one."""
    return native.contour_problem(surface, vertices, closed, barriers)


def optimize_seams(obj, selected_only=False, apply=False, merge=0.0, **settings):
    """Optimizes all seams of a mesh, or those among its selected edges; with apply they move there.

    Those across faces, with the setting `refinement`, are cut into the mesh; `merge` is that of Optimize Contour.
    The settings are those of `parameters.NETWORK`. Returns the native results, one for each chain between junctions and
    each closed loop that could move.
    """
    mesh_access.synchronize(obj)
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
    mesh_access.synchronize(obj)
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
    mesh_access.synchronize(obj)
    mrc = native.module()
    return mrc.curvature(surface_of(obj), mrc.Options(**options))


def surface_of(obj, beside=()):
    """The native surface of a synchronized mesh object; see arrays_and_surface_of."""
    return arrays_and_surface_of(obj, beside)[1]


def arrays_and_surface_of(obj, beside=()):
    """The arrays of a synchronized mesh object and the native surface made from them.

    They are kept while the mesh is unchanged, along with those of the objects `beside` it. Whether it is unchanged is
    seen by comparing all arrays, which takes ten milliseconds for a million triangles and cannot be fooled.
    """
    mrc = native.module()
    arrays = mesh_access.read_arrays(obj)
    name = obj.data.name_full
    _forget_others({name} | {other.data.name_full for other in beside})
    known = _kept.get(name)
    if known is None or not known[0].equal(arrays):
        _kept.pop(name, None)
        _kept[name] = arrays, mrc.Surface(**arrays.keywords())
    return _kept[name]


def are_current(surfaces):
    """Whether pairs of an object and its surface still belong together: the meshes are as they were, in Edit Mode."""
    try:
        for obj, surface in surfaces:
            mesh_access.synchronize(obj)
            if surface_of(obj, beside=[other for other, _ in surfaces]) is not surface:
                return False
    except ReferenceError:  # an object that was deleted
        return False
    return True


def forget():
    """Drops the surfaces that are kept."""
    _kept.clear()


def _plan(obj, network, merge, settings):
    plan = networks.optimize(surface_of(obj) if network.movable else None, network, **settings)
    return network_cutting.settled(obj, plan, merge)


def _forget_others(names):
    for name in _kept.keys() - names:
        del _kept[name]


def register():
    """Nothing to do; here for symmetry."""


def unregister():
    forget()
