// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/options.h>

#include <mrc/errors.h>

#include "input_range.h"
#include "number_text.h"

#include <cmath>
#include <string>

namespace mrc {
namespace {

void require(bool valid, const char* name, double value, const char* range) {
    if (valid) return;
    std::string message = std::string("option ") + name + " is " + number_text(value) + ": it must be " + range;
    if (std::abs(value) > largest_input) message += ", and no larger than " + number_text(largest_input);
    throw InvalidInput(ErrorCode::invalid_option, message);
}

}  // namespace

Options Options::recommended() {
    Options options;
    options.width = 8;
    options.band_distance = 0.16;
    options.iterations = 2;
    options.length_bias = 2.0;
    options.length_floor = 0.5;
    options.anchor = 0.5;
    options.feature_clamp = 0.9;
    options.crease = 0.5;
    options.ends = Ends::edges_or_border;
    options.min_salience = 0.25;
    options.max_turn = 100.0 * (std::numbers::pi / 180.0);  // contours climb quads in stairs
    return options;
}

void Options::check() const {
    const auto finite_above = [](double value, double least) { return in_input_range(value) && value > least; };
    require(!width || *width >= 1, "width", width.value_or(1), "at least 1, or none for the whole surface");
    require(finite_above(curvature_radius, 0.0), "curvature_radius", curvature_radius, "above 0");
    require(in_input_range(curvature_smoothing) && curvature_smoothing >= 0.0, "curvature_smoothing", curvature_smoothing,
            "0 or more");
    require(finite_above(kappa0_factor, 0.0), "kappa0_factor", kappa0_factor, "above 0");
    const auto exponent = [](double value, const char* name) {
        require(value > 0.0 && value <= 16.0, name, value, "above 0 and at most 16");  // further powers are no numbers any more
    };
    exponent(feature_exponent, "feature_exponent");
    exponent(direction_exponent, "direction_exponent");
    require(max_turn > 0.0 && max_turn <= std::numbers::pi + 1e-9, "max_turn", max_turn, "above 0 and at most pi");
    require(!band_distance || finite_above(*band_distance, 0.0), "band_distance", band_distance.value_or(0.0), "above 0, or none");
    require(in_input_range(region_weight), "region_weight", region_weight, "a number");
    const auto weight = [&](double value, const char* name) {
        require(in_input_range(value) && value >= 0.0, name, value, "0 or more");
    };
    weight(anchor, "anchor");
    weight(crease, "crease");
    weight(length_bias, "length_bias");
    weight(length_floor, "length_floor");
    require(!feature_clamp || (*feature_clamp > 0.0 && *feature_clamp < 1.0), "feature_clamp", feature_clamp.value_or(0.0),
            "between 0 and 1, or none");
    require(!min_salience || in_input_range(*min_salience), "min_salience", min_salience.value_or(0.0), "a number, or none");
    if (length_bias > 0.0 && (length_measure == LengthMeasure::edges) != (denominator == Denominator::arcs)) {
        throw InvalidInput(
            ErrorCode::invalid_option,
            "with a length_bias, length_measure and denominator go together: 'arc' with 'length', or 'edges' with 'arcs'");
    }
    require(refinement >= 0, "refinement", refinement, "0 or more");
    require(regular_iterations >= 0, "regular_iterations", regular_iterations, "0 or more");
    require(iterations >= 0, "iterations", iterations, "0 or more");
    require(threads >= 0, "threads", threads, "0 or more");
}

}  // namespace mrc
