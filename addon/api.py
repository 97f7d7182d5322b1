# SPDX-License-Identifier: GPL-3.0-or-later
"""For scripts: the same as the operators, without a selection, returning the native results.

>>> from minimum_ratio_contours import api
>>> result = api.optimize_contour(bpy.data.objects["Hand"], [12, 13, 40, 39], width=8)
>>> result.status, result.ratio, result.vertices

The settings are those of `parameters.SETTINGS`. Bad input raises a ValueError that names the elements.
"""

from . import mesh_access, native, parameters

_kept = {}  # mesh name -> (MeshArrays, Surface), of the meshes of the last call


def optimize_contour(obj, vertices, closed=True, **settings):
    """The minimum ratio contour near a given one, given by its vertices in order; the mesh stays as it is."""
    mesh_access.synchronize(obj)
    return optimize_on(surface_of(obj), vertices, closed=closed, **settings)


def optimize_on(surface, vertices, closed=True, **settings):
    """The same on a native surface."""
    return optimize_all_on(surface, [vertices], closed=closed, **settings)[0]


def optimize_all_on(surface, contours, closed=True, **settings):
    """Several contours of a native surface together, which never cross; `closed` is one for all or one for each."""
    mrc = native.module()
    options = mrc.Options(**parameters.native_options(**settings))
    return mrc.optimize_all(surface, contours, closed=closed, options=options)


def problem_on(surface, vertices, closed=True):
    """Why these vertices are no contour that could be optimized, in words; empty where they are one."""
    try:
        native.module().measure(surface, vertices, closed=closed)
    except ValueError as error:
        return str(error)
    return ""


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
        _kept[name] = arrays, mrc.Surface(**vars(arrays))
    return _kept[name]


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
