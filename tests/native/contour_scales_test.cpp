// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "contour_scales.h"
#include "distances.h"
#include "local_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace mrc {
namespace {

class ScalesOf : public testing::Test {
  protected:
    static constexpr int around = 48;
    const made::Mesh tube = made::tube(around, 24, 2.0);
    const Contour loop = made::ring(around, 12);
    const double perimeter = around * 4.0 * std::sin(std::numbers::pi / around);

    static Scales scales(const made::Mesh& mesh, const Contour& contour, const Options& options = {}) {
        const Surface surface = mesh.surface();
        return contour_scales(surface, CurvatureField(surface, options), contour, options);
    }
    static made::Mesh scaled(const made::Mesh& mesh, double by) {
        return mesh.mapped([=](const Vec3& p) { return Vec3(by * p); });
    }
};

TEST_F(ScalesOf, a_ring_has_the_length_of_its_polygon_and_an_open_one_lacks_the_last_side) {
    const Surface surface = tube.surface();
    EXPECT_NEAR(contour_length(surface, loop), perimeter, 1e-12);
    EXPECT_NEAR(contour_length(surface, {loop.points, false}), perimeter * (around - 1) / around, 1e-12);
    EXPECT_NEAR(scales(tube, loop).L0, perimeter, 1e-12);
}

TEST_F(ScalesOf, a_contour_has_the_mean_of_the_local_scale_along_it) {
    const made::Mesh squares = made::plate(30, 10);
    const made::Mesh wide =
        squares.mapped([](const Vec3& p) { return Vec3(p.x() + 2.0 * std::max(0.0, p.x() - 15.0), p.y(), 0.1 * p.x()); });
    const Contour fine = vertex_contour(std::vector<int>{5 + 31 * 4, 5 + 31 * 5, 5 + 31 * 6}, false),
                  coarse = vertex_contour(std::vector<int>{25 + 31 * 4, 25 + 31 * 5, 25 + 31 * 6}, false);
    std::vector<int> across(31);
    std::iota(across.begin(), across.end(), 31 * 5);
    double sum = 0.0, length = 0.0;
    const Surface surface = wide.surface();
    LocalScale scale(surface);
    for (std::size_t i = 1; i < across.size(); ++i) {
        const double size = (wide.points[across[i]] - wide.points[across[i - 1]]).norm();
        sum += 0.5 * size * (scale.at(across[i - 1]) + scale.at(across[i]));
        length += size;
    }
    EXPECT_NEAR(scales(wide, vertex_contour(across, false)).h, sum / length, 1e-12);
    EXPECT_NEAR(scales(squares, fine).h, scales(squares, coarse).h, 1e-12);
    EXPECT_NEAR(scales(squares, fine).h, std::pow(2.0, -0.25), 1e-12);
    EXPECT_GT(scales(wide, coarse).h, 1.05 * scales(wide, fine).h);
    EXPECT_THROW(scales(squares.mapped([](const Vec3&) { return Vec3(1, 1, 1); }), fine), InvalidInput);
}

TEST_F(ScalesOf, a_contour_do_not_depend_on_how_far_triangles_reach_that_end_near_it) {
    // A groove round a tube, whose straight parts on both sides are cut into rings of other lengths.
    const auto grooved = [](double step) {
        std::vector<std::pair<double, double>> profile;  // radius and height
        const int rings = static_cast<int>(32.0 / step);
        for (int i = rings; i > 0; --i) profile.emplace_back(1.0, -1.0 - i * step);
        for (const double z : {-1.0, -0.5, 0.0, 0.5, 1.0}) profile.emplace_back(0.8 + 0.2 * std::abs(z), z);
        for (int i = 1; i <= rings; ++i) profile.emplace_back(1.0, 1.0 + i * step);
        return profile;
    };
    std::vector<Scales> found;
    for (const double step : {32.0, 4.0, 1.0}) {
        const auto profile = grooved(step);
        const made::Mesh mesh = made::turned(profile, 32);
        const auto middle = std::ranges::find(profile, std::pair(0.8, 0.0)) - profile.begin();
        found.push_back(scales(mesh, made::ring(32, static_cast<int>(middle))));
    }
    for (const Scales& s : found) {
        EXPECT_NEAR(s.h, found[0].h, 0.03 * found[0].h);
        EXPECT_NEAR(s.K, found[0].K, 0.15 * found[0].K);
        EXPECT_DOUBLE_EQ(s.L0, found[0].L0);
    }
}

TEST_F(ScalesOf, a_tube_has_its_curvature_as_k_only_where_it_is_a_feature) {
    Options ridge;
    ridge.feature = Feature::ridge;
    EXPECT_NEAR(scales(tube.inside_out(), loop).K, 0.5, 0.03);
    EXPECT_NEAR(scales(tube, loop, ridge).K, 0.5, 0.03);
    EXPECT_DOUBLE_EQ(scales(tube, loop).K, 0.01 / perimeter);
    EXPECT_DOUBLE_EQ(scales(tube.inside_out(), loop, ridge).K, 0.01 / perimeter);
}

TEST_F(ScalesOf, a_mesh_twice_as_large_are_twice_the_lengths_and_half_the_curvatures) {
    const Scales one = scales(tube.inside_out(), loop), twice = scales(scaled(tube.inside_out(), 2.0), loop);
    EXPECT_NEAR(twice.h, 2.0 * one.h, 1e-12);
    EXPECT_NEAR(twice.L0, 2.0 * one.L0, 1e-12);
    EXPECT_NEAR(twice.K, 0.5 * one.K, 1e-12);
    EXPECT_NEAR(twice.kappa_0, 0.5 * one.kappa_0, 1e-12);
    EXPECT_EQ(twice.n0, one.n0);
}

TEST_F(ScalesOf, a_contour_follow_the_options) {
    Options options;
    options.kappa0_factor = 7.0;
    options.refinement = 2;
    const Scales closed = scales(tube.inside_out(), loop, options);
    EXPECT_DOUBLE_EQ(closed.kappa_0, 7.0 * closed.K);
    EXPECT_EQ(closed.n0, 3 * around);
    EXPECT_EQ(scales(tube, {loop.points, false}, options).n0, 3 * (around - 1));
    EXPECT_EQ(closed.given, loop);
    EXPECT_EQ(closed.clamp, std::numeric_limits<double>::infinity());
}

TEST_F(ScalesOf, a_clamp_is_the_quantile_of_the_features_up_to_four_edges_off) {
    const Surface surface = made::torus(48, 16).surface();
    std::vector<int> inner;
    for (int i = 0; i < 48; ++i) inner.push_back(16 * i + 8);
    const Contour contour = vertex_contour(inner);
    const CurvatureField field(surface, {});
    std::vector<double> features;
    for (const int v : vertices_within(surface, inner, 4)) {
        if (field.at(v).kappa_min < 0.0) features.push_back(-field.at(v).kappa_min);
    }
    std::ranges::sort(features);
    for (const double q : {0.01, 0.5, 0.9, 0.999}) {
        Options options;
        options.feature_clamp = q;
        const auto place = static_cast<std::size_t>(std::ceil(q * static_cast<double>(features.size()))) - 1;
        EXPECT_EQ(contour_scales(surface, field, contour, options).clamp, features[place]);
    }
}

TEST_F(ScalesOf, a_contour_without_length_are_refused) {
    const made::Mesh shrunk =
        made::plate(9, 9).mapped([](const Vec3& p) { return Vec3(p.x() < 3.5 ? 0.0 : p.x(), p.y() < 3.5 ? 0.0 : p.y(), 0); });
    EXPECT_THROW(scales(shrunk, vertex_contour(std::vector<int>{11, 12, 22, 21})), InvalidInput);
}

}  // namespace
}  // namespace mrc
