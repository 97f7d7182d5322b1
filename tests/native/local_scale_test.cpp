// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "local_scale.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <utility>
#include <vector>

namespace mrc {
namespace {

const double round_share = std::pow(2.0, -0.25);  // that a square or an equilateral triangle counts of its side

class ScaleOf : public testing::Test {
  protected:
    static double lone(const std::vector<Vec3>& points) {
        made::Mesh mesh;
        mesh.points = points;
        mesh.faces.emplace_back();
        for (int i = 0; i < static_cast<int>(points.size()); ++i) mesh.faces[0].push_back(i);
        return extent_across(mesh.surface(), 0);
    }
    static std::vector<double> of(const made::Mesh& mesh) {
        const Surface surface = mesh.surface();
        LocalScale scale(surface);
        std::vector<double> found;
        for (int v = 0; v < surface.vertex_count(); ++v) found.push_back(scale.at(v));
        return found;
    }
};

TEST_F(ScaleOf, a_polygon_is_its_short_side_where_it_is_long_and_a_share_of_its_side_where_it_is_round) {
    EXPECT_NEAR(lone({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}), 2.0 * round_share, 1e-12);
    EXPECT_NEAR(lone({{0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}}), 2.0 * round_share, 1e-12);
    EXPECT_NEAR(lone({{0, 0, 0}, {1000, 0, 0}, {1000, 0, 2}, {0, 0, 2}}), 2.0, 1e-5);
    EXPECT_NEAR(lone({{0, 0, 0}, {2, 0, 0}, {0, 1000, 0}}), 2.0, 1e-5);
    EXPECT_EQ(lone({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}), 0.0);
    EXPECT_EQ(lone({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), 0.0);
}

TEST_F(ScaleOf, a_regular_grid_is_the_same_share_of_its_edges_everywhere) {
    for (const double scale : of(made::plate(6, 5))) EXPECT_NEAR(scale, round_share, 1e-12);
}

TEST_F(ScaleOf, a_surface_turns_and_grows_with_it) {
    const made::Mesh torus = made::torus(24, 12);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(2, 1, -1).normalized()).toRotationMatrix();
    const std::vector<double> one = of(torus), other = of(torus.mapped([&](const Vec3&p) { return Vec3(1e-3 * (turn * p)); }));
    for (std::size_t v = 0; v < one.size(); ++v) EXPECT_NEAR(other[v], 1e-3 * one[v], 1e-13);
}

TEST_F(ScaleOf, a_tube_is_what_lies_between_its_long_edges_however_long_they_are) {
    const int around = 48;
    const double side = 2.0 * std::sin(std::numbers::pi / around);
    for (const double length : {20.0 * side, 1.0, 100.0}) {
        const std::vector<double> found = of(made::tube(around, 4, 1.0, length));
        for (int i = 0; i < around; ++i) EXPECT_NEAR(found[2 * around + i], side, 0.02 * side);
    }
}

TEST_F(ScaleOf, a_rim_is_that_of_the_narrow_faces_beside_a_vast_one) {
    made::Mesh cup = made::tube(64, 8, 1.0, 0.1);
    const double before = of(cup)[3];
    cup.faces.emplace_back();
    for (int i = 63; i >= 0; --i) cup.faces.back().push_back(i);
    EXPECT_NEAR(of(cup)[3], before, 0.05 * before);
}

TEST_F(ScaleOf, a_vertex_hardly_changes_where_an_edge_collapses_to_a_needle) {
    made::Mesh plate = made::plate(9, 9);
    const int middle = 5 * 10 + 5;
    const double before = of(plate)[middle];
    plate.points[middle + 1] = plate.points[middle] + Vec3(1e-9, 0, 0);
    for (const int v : {middle, middle + 1}) EXPECT_NEAR(of(plate)[v], before, 0.5 * before);
}

TEST_F(ScaleOf, a_surface_without_area_is_the_mean_edge_and_without_length_zero) {
    const auto line = made::plate(3, 3).mapped([](const Vec3& p) { return Vec3(p.x(), 0, 0); });
    for (const double scale : of(line)) EXPECT_NEAR(scale, 1.0, 1e-12);
    for (const double scale : of(line.mapped([](const Vec3&) { return Vec3(1, 1, 1); }))) EXPECT_EQ(scale, 0.0);
}

TEST_F(ScaleOf, a_vertex_is_the_same_in_whatever_order_it_is_asked) {
    const Surface surface = made::torus(24, 12).surface();
    LocalScale forwards(surface), backwards(surface);
    std::vector<double> expected;
    for (int v = 0; v < surface.vertex_count(); ++v) expected.push_back(forwards.at(v));
    for (int v = surface.vertex_count() - 1; v >= 0; --v) EXPECT_EQ(backwards.at(v), expected[v]);
}

}  // namespace
}  // namespace mrc
