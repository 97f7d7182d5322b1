// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mrc {
namespace {

TEST(AverageRadius, of_a_ball_is_its_radius_and_grows_with_it) {
    const made::Mesh ball = made::ball(48, 25);
    const Surface twice = ball.mapped([](const Vec3& p) { return Vec3(2.0 * p + Vec3(5, 6, 7)); }).surface();
    EXPECT_NEAR(ball.surface().average_radius(0), 1.0, 0.01);
    EXPECT_NEAR(twice.average_radius(0), 2.0 * ball.surface().average_radius(0), 1e-9);
}

TEST(AverageRadius, of_a_plate_is_the_mean_over_its_squares) {
    const int columns = 7, rows = 4;
    double sum = 0.0;
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) sum += std::hypot(i + 0.5 - 0.5 * columns, j + 0.5 - 0.5 * rows);
    }
    EXPECT_NEAR(made::plate(columns, rows).surface().average_radius(3), sum / (columns * rows), 1e-12);
}

TEST(AverageRadius, weighs_faces_by_their_areas) {
    // Squares on the left, and on the right half as many faces of twice the size.
    const made::Mesh even = made::plate(4, 1);
    made::Mesh uneven = even;
    uneven.faces = {{0, 1, 6, 5}, {1, 2, 7, 6}, {2, 4, 9, 7}};
    const auto radius = [](const std::vector<std::pair<double, double>>& places) {  // of areas and centroids along x
        double center = 0.0, area = 0.0, sum = 0.0;
        for (const auto& [a, x] : places) center += a * x, area += a;
        for (const auto& [a, x] : places) sum += a * std::abs(x - center / area);
        return sum / area;
    };
    EXPECT_NEAR(even.surface().average_radius(0), radius({{1, 0.5}, {1, 1.5}, {1, 2.5}, {1, 3.5}}), 1e-12);
    EXPECT_NEAR(uneven.surface().average_radius(0), radius({{1, 0.5}, {1, 1.5}, {2, 3.0}}), 1e-12);
}

TEST(AverageRadius, is_each_components_own) {
    const made::Mesh small = made::ball(12, 5), large = made::ball(12, 5, 3.0);
    const Surface both = small.beside(large).surface();
    const int first = static_cast<int>(small.points.size());
    for (int v = 0; v < both.vertex_count(); ++v) {
        const Surface& own = v < first ? small.surface() : large.surface();
        if (v % 9 == 0) {
            EXPECT_NEAR(both.average_radius(v), own.average_radius(0), 1e-12);
        }
    }
}

}  // namespace
}  // namespace mrc
