// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulate.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace mrc {
namespace {

using Triples = std::vector<std::array<int, 3>>;

Triples cut_up(const std::vector<Vec3>& corners) {
    Triangulator triangulator;
    const auto triangles = triangulator(corners);
    return {triangles.begin(), triangles.end()};
}

/// A polygon that sees its middle from every corner, with as many dents as corners out.
std::vector<Vec3> star(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> reach(0.3, 1.0);
    std::vector<Vec3> corners;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count, r = reach(random);
        corners.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    return corners;
}

double signed_area(const std::vector<Vec3>& corners, const std::array<int, 3>& t) {
    return 0.5 * (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]).z();
}

bool is_triangulation(int count, const Triples& triangles) {
    std::vector<int> polygon(count);
    std::iota(polygon.begin(), polygon.end(), 0);
    return PolygonSides(count).read(polygon, triangles, 0);
}

TEST(Triangulator, tiles_polygons_with_dents_by_triangles_that_face_the_same_way) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const int count = 4 + static_cast<int>(seed % 12);
        const std::vector<Vec3> corners = star(count, seed);
        const Triples triangles = cut_up(corners);
        double whole = 0.0, sum = 0.0;
        for (int i = 0; i < count; ++i) whole += 0.5 * corners[i].cross(corners[(i + 1) % count]).z();
        for (const auto& t : triangles) {
            EXPECT_GT(signed_area(corners, t), 0.0);
            sum += signed_area(corners, t);
        }
        EXPECT_NEAR(sum, whole, 1e-12);
        EXPECT_TRUE(is_triangulation(count, triangles));
    }
}

TEST(Triangulator, cuts_a_polygon_that_is_moved_turned_and_scaled_in_the_same_way) {
    const Eigen::Affine3d motion =
        Eigen::Translation3d(5.0, -3.0, 2.0) * Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()) * Eigen::Scaling(7.0);
    for (unsigned seed = 0; seed < 40; ++seed) {
        const std::vector<Vec3> corners = star(4 + static_cast<int>(seed % 9), seed);
        std::vector<Vec3> moved;
        for (const Vec3& p : corners) moved.push_back(motion * p);
        EXPECT_EQ(cut_up(moved), cut_up(corners));
    }
}

TEST(Triangulator, cuts_convex_quads_along_the_shorter_diagonal) {
    const std::vector<Vec3> quad{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 1, 0}};
    EXPECT_EQ(cut_up(quad), (Triples{{0, 1, 3}, {1, 2, 3}}));
    EXPECT_EQ(cut_up({quad[1], quad[2], quad[3], quad[0]}), (Triples{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulator, remembers_nothing_of_the_last_polygon) {
    Triangulator one;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const std::vector<Vec3> corners = star(3 + static_cast<int>(seed * 7 % 11), seed);
        const auto triangles = one(corners);
        EXPECT_EQ(Triples(triangles.begin(), triangles.end()), cut_up(corners));
    }
}

TEST(SidesOfPolygons, every_half_edge_is_a_side_or_half_of_a_diagonal) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        const int count = 3 + static_cast<int>(seed % 9), first = 5;
        const Triples triangles = cut_up(star(count, seed));
        std::vector<int> polygon(count);
        std::iota(polygon.begin(), polygon.end(), 0);
        PolygonSides sides(count);
        ASSERT_TRUE(sides.read(polygon, triangles, first));
        const auto ends = [&](int halfedge) {
            const auto& t = triangles[halfedge / 3 - first];
            return std::array{t[halfedge % 3], t[(halfedge + 1) % 3]};
        };
        std::vector<int> halves;
        sides.for_each_diagonal([&](int a, int b) {
            EXPECT_LT(a, b);
            EXPECT_EQ(ends(a)[0], ends(b)[1]);
            EXPECT_EQ(ends(a)[1], ends(b)[0]);
            halves.insert(halves.end(), {a, b});
        });
        EXPECT_EQ(static_cast<int>(halves.size()), 2 * (count - 3));
        for (int h = 3 * first; h < 3 * (first + count - 2); ++h) {
            const bool side = ends(h)[1] == (ends(h)[0] + 1) % count;
            EXPECT_NE(side, std::ranges::find(halves, h) != halves.end());
        }
    }
}

TEST(SidesOfPolygons, what_is_wrong_is_named) {
    const std::vector<int> polygon{10, 11, 12, 13, 14};
    const auto fault = [&](const Triples& triangles) {
        PolygonSides sides(20);
        return sides.read(polygon, triangles, 0) ? "" : sides.fault();
    };
    EXPECT_EQ(fault({{10, 11, 12}, {10, 12, 13}, {10, 13, 14}}), "");
    EXPECT_EQ(fault({{10, 11, 12}, {10, 12, 13}, {10, 13, 15}}), "vertex 15 of triangle 2 is not in the face");
    EXPECT_EQ(fault({{10, 11, 12}, {10, 12, 13}, {10, 14, 13}}), "triangle 2 runs against side 14-10");
    EXPECT_EQ(fault({{10, 11, 12}, {10, 11, 12}, {10, 13, 14}}), "side 10-11 occurs more than once");
    EXPECT_EQ(fault({{10, 11, 12}, {10, 12, 12}, {10, 13, 14}}), "triangle 1 repeats vertex 12");
}

}  // namespace
}  // namespace mrc
