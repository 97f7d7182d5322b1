// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include <mrc/curvature.h>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>

namespace mrc {
namespace {

class CurvatureOf : public testing::Test {
  protected:
    static constexpr double rough = 0.05;  // of the value, for meshes as fine as these
    const made::Mesh round_torus = made::torus(96, 32);

    static std::vector<VertexCurvature> of(const made::Mesh& mesh) { return curvature(mesh.surface()); }
    static double cosine_of(const Vec3& a, const Vec3& b) { return std::abs(a.normalized().dot(b.normalized())); }
};

TEST_F(CurvatureOf, a_ball_is_one_over_its_radius_every_way) {
    const made::Mesh ball = made::ball(48, 25, 2.0);
    const std::vector<VertexCurvature> found = of(ball);
    for (std::size_t v = 0; v < found.size(); ++v) {
        if (std::abs(ball.points[v].z()) > 1.2) continue;  // slender triangles
        EXPECT_NEAR(found[v].kappa_min, 0.5, 2.0 * rough);
        EXPECT_NEAR(found[v].kappa_max, 0.5, 2.0 * rough);
        EXPECT_GT(found[v].normal.dot(ball.points[v].normalized()), 0.999);
    }
}

TEST_F(CurvatureOf, a_tube_is_one_over_its_radius_round_it_and_none_along_it) {
    const made::Mesh tube = made::tube(48, 40, 2.0);
    const std::vector<VertexCurvature> found = of(tube);
    for (std::size_t v = 10 * 48; v < 31 * 48; ++v) {
        const Vec3 &p = tube.points[v], round(-p.y(), p.x(), 0.0);
        EXPECT_EQ(found[v].kappa_min, 0.0);
        EXPECT_NEAR(found[v].kappa_max, 0.5, 0.5 * rough);
        EXPECT_GT(cosine_of(found[v].direction_max, round), 1.0 - 1e-6);
        EXPECT_GT(cosine_of(found[v].direction_min, Vec3::UnitZ()), 1.0 - 1e-6);
        EXPECT_FALSE(found[v].umbilic);
    }
}

TEST_F(CurvatureOf, a_torus_is_that_of_the_formula) {
    const std::vector<VertexCurvature> found = of(round_torus);
    for (std::size_t v = 0; v < found.size(); ++v) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(v % 32) / 32;
        EXPECT_NEAR(found[v].kappa_max, 1.0, 2.0 * rough);
        EXPECT_NEAR(found[v].kappa_min, std::cos(angle) / (3.0 + std::cos(angle)), rough);
    }
}

TEST_F(CurvatureOf, a_plate_is_none) {
    for (const VertexCurvature& c : of(made::plate(8, 8))) {
        EXPECT_EQ(c.kappa_min, 0.0);
        EXPECT_EQ(c.kappa_max, 0.0);
        EXPECT_TRUE(c.umbilic);
    }
}

TEST_F(CurvatureOf, a_surface_turned_inside_out_changes_its_sign_and_trades_its_directions) {
    const std::vector<VertexCurvature> outside = of(round_torus), inside = of(round_torus.inside_out());
    for (std::size_t v = 0; v < outside.size(); ++v) {
        EXPECT_NEAR(inside[v].kappa_min, -outside[v].kappa_max, 0.5 * rough);  // squares are cut along other diagonals
        EXPECT_NEAR(inside[v].kappa_max, -outside[v].kappa_min, 0.5 * rough);
        EXPECT_GT(cosine_of(inside[v].direction_min, outside[v].direction_max), 0.99);
        EXPECT_LT(inside[v].normal.dot(outside[v].normal), -0.999);
    }
}

TEST_F(CurvatureOf, a_surface_turns_and_shrinks_with_it) {
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    const std::vector<VertexCurvature> one = of(round_torus);
    const std::vector<VertexCurvature> other = of(round_torus.mapped([&](const Vec3& p) { return Vec3(4.0 * (turned * p)); }));
    for (std::size_t v = 0; v < one.size(); ++v) {
        EXPECT_NEAR(other[v].kappa_min, one[v].kappa_min / 4.0, 1e-9);
        EXPECT_NEAR(other[v].kappa_max, one[v].kappa_max / 4.0, 1e-9);
        EXPECT_GT(cosine_of(other[v].direction_max, turned * one[v].direction_max), 1.0 - 1e-6);
        EXPECT_LT((other[v].normal - turned * one[v].normal).norm(), 1e-9);
    }
}

TEST_F(CurvatureOf, a_vertex_does_not_depend_on_its_number) {
    const std::vector<int> number = made::shuffled(static_cast<int>(round_torus.points.size()));
    const std::vector<VertexCurvature> one = of(round_torus), other = of(round_torus.renumbered(number));
    for (std::size_t v = 0; v < one.size(); ++v) {
        EXPECT_NEAR(other[number[v]].kappa_min, one[v].kappa_min, 1e-9);
        EXPECT_NEAR(other[number[v]].kappa_max, one[v].kappa_max, 1e-9);
    }
}

TEST_F(CurvatureOf, every_vertex_has_a_frame_of_unit_directions) {
    for (const VertexCurvature& c : of(round_torus)) {
        Eigen::Matrix3d frame;
        frame << c.direction_min, c.direction_max, c.normal;
        EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-9);
        EXPECT_LE(c.kappa_min, c.kappa_max);
    }
}

}  // namespace
}  // namespace mrc
