// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "distances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace mrc {
namespace {

class Distances : public testing::Test {
  protected:
    static constexpr int columns = 9, rows = 7, width = columns + 1;
    const Surface surface = made::plate(columns, rows).surface();

    static Contour at_vertex(int vertex) { return {{vertex_point(vertex)}, false}; }
    static int steps(int a, int b) { return std::abs(a % width - b % width) + std::abs(a / width - b / width); }
};

TEST_F(Distances, on_a_plate_of_squares_go_along_their_sides) {
    for (const int start : {0, 34, 79}) {
        const DistanceField field(surface, at_vertex(start));
        for (int v = 0; v < surface.vertex_count(); ++v) EXPECT_DOUBLE_EQ(field.at(v), steps(start, v));
    }
}

TEST_F(Distances, are_those_to_the_nearest_point_of_the_contour) {
    const std::vector<int> vertices{11, 12, 22, 32, 33};
    const DistanceField field(surface, vertex_contour(vertices, false));
    for (int v = 0; v < surface.vertex_count(); ++v) {
        int least = steps(vertices[0], v);
        for (const int start : vertices) least = std::min(least, steps(start, v));
        EXPECT_DOUBLE_EQ(field.at(v), least);
        EXPECT_EQ(steps(vertices[field.nearest(v)], v), least);
    }
}

TEST_F(Distances, from_inside_an_edge_begin_with_the_way_to_its_ends) {
    const DistanceField field(surface, {{{33, 34, 0.25}}, false});
    for (int v = 0; v < surface.vertex_count(); ++v)
        EXPECT_DOUBLE_EQ(field.at(v), std::min(0.25 + steps(33, v), 0.75 + steps(34, v)));
}

TEST_F(Distances, are_linear_along_an_edge) {
    const DistanceField field(surface, at_vertex(0));
    for (const double t : {0.0, 0.3, 1.0}) EXPECT_DOUBLE_EQ(field.at({12, 13, t}), 3.0 + t);
    EXPECT_DOUBLE_EQ(field.at(vertex_point(12)), 3.0);
}

TEST_F(Distances, are_the_same_there_and_back_and_grow_with_the_mesh) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-0.4, 0.4);
    const made::Mesh rough = made::plate(columns, rows).mapped([&](const Vec3& p) { return Vec3(p + Vec3(0, 0, any(random))); });
    const Surface one = rough.surface(), twice = rough.mapped([](const Vec3&p) { return Vec3(2.0 * p); }).surface();
    for (const int a : {0, 27, 44}) {
        const DistanceField from_a(one, at_vertex(a)), in_twice(twice, at_vertex(a));
        for (int b = 0; b < one.vertex_count(); b += 7) {
            EXPECT_DOUBLE_EQ(from_a.at(b), DistanceField(one, at_vertex(b)).at(a));
            EXPECT_DOUBLE_EQ(in_twice.at(b), 2.0 * from_a.at(b));
        }
    }
}

TEST_F(Distances, reach_what_is_no_farther_whatever_was_asked_before) {
    for (int v = 0; v < surface.vertex_count(); ++v) {
        const DistanceField field(surface, at_vertex(34));
        EXPECT_FALSE(field.reaches(v, steps(34, v) - 0.5));
        EXPECT_TRUE(field.reaches(v, steps(34, v)));
        EXPECT_FALSE(field.reaches(v, steps(34, v) - 0.5));
    }
}

TEST_F(Distances, are_infinite_where_no_edges_lead) {
    const Surface two = made::plate(2, 2).beside(made::plate(1, 1)).surface();
    const DistanceField field(two, at_vertex(0));
    EXPECT_EQ(field.at(9), std::numeric_limits<double>::infinity());
    EXPECT_EQ(field.nearest(9), -1);
    EXPECT_FALSE(field.reaches(9, 1e300));
}

TEST_F(Distances, rings_hold_what_is_so_many_edges_away_from_near_to_far) {
    const std::vector<int> start{34, 36, 34};
    for (int rings = 0; rings < 6; ++rings) {
        const std::vector<int> found = vertices_within(surface, start, rings);
        const auto ring = [&](int v) { return std::min(steps(34, v), steps(36, v)); };
        std::set<int> expected;
        for (int v = 0; v < surface.vertex_count(); ++v) {
            if (ring(v) <= rings) expected.insert(v);
        }
        EXPECT_EQ(std::set<int>(found.begin(), found.end()), expected);
        EXPECT_EQ(found.size(), expected.size());
        EXPECT_TRUE(std::ranges::is_sorted(found, {}, ring));
    }
}

}  // namespace
}  // namespace mrc
