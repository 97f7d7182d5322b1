// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/types.h>

#include <limits>

namespace mrc {

/// The scales of a contour, fixed before its first iteration at the contour as given.
struct Scales {
    double h = 0.0;        ///< mean length of the real edges between the vertices at most 4 real edges from the contour
    double K = 0.0;        ///< area-weighted mean of |kappa_min| over those vertices (ridge: |kappa_max|), at least 0.01 / L0
    double kappa_0 = 0.0;  ///< eq. 3.2's constant: kappa0_factor K
    double L0 = 0.0;       ///< length of the contour
    double clamp = std::numeric_limits<double>::infinity();  ///< where |kappa_min| (ridge: |kappa_max|) of features is cut off
    int n0 = 0;                                              ///< its number of arcs, with the search's Steiner points
    Contour given;                                           ///< the contour itself

    bool operator==(const Scales&) const = default;
};

}  // namespace mrc
