// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/types.h>

#include <limits>

namespace mrc {

/// The scales of a contour, fixed before its first iteration at the contour as given.
struct Scales {
    double h = 0.0;  ///< mean of the surface's local scale (see `VertexCurvature`) along the contour
    /// Area-weighted mean of |kappa_min| (ridge: |kappa_max|), at least 0.01 / L0, over the vertices at most 4 real edges and 7 h
    /// from the contour; none counts with more than 3 squares of its local scale.
    double K = 0.0;
    double kappa_0 = 0.0;                                    ///< eq. 3.2's constant: kappa0_factor K
    double L0 = 0.0;                                         ///< length of the contour
    double clamp = std::numeric_limits<double>::infinity();  ///< where |kappa_min| (ridge: |kappa_max|) of features is cut off
    int n0 = 0;                                              ///< its number of arcs, with the search's Steiner points
    Contour given;                                           ///< the contour itself

    bool operator==(const Scales&) const = default;
};

}  // namespace mrc
