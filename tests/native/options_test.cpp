// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/errors.h>
#include <mrc/options.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace mrc {
namespace {

using OptionSetter = std::function<void(Options&, double)>;

/// An option with values at and just inside the ends of its range, and others at and just outside.
struct RangeOfOption {
    std::string name;
    OptionSetter set;
    std::vector<double> inside, outside;
};

constexpr double most = 1e50, tiny = 1e-300, nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity(), pi = std::numbers::pi;

template <class Field>
OptionSetter setter(Field Options::*field) {
    return [field](Options& options, double value) { options.*field = static_cast<Field>(value); };
}
OptionSetter setter(std::optional<int> Options::*field) {
    return [field](Options& options, double value) { options.*field = static_cast<int>(value); };
}

std::vector<RangeOfOption> option_ranges() {
    const std::vector<double> no_numbers{nan, infinite, -infinite, 1.01 * most, -1.01 * most};
    const auto with_no_numbers = [&](std::vector<double> values) {
        values.insert(values.end(), no_numbers.begin(), no_numbers.end());
        return values;
    };
    const std::vector<double> above_0{tiny, most}, not_above_0 = with_no_numbers({0.0, -tiny});
    const std::vector<double> from_0{0.0, most}, below_0 = with_no_numbers({-tiny});
    const std::vector<double> exponents{tiny, 16.0}, no_exponents = with_no_numbers({0.0, -1.0, 16.001});
    return {
        {"width", setter(&Options::width), {1, 1000}, {0, -1}},
        {"band_distance", setter(&Options::band_distance), above_0, not_above_0},
        {"curvature_radius", setter(&Options::curvature_radius), above_0, not_above_0},
        {"curvature_smoothing", setter(&Options::curvature_smoothing), from_0, below_0},
        {"kappa0_factor", setter(&Options::kappa0_factor), above_0, not_above_0},
        {"feature_exponent", setter(&Options::feature_exponent), exponents, no_exponents},
        {"direction_exponent", setter(&Options::direction_exponent), exponents, no_exponents},
        {"max_turn", setter(&Options::max_turn), {tiny, pi}, with_no_numbers({0.0, -1.0, pi + 1e-6})},
        {"anchor", setter(&Options::anchor), from_0, below_0},
        {"crease", setter(&Options::crease), from_0, below_0},
        {"feature_clamp", setter(&Options::feature_clamp), {tiny, 0.999}, with_no_numbers({0.0, 1.0})},
        {"region_weight", setter(&Options::region_weight), {-most, 0.0, most}, no_numbers},
        {"length_bias", setter(&Options::length_bias), from_0, below_0},
        {"length_floor", setter(&Options::length_floor), from_0, below_0},
        {"min_salience", setter(&Options::min_salience), {-most, 0.0, most}, no_numbers},
        {"refinement", setter(&Options::refinement), {0, 1000}, {-1}},
        {"regular_iterations", setter(&Options::regular_iterations), {0, 1000}, {-1}},
        {"iterations", setter(&Options::iterations), {0, 1000}, {-1}},
        {"threads", setter(&Options::threads), {0, 1000}, {-1}},
    };
}

std::string options_refusal(const Options& options) {
    try {
        options.check();
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "";
}

TEST(OptionRanges, hold_their_ends_and_nothing_beyond_and_refusals_name_the_option) {
    for (const RangeOfOption& option : option_ranges()) {
        for (const double value : option.inside) {
            Options options;
            option.set(options, value);
            EXPECT_EQ(options_refusal(options), "") << option.name << " " << value;
        }
        for (const double value : option.outside) {
            Options options;
            option.set(options, value);
            EXPECT_EQ(options_refusal(options).find("option " + option.name + " is "), 0U) << option.name << " " << value;
        }
    }
}

TEST(OptionRanges, hold_the_defaults_and_none) {
    Options options;
    EXPECT_EQ(options_refusal(options), "");
    options.width = {};
    options.band_distance = options.feature_clamp = options.min_salience = {};
    EXPECT_EQ(options_refusal(options), "");
}

TEST(OptionRanges, with_a_length_bias_what_is_counted_and_what_divides_go_together) {
    for (const double bias : {0.0, 1.0}) {
        for (const LengthMeasure measure : {LengthMeasure::arc, LengthMeasure::edges}) {
            for (const Denominator denominator : {Denominator::length, Denominator::arcs}) {
                Options options;
                options.length_bias = bias;
                options.length_measure = measure;
                options.denominator = denominator;
                const bool together = (measure == LengthMeasure::edges) == (denominator == Denominator::arcs);
                EXPECT_EQ(options_refusal(options).empty(), bias == 0.0 || together);
            }
        }
    }
}

}  // namespace
}  // namespace mrc
