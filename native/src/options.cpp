// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/options.h>

#include <mrc/types.h>

#include <cmath>
#include <sstream>

namespace mrc {
namespace {

void require(bool valid, const char* name, double value, const char* range) {
    if (valid) return;
    std::ostringstream message;
    message << "option " << name << " is " << value << ": it must be " << range;
    throw InvalidInput(message.str());
}

}  // namespace

void Options::check() const {
    const auto finite_above = [](double value, double least) { return std::isfinite(value) && value > least; };
    require(!width || *width >= 1, "width", width.value_or(1), "at least 1, or none for the whole surface");
    require(finite_above(curvature_radius, 0.0), "curvature_radius", curvature_radius, "above 0");
    require(std::isfinite(curvature_smoothing) && curvature_smoothing >= 0.0, "curvature_smoothing", curvature_smoothing, "0 or more");
    require(finite_above(kappa0_factor, 0.0), "kappa0_factor", kappa0_factor, "above 0");
    require(finite_above(feature_exponent, 0.0), "feature_exponent", feature_exponent, "above 0");
    require(finite_above(direction_exponent, 0.0), "direction_exponent", direction_exponent, "above 0");
    require(max_turn > 0.0 && max_turn <= std::numbers::pi + 1e-9, "max_turn", max_turn, "above 0 and at most pi");
    require(iterations >= 0, "iterations", iterations, "0 or more");
}

}  // namespace mrc
