// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "attraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mrc {
namespace {

class Attracted : public testing::Test {
  protected:
    static constexpr int width = 13;
    const Surface surface = made::plate(width - 1, 8).surface();

    double pull(const std::vector<Attractor>& attractors, const SurfacePoint& p) const {
        return Attraction(surface, attractors).at(p);
    }
    static double steps(int a, int b) { return std::abs(a % width - b % width) + std::abs(a / width - b / width); }
    static std::vector<Attractor> many() {
        std::mt19937 random(5);
        std::vector<Attractor> attractors;
        for (int i = 0; i < 12; ++i) {
            const double radius = 1.0 + static_cast<double>(random() % 5);
            attractors.push_back({static_cast<int>(random() % 117), radius, i % 3 - 1.5, 0.7 * radius});
        }
        return attractors;
    }
};

TEST_F(Attracted, by_a_gaussian_of_the_way_along_the_surface_up_to_the_radius) {
    const Attraction attraction(surface, std::vector<Attractor>{{45, 4.0, 2.0, 1.5}});
    for (int v = 0; v < surface.vertex_count(); ++v) {
        const double d = steps(45, v);
        EXPECT_NEAR(attraction.at(vertex_point(v)), d <= 4.0 ? 2.0 * std::exp(-d * d / (2.0 * 1.5 * 1.5)) : 0.0, 1e-14);
    }
}

TEST_F(Attracted, with_half_the_radius_as_sigma_where_none_is_given) {
    EXPECT_EQ(pull({{45, 4.0, 1.0, {}}}, vertex_point(47)), pull({{45, 4.0, 1.0, 2.0}}, vertex_point(47)));
    EXPECT_NEAR(pull({{45, 4.0, 1.0, {}}}, vertex_point(47)), std::exp(-0.5), 1e-14);
}

TEST_F(Attracted, inside_an_edge_by_the_distance_there_also_where_one_end_is_too_far) {
    const std::vector<Attractor> attractors{{45, 2.5, 1.0, 1.0}};
    EXPECT_NEAR(pull(attractors, {47, 48, 0.25}), std::exp(-0.5 * 2.25 * 2.25), 1e-14);
    EXPECT_NEAR(pull(attractors, {48, 47, 0.75}), std::exp(-0.5 * 2.25 * 2.25), 1e-14);
    EXPECT_EQ(pull(attractors, {47, 48, 0.75}), 0.0);
}

TEST_F(Attracted, by_each_as_if_it_were_alone) {
    const std::vector<Attractor> attractors = many();
    for (int v = 0; v < surface.vertex_count(); ++v) {
        double sum = 0.0;
        for (const Attractor& one : attractors) sum += pull({one}, vertex_point(v));
        EXPECT_NEAR(pull(attractors, vertex_point(v)), sum, 1e-13);
    }
}

TEST_F(Attracted, whatever_the_order_of_the_attractors_and_of_the_questions) {
    const std::vector<Attractor> attractors = many();
    std::vector<Attractor> backwards = attractors;
    std::ranges::reverse(backwards);
    const Attraction one(surface, attractors), other(surface, backwards);
    for (int v = 0; v < surface.vertex_count(); ++v) {
        const int w = surface.vertex_count() - 1 - v;
        other.at(vertex_point(w));
        EXPECT_NEAR(one.at(vertex_point(v)), other.at(vertex_point(v)), 1e-13);
    }
}

TEST_F(Attracted, the_other_way_by_a_negative_strength) {
    EXPECT_EQ(pull({{45, 3.0, -2.0, {}}}, vertex_point(46)), -pull({{45, 3.0, 2.0, {}}}, vertex_point(46)));
    EXPECT_EQ(pull({}, vertex_point(46)), 0.0);
}

}  // namespace
}  // namespace mrc
