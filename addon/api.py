# SPDX-License-Identifier: GPL-3.0-or-later
"""For scripts: the same as the operators, without a selection, returning the native results.

>>> from minimum_ratio_contours import api
>>> result = api.optimize_contour(bpy.data.objects["Hand"], [12, 13, 40, 39], width=8)
>>> result.status, result.ratio, result.vertices

The settings are those of `parameters.SETTINGS`, for a mesh object also those of `parameters.CONSTRAINTS`, which name
its vertex groups, attributes and marked edges. Bad input raises a ValueError that names the elements.
"""

from . import constraints, mesh_access, native, parameters

_kept = {}  # mesh name -> (MeshArrays, Surface), of the meshes of the last call


def optimize_contour(obj, vertices, closed=True, **settings):
    """The minimum ratio contour near a given one, given by its vertices in order; the mesh stays as it is."""
    mesh_access.synchronize(obj)
    settings, wanted = parameters.split(settings)
    asked = constraints.read(obj, **wanted)
    return optimize_all_on(surface_of(obj), [vertices], closed=closed, constraints=asked, **settings)[0]


def optimize_on(surface, vertices, closed=True, **settings):
    """The same on a native surface."""
    return optimize_all_on(surface, [vertices], closed=closed, **settings)[0]


def optimize_all_on(surface, contours, closed=True, constraints=None, **settings):
    """Several contours of a native surface together, which never cross; `closed` is one for all or one for each."""
    mrc = native.module()
    options = parameters.native_options(**settings)
    if constraints is None:
        return mrc.optimize_all(surface, contours, closed=closed, options=mrc.Options(**options))
    each_closed = [closed] * len(contours) if isinstance(closed, bool) else closed
    keywords = constraints.keywords(mrc, surface, contours, each_closed, options)
    return mrc.optimize_all(surface, contours, closed=closed, **keywords)


def problem_on(surface, vertices, closed=True, barriers=()):
    """Why these vertices are no contour that could be optimized, in words; empty where they are one."""
    mrc = native.module()
    try:
        mrc.optimize(surface, vertices, closed=closed, barriers=barriers, options=mrc.Options(iterations=0))
    except ValueError as error:
        return str(error)
    return ""


def curvature(obj, **options):
    """The native principal curvatures at all vertices; the options are those of mrcontour.Options."""
    mesh_access.synchronize(obj)
    mrc = native.module()
    return mrc.curvature(surface_of(obj), mrc.Options(**options))


def surface_of(obj, beside=()):
    """The native surface of a synchronized mesh object.

    It is kept while the mesh is unchanged, along with those of the objects `beside` it. Whether it is unchanged is seen
    by comparing all arrays, which takes ten milliseconds for a million triangles and cannot be fooled.
    """
    mrc = native.module()
    arrays = mesh_access.read_arrays(obj)
    name = obj.data.name_full
    _forget_others({name} | {other.data.name_full for other in beside})
    known = _kept.get(name)
    if known is None or not known[0].equal(arrays):
        _kept.pop(name, None)
        _kept[name] = arrays, mrc.Surface(**vars(arrays))
    return _kept[name][1]


def forget():
    """Drops the surfaces that are kept."""
    _kept.clear()


def _forget_others(names):
    for name in _kept.keys() - names:
        del _kept[name]


def register():
    """Nothing to do; here for symmetry."""


def unregister():
    forget()
