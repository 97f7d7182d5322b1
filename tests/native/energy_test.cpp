// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "contour_scales.h"
#include "search_context.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace mrc {
namespace {

class EnergyOf : public testing::Test {
  protected:
    static constexpr int around = 24;
    const Surface torus = made::torus(48, 16).surface();
    const Surface hollow = made::tube(around, 16).inside_out().surface();
    const Contour loop = made::ring(around, 8);
    const Contour across = vertex_contour(std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});  // the torus
    Options options;

    /// Eq. 3.2 as it stands in the thesis, by projections in space.
    static double bending(const VertexCurvature& c, double kappa_0, const Vec3& e1, const Vec3& e2) {
        const auto flat = [&](const Vec3& e) { return Vec3(e - e.dot(c.normal) * c.normal); };
        const Vec3 direction = c.umbilic ? Vec3((flat(e1) + flat(e2)).normalized()) : c.direction_max;
        const auto along = [&](const Vec3& e) { return e.norm() * flat(e).normalized().dot(direction); };
        const double both = std::abs(along(e1) + along(e2));
        return c.kappa_min < 0.0 ? 0.5 * c.kappa_min * both : 0.5 * kappa_0 * (e1.norm() + e2.norm() - both);
    }
};

TEST_F(EnergyOf, an_arc_is_that_of_the_thesis) {
    const SearchContext context(torus, across, options, {}, std::nullopt);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
    for (int v = 0; v < torus.vertex_count(); v += 3) {
        const Vec3 e1 = vector(), e2 = vector();
        const Frame frame = context.energy.frame(vertex_point(v));
        const ArcWeights weights = context.energy.weights(frame);
        const ChordEnd in = context.energy.chord_end(frame, e1), out = context.energy.chord_end(frame, e2);
        EXPECT_NEAR(weights.numerator(in, out), bending(context.field.at(v), context.scales.kappa_0, e1, e2), 1e-12);
        EXPECT_NEAR(weights.denominator(in, out), 0.5 * (e1.norm() + e2.norm()), 1e-12);
    }
}

TEST_F(EnergyOf, a_line_along_a_valley_is_its_curvature_and_of_one_across_it_none) {
    const SearchContext context(hollow, loop, options, {}, std::nullopt);
    std::vector<int> line;
    for (int row = 5; row < 12; ++row) line.push_back(around * row);
    const Measure along = measure(hollow, context.energy, vertex_contour(line, false), 0);
    EXPECT_NEAR(along.ratio, context.field.at(line[3]).kappa_min, 1e-9);
    EXPECT_NEAR(along.ratio, -1.0, 0.03);
    EXPECT_NEAR(along.length, 6 * 0.25, 1e-12);
    EXPECT_NEAR(measure(hollow, context.energy, loop, 0).numerator, 0.0, 1e-9);
}

TEST_F(EnergyOf, a_contour_is_that_of_the_reversed_one) {
    options.anchor = 0.3;
    options.crease = 0.4;
    std::vector<int> jagged{0, 16, 17, 1, 2, 18, 34, 35, 19, 3};
    for (const bool closed : {true, false}) {
        Contour contour = vertex_contour(jagged, closed);
        contour.points[4] = {2, 3, 0.25};
        contour.points[5] = {18, 2, 0.5};
        const SearchContext context(torus, across, options, {{3, 0.8, 1.0, {}}}, std::nullopt);
        for (const int steiner : {0, 3}) {
            const Measure one = measure(torus, context.energy, contour, steiner);
            const Measure other = measure(torus, context.energy, made::reversed(contour), steiner);
            EXPECT_NEAR(one.numerator, other.numerator, 1e-12);
            EXPECT_NEAR(one.length, other.length, 1e-12);
        }
    }
}

TEST_F(EnergyOf, a_crease_grows_with_the_sine_of_its_angle_up_to_three) {
    options.crease = 0.5;
    for (const double slope : {-1.0, -0.1, 0.2, 2.0}) {
        const Surface fold =
            made::plate(8, 8).mapped([&](const Vec3& p) { return Vec3(p.x(), p.y(), slope * std::abs(p.x() - 4)); }).surface();
        const SearchContext context(fold, vertex_contour(std::vector<int>{30, 39, 48}, false), options, {}, std::nullopt);
        const double unit = 0.5 * context.scales.K, angle = -2.0 * std::atan(slope);
        const int crease = fold.find_halfedge(40, 49), flat = fold.find_halfedge(42, 51);
        EXPECT_NEAR(context.energy.crease_cost(crease), unit * std::min(3.0, std::exp(3.0 * std::sin(angle))), 1e-12);
        EXPECT_NEAR(context.energy.crease_cost(fold.twin(crease)), context.energy.crease_cost(crease), 1e-12);
        EXPECT_NEAR(context.energy.crease_cost(flat), unit, 1e-12);
        EXPECT_EQ(context.energy.crease_cost(-1), unit);
    }
}

TEST_F(EnergyOf, a_point_has_the_anchors_square_of_its_distance_and_what_attracts_it) {
    options.anchor = 0.7;
    const SearchContext context(hollow, loop, options, {{8 * around, 0.6, 2.0, 0.5}}, std::nullopt);
    const auto& [field, scales, energy] = context;
    const double radius = scales.L0 / (2.0 * std::numbers::pi);
    for (const int row : {3, 8, 9, 10, 15}) {
        const double d = 0.25 * std::abs(row - 8);
        const double pull = d <= 0.6 ? 2.0 * std::exp(-d * d / (2.0 * 0.5 * 0.5)) : 0.0;
        EXPECT_NEAR(energy.frame(vertex_point(row * around)).potential, scales.K * (0.7 * d * d / (radius * radius) - pull), 1e-9);
    }
}

TEST_F(EnergyOf, an_arc_ends_where_it_turns_by_more_than_it_may) {
    for (const double most : {0.3, 1.5, 3.0}) {
        options.max_turn = most;
        const SearchContext context(hollow, loop, options, {}, std::nullopt);
        const Frame frame = context.energy.frame(vertex_point(8 * around));
        for (double turn = 0.05; turn < 3.14; turn += 0.1) {
            const Vec3 on = std::cos(turn) * frame.direction - std::sin(turn) * frame.across;
            const ChordEnd in = context.energy.chord_end(frame, frame.direction), out = context.energy.chord_end(frame, 2.0 * on);
            EXPECT_EQ(context.energy.weights(frame).turns_too_much(in, out), turn > most);
        }
    }
}

TEST_F(EnergyOf, a_contour_with_steiner_points_runs_the_same_way) {
    for (const int steiner : {0, 1, 4}) {
        for (const bool closed : {true, false}) {
            const Contour given{loop.points, closed}, found = expressed(given, steiner);
            EXPECT_EQ(static_cast<int>(found.points.size()), around + steiner * (around - (closed ? 0 : 1)));
            EXPECT_NEAR(contour_length(hollow, found), contour_length(hollow, given), 1e-12);
            for (std::size_t i = 0; i < found.points.size(); i += steiner + 1)
                EXPECT_EQ(found.points[i], given.points[i / (steiner + 1)]);
            EXPECT_EQ(expressed(found, steiner), found);
        }
    }
}

}  // namespace
}  // namespace mrc
