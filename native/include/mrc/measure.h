// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/constraints.h>
#include <mrc/options.h>
#include <mrc/scales.h>
#include <mrc/surface.h>

#include <optional>

namespace mrc {

/// What a contour costs (eq. 3.3). Lengths are in the mesh's unit, ratios in its inverse.
struct Measure {
    double ratio = 0.0;      ///< numerator over length
    double numerator = 0.0;  ///< sum of f over the contour's arcs
    double length = 0.0;     ///< sum of g
    double objective =
        0.0;  ///< what is minimized: the ratio, or with a length bias ratio / K + length_bias max(length / L0, length_floor)
    double salience = 0.0;  ///< minus the ratio of eq. 3.2's energy alone, over K

    bool operator==(const Measure&) const = default;
};

/// The contour's ratio, without optimizing. Of the constraints, only the attractors and the region density count.
/// `progress` is called every few milliseconds; where it cancels, all values are 0.
/// @throws InvalidInput and TooLarge as `optimize` does, except for barriers.
Measure measure(const Surface& surface, const Contour& contour, const Options& options = {}, const Constraints& constraints = {},
                const std::optional<Scales>& scales = std::nullopt, const Progress& progress = {});

}  // namespace mrc
