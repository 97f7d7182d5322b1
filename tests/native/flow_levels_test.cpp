// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace mrc {
namespace {

/// A ring of points whose flow goes around once, with segments between some of them.
class Levels : public testing::TestWithParam<unsigned> {
  protected:
    static constexpr int count = 40;
    std::mt19937 random{GetParam()};
    std::vector<double> values;
    std::vector<Segment> segments;

    void SetUp() override {
        std::uniform_real_distribution<double> any(0.0, 1.0), noise(-0.01, 0.01);
        for (int p = 0; p < count; ++p) values.push_back(std::floor(8.0 * any(random)) / 8.0 + noise(random));
        for (int i = 0; i < 3 * count; ++i) {
            const int a = static_cast<int>(random() % count), b = static_cast<int>(random() % count);
            if (a == b) continue;
            // The shorter path around.
            segments.push_back({a, b, -static_cast<int>(std::lround(values[b] - values[a])), -1, -1});
        }
    }
    double rise(const Segment& s) const { return values[s.b] - values[s.a] + s.jump; }
};

TEST_P(Levels, the_whole_and_the_broken_part_make_up_the_value_above_the_level) {
    for (const double value : {-1.7, -1.0, -0.2, 0.0, 0.3, 0.99, 1.0, 2.4}) {
        for (const double level : {0.0, 0.3, 0.9}) {
            EXPECT_NEAR(whole(value, level) + above(value, level), value - level, 1e-15);
            EXPECT_GE(above(value, level), 0.0);
            EXPECT_LT(above(value, level), 1.0);
        }
    }
}

TEST_P(Levels, a_segment_is_level_or_rises_by_the_tolerance) {
    for (const double tolerance : {0.001, 0.005, 0.02}) {
        merge_levels(values, segments, tolerance);
        int level = 0;
        for (const Segment& s : segments) {
            if (values[s.a] == values[s.b] && s.jump == 0) {
                ++level;
            } else {
                EXPECT_GE(std::abs(rise(s)), tolerance * (1.0 - 1e-9));
            }
        }
        if (tolerance > 0.01) {
            EXPECT_GT(level, 0);
        }
    }
}

TEST_P(Levels, merging_again_changes_nothing) {
    merge_levels(values, segments, 0.02);
    const std::vector<double> once = values;
    merge_levels(values, segments, 0.02);
    EXPECT_EQ(values, once);
}

TEST_P(Levels, merging_moves_no_value_far_but_by_a_whole_number_that_the_jumps_take_back) {
    const std::vector<double> before = values;
    const std::vector<Segment> uncut = segments;
    merge_levels(values, segments, 0.005);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const double was = before[uncut[i].b] - before[uncut[i].a] + uncut[i].jump;
        EXPECT_NEAR(rise(segments[i]), was, 0.1);
    }
}

TEST_P(Levels, the_mean_of_a_class_stays) {
    // Points that one segment joins to a partner alone.
    values = {0.10, 0.101, 0.50, 0.498, 0.999, 0.001};
    segments = {{0, 1, 0, -1, -1}, {2, 3, 0, -1, -1}, {4, 5, 1, -1, -1}};
    merge_levels(values, segments, 0.01);
    EXPECT_NEAR(values[0], 0.1005, 1e-12);
    EXPECT_EQ(values[1], values[0]);
    EXPECT_NEAR(values[2], 0.499, 1e-12);
    EXPECT_EQ(values[3], values[2]);
    EXPECT_NEAR(std::abs(values[4] - std::round(values[4])), 0.0, 1e-12);
    EXPECT_EQ(values[5], values[4]);
    for (const Segment& s : segments) EXPECT_EQ(s.jump, 0);
}

TEST_P(Levels, the_cheapest_has_no_point_and_no_other_is_crossed_by_fewer) {
    const auto crossings = [&](double level) {
        int sum = 0;
        for (const Segment& s : segments) sum += std::abs(s.jump + whole(values[s.b], level) - whole(values[s.a], level));
        return sum;
    };
    const double cheapest = cheapest_level(values, segments);
    for (const double value : values) EXPECT_GT(std::min(above(value, cheapest), 1.0 - above(value, cheapest)), 1e-10);
    int least = static_cast<int>(segments.size());
    std::map<double, int> places;
    for (const double value : values) places.emplace(above(value, 0.0), 0);
    double last = places.rbegin()->first - 1.0;
    for (const auto& [place, unused] : places) {
        if (place - last > 2e-9) least = std::min(least, crossings(0.5 * (last + place)));
        last = place;
    }
    EXPECT_EQ(crossings(cheapest), least);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Levels, testing::Range(1U, 4U));

}  // namespace
}  // namespace mrc
