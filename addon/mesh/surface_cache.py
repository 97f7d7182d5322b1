# SPDX-License-Identifier: GPL-3.0-or-later
"""The native surfaces of the meshes of the last call, kept while these meshes are unchanged."""

from ..core import native
from .arrays import read_arrays, synchronize

_kept = {}  # mesh name -> (MeshArrays, Surface)


def surface_of(obj, beside=()):
    """The native surface of a synchronized mesh object; see arrays_and_surface_of."""
    return arrays_and_surface_of(obj, beside)[1]


def arrays_and_surface_of(obj, beside=()):
    """The arrays of a synchronized mesh object and the native surface made from them.

    They are kept while the mesh is unchanged, along with those of the objects `beside` it. Whether it is unchanged is
    seen by comparing all arrays, which takes ten milliseconds for a million triangles and cannot be fooled.
    """
    mrc = native.module()
    arrays = read_arrays(obj)
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
            synchronize(obj)
            if surface_of(obj, beside=[other for other, _ in surfaces]) is not surface:
                return False
    except ReferenceError:  # an object that was deleted
        return False
    return True


def forget():
    """Drops the surfaces that are kept."""
    _kept.clear()


def _forget_others(names):
    for name in _kept.keys() - names:
        del _kept[name]
