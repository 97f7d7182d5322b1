// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include <mrc/measure.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace mrc {
namespace {

class MeasureOf : public testing::Test {
  protected:
    static constexpr int around = 24;
    const made::Mesh hollow = made::tube(around, 20).inside_out();
    const Surface surface = hollow.surface();
    Options options;

    /// Up and down by one row in turn, so that it follows the valley along half of its path.
    static Contour zigzag() {
        std::vector<int> vertices;
        for (int i = 0; i < around; ++i) {
            vertices.push_back((9 + i % 2) * around + i);
            vertices.push_back((9 + (i + 1) % 2) * around + i);
        }
        return vertex_contour(vertices);
    }
};

TEST_F(MeasureOf, a_line_along_a_valley_is_minus_its_curvature_for_each_unit_of_length) {
    std::vector<int> line;
    for (int row = 6; row < 15; ++row) line.push_back(around * row);
    const Measure found = measure(surface, vertex_contour(line, false));
    EXPECT_NEAR(found.length, 8 * 0.25, 1e-12);
    EXPECT_NEAR(found.ratio, -1.0, 0.03);
    EXPECT_NEAR(found.numerator, found.ratio * found.length, 1e-12);
    EXPECT_NEAR(found.salience, 1.0, 1e-3);
    EXPECT_EQ(found.objective, found.ratio);
}

TEST_F(MeasureOf, a_contour_does_not_depend_on_its_direction_its_start_and_the_numbering) {
    const Measure one = measure(surface, zigzag());
    Contour shifted = zigzag();
    std::ranges::rotate(shifted.points, shifted.points.begin() + 7);
    const std::vector<int> number = made::shuffled(surface.vertex_count());
    const Surface renumbered = hollow.renumbered(number).surface();
    for (const Measure& other : {measure(surface, made::reversed(zigzag())), measure(surface, shifted),
                                 measure(renumbered, made::renumbered(zigzag(), number))}) {
        EXPECT_NEAR(other.ratio, one.ratio, 1e-12);
        EXPECT_NEAR(other.length, one.length, 1e-12);
        EXPECT_NEAR(other.salience, one.salience, 1e-12);
    }
    EXPECT_LT(one.ratio, -0.1);
}

TEST_F(MeasureOf, a_mesh_twice_as_large_is_twice_the_length_and_half_the_ratio) {
    const Measure one = measure(surface, zigzag());
    const Measure twice = measure(hollow.mapped([](const Vec3& p) { return Vec3(2.0 * p); }).surface(), zigzag());
    EXPECT_NEAR(twice.length, 2.0 * one.length, 1e-9);
    EXPECT_NEAR(twice.ratio, 0.5 * one.ratio, 1e-9);
    EXPECT_NEAR(twice.numerator, one.numerator, 1e-9);
    EXPECT_NEAR(twice.salience, one.salience, 1e-9);
}

TEST_F(MeasureOf, arcs_that_are_counted_is_their_number) {
    options.denominator = Denominator::arcs;
    EXPECT_EQ(measure(surface, zigzag(), options).length, 2.0 * around);
    const Contour open{zigzag().points, false};
    EXPECT_EQ(measure(surface, open, options).length, 2.0 * around - 1.0);
    options.refinement = 2;
    EXPECT_EQ(measure(surface, zigzag(), options).length, 6.0 * around);
}

TEST_F(MeasureOf, a_length_bias_adds_the_length_in_units_of_the_first) {
    options.length_bias = 0.3;
    const Measure one = measure(surface, zigzag(), options);
    const double k = -one.ratio / one.salience;  // nothing but eq. 3.2 weighs here
    EXPECT_NEAR(one.objective, one.ratio / k + 0.3, 1e-12);
    options.length_floor = 1.5;
    EXPECT_NEAR(measure(surface, zigzag(), options).objective, one.ratio / k + 0.45, 1e-12);
}

TEST_F(MeasureOf, a_region_adds_the_density_that_came_in_since_the_scales_were_made) {
    options.region_weight = 2.0;
    const std::vector<double> density(surface.face_count(), 0.5);
    Constraints constraints;
    constraints.region_density = std::make_shared<const std::vector<double>>(density);
    Scales scales{.h = 0.25, .K = 1.0, .kappa_0 = 3.0, .L0 = 6.0, .given = made::ring(around, 8)};
    const Contour moved = made::ring(around, 11);
    const double row = around * 2.0 * std::sin(std::numbers::pi / around) * 0.25;
    const double without = measure(surface, moved, options, {}, scales).numerator;
    // On a tube turned inside out the left of a ring lies below.
    EXPECT_NEAR(measure(surface, moved, options, constraints, scales).numerator - without, 2.0 / 6.0 * 0.5 * 3.0 * row, 1e-12);
    options.region_side = RegionSide::right;
    EXPECT_NEAR(measure(surface, moved, options, constraints, scales).numerator - without, -2.0 / 6.0 * 0.5 * 3.0 * row, 1e-12);
}

TEST_F(MeasureOf, an_attractor_that_is_felt_lowers_the_ratio_and_a_barrier_does_nothing) {
    Constraints attracting, repelling, barred;
    attracting.attractors = {{9 * around, 1.0, 1.0, {}}};
    repelling.attractors = {{9 * around, 1.0, -1.0, {}}};
    barred.barriers = {{9 * around, 10 * around}};
    const double plain = measure(surface, zigzag()).ratio;
    EXPECT_LT(measure(surface, zigzag(), options, attracting).ratio, plain - 1e-3);
    EXPECT_GT(measure(surface, zigzag(), options, repelling).ratio, plain + 1e-3);
    EXPECT_EQ(measure(surface, zigzag(), options, barred).ratio, plain);
}

}  // namespace
}  // namespace mrc
