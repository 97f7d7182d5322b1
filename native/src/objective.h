// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrc {

/// What is minimized over paths with F = sum f and L = sum g: F / (scale L) + bias max(L, floor) (eq. 4.3, and 6.1 with a floor).
///
/// The paths below a value are those under a concave function h(L) = scale L (value - bias max(L, floor)), so every straight line
/// above it there rules paths out.
struct Objective {
    double scale = 1.0;
    double bias = 0.0;   ///< 0: the plain ratio
    double floor = 0.0;  ///< below this L nothing is gained by shrinking

    double value(double F, double L) const { return F / (scale * L) + bias * std::max(L, floor); }

    /// h'(L): the slope of the curve of paths of this value at L.
    double slope(double value, double L) const { return scale * (value - bias * (L > floor ? 2.0 * L : floor)); }

    /// The L at which h - lambda L is largest, from the floor on; with a bias.
    double peak(double value, double lambda) const {
        const double beyond = 0.5 * (scale * value - lambda) / (scale * bias);  // where the parabola has slope lambda
        return std::max(beyond, floor);
    }

    /// The least objective on or above the line F = lambda L + height, from L = shortest on; with a bias.
    double least_on_line(double lambda, double height, double shortest) const {
        double L = shortest;
        if (height > 0.0) L = std::max({L, floor, std::sqrt(height / (scale * bias))});
        return value(lambda * L + height, L);
    }

    /// The most that a path below `value` may have for F - lambda L, that is the maximum of h(L) - lambda L.
    double threshold(double value, double lambda) const {
        if (bias == 0.0) return scale * value > lambda ? std::numeric_limits<double>::infinity() : 0.0;
        const double L = peak(value, lambda);
        return std::max(0.0, scale * L * (value - bias * L) - lambda * L);
    }
};

}  // namespace mrc
