# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors for curvatures, on a diverging scale. Needs no Blender."""

import numpy as np

# Valleys blue, flat places nearly white, convex ones red: as ColorBrewer's RdBu, readable for the color-blind too,
# with brighter ends, since shading darkens valleys.
_PLACES = (-1.0, -0.5, 0.0, 0.5, 1.0)
_COLORS = np.array(((10, 70, 230), (100, 170, 245), (247, 247, 247), (244, 165, 130), (190, 30, 45))) / 255


def colors(curvatures, quantile):
    """(n, 4) linear colors; from this quantile of their sizes on, curvatures have the full color."""
    curvatures = np.nan_to_num(np.asarray(curvatures, dtype=float))
    fractions = curvatures / full_size(curvatures, quantile)
    shades = np.column_stack([np.interp(fractions, _PLACES, channel) for channel in _COLORS.T])
    return np.column_stack([_linear(shades), np.ones(len(shades))])


def full_size(curvatures, quantile):
    """The size of curvature that has the full color."""
    sizes = np.abs(curvatures[curvatures != 0])
    return np.quantile(sizes, quantile) if len(sizes) else 1.0


def _linear(srgb):
    """Blender keeps colors linear (IEC 61966-2-1)."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
