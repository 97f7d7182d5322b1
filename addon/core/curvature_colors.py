# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps curvatures to colors on a diverging scale. Does not need Blender."""

import numpy as np

# Valleys are blue, flat places nearly white, convex places red. This is ColorBrewer's RdBu, which the color-blind can
# read too, with brighter ends, since shading darkens valleys.
_PLACES = (-1.0, -0.5, 0.0, 0.5, 1.0)
_COLORS = np.array(((10, 70, 230), (100, 170, 245), (247, 247, 247), (244, 165, 130), (190, 30, 45))) / 255


def colors(curvatures, quantile):
    """Return (n, 4) linear colors; curvatures above this quantile of the absolute values get the full color."""
    curvatures = np.nan_to_num(np.asarray(curvatures, dtype=float))
    fractions = curvatures / full_size(curvatures, quantile)
    shades = np.column_stack([np.interp(fractions, _PLACES, channel) for channel in _COLORS.T])
    return np.column_stack([_linear(shades), np.ones(len(shades))])


def full_size(curvatures, quantile):
    """Return the absolute curvature from which on the color is full."""
    sizes = np.abs(curvatures[curvatures != 0])
    return np.quantile(sizes, quantile) if len(sizes) else 1.0


def _linear(srgb):
    """Convert sRGB to the linear colors that Blender stores (IEC 61966-2-1)."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
