// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace mrc {
namespace {

/// Densities on a tube whose faces all have one area.
class Region : public testing::Test {
  protected:
    static constexpr int around = 12, rows = 14, row = 7;
    const Surface surface = made::tube(around, rows).surface();
    const double area = 2.0 * std::sin(std::numbers::pi / around) * 0.25;
    const std::vector<double> density = random_density(surface.face_count());
    const Contour loop = made::ring(around, row);
    const Patch patch = make_patch(surface, loop, 4);
    const Band band = grow_band(surface, patch, Options());
    const Flow flow = make_flow(patch, band, Options());

    static std::vector<double> random_density(int count) {
        std::mt19937 random(2);
        std::uniform_real_distribution<double> any(-1.0, 1.0);
        std::vector<double> density(count);
        for (double& d : density) d = any(random);
        return density;
    }
    /// What lies between two rings.
    double between(int low, int high) const {
        double sum = 0.0;
        for (int f = low * around; f < high * around; ++f) sum += density[f] * area;
        return sum;
    }
    /// Up by one row, over the faces from column `first` up to `end`.
    static Contour bulging(int first, int end) {
        std::vector<int> vertices;
        for (int i = 0; i < around; ++i) {
            if (i == end) vertices.push_back((row + 1) * around + i);
            if (i <= first || i >= end) vertices.push_back(row * around + i);
            if (i >= first && i < end) vertices.push_back((row + 1) * around + i);
        }
        return vertex_contour(vertices);
    }
};

TEST_F(Region, the_circulation_round_each_face_of_the_band_is_its_density_times_its_area) {
    const EdgeForm form = region_form(surface, patch, band, flow, density, 0.0);
    for (const int polygon : band.polygons) {
        const int face = patch.polygon_face[polygon];
        double circulation = 0.0;
        for (int h = 3 * surface.first_triangle(face); h < 3 * surface.first_triangle(face + 1); ++h) circulation += form.on(h);
        EXPECT_NEAR(circulation, density[face] * area, 1e-12);
    }
}

TEST_F(Region, along_the_given_contour_it_is_what_was_reached_and_along_others_what_they_enclose_besides) {
    for (const double reached : {0.0, 2.5}) {
        const EdgeForm form = region_form(surface, patch, band, flow, density, reached);
        EXPECT_NEAR(form.along(loop), reached, 1e-12);
        EXPECT_NEAR(form.along(made::ring(around, row + 2)), reached - between(row, row + 2), 1e-12);
        EXPECT_NEAR(form.along(made::ring(around, row - 3)), reached + between(row - 3, row), 1e-12);
        double bulge = 0.0;
        for (int f = 3; f < 6; ++f) bulge += density[row * around + f] * area;
        EXPECT_NEAR(form.along(bulging(3, 6)), reached - bulge, 1e-12);
    }
}

TEST_F(Region, the_way_back_is_the_opposite) {
    const EdgeForm form = region_form(surface, patch, band, flow, density, 1.5);
    EXPECT_NEAR(form.along(made::reversed(bulging(2, 7))), -form.along(bulging(2, 7)), 1e-12);
    for (int h = 0; h < surface.halfedge_count(); ++h) {
        if (surface.twin(h) >= 0) {
            EXPECT_EQ(form.on(h), -form.on(surface.twin(h)));
        }
    }
}

TEST_F(Region, a_contour_across_faces_encloses_their_parts) {
    const EdgeForm form = region_form(surface, patch, band, flow, std::vector<double>(surface.face_count(), 1.0), 0.0);
    for (const double t : {0.1, 0.5, 0.8}) {
        Contour across;
        for (int i = 0; i < around; ++i) across.points.push_back({row * around + i, (row + 1) * around + i, t});
        Contour cut;  // through the diagonals too
        for (int i = 0; i < around; ++i) {
            cut.points.push_back(across.points[i]);
            cut.points.push_back({row * around + i, (row + 1) * around + (i + 1) % around, t});
        }
        EXPECT_NEAR(form.along(cut), -t * area * around, 1e-12);
    }
}

TEST_F(Region, the_change_from_one_contour_to_another_is_what_lies_between_them) {
    for (int other = 2; other < rows - 1; ++other) {
        const double expected = other > row ? -between(row, other) : between(other, row);
        EXPECT_NEAR(enclosed_change(surface, density, loop, made::ring(around, other)), expected, 1e-12);
        EXPECT_NEAR(enclosed_change(surface, density, made::ring(around, other), loop), -expected, 1e-12);
        EXPECT_NEAR(enclosed_change(surface, density, made::reversed(loop), made::reversed(made::ring(around, other))), -expected,
                    1e-12);
    }
}

TEST_F(Region, the_change_on_a_closed_surface_is_the_same) {
    const Surface ball = made::ball(16, 11).surface();
    const std::vector<double> ones(ball.face_count(), 1.0);
    const auto parallel = [](int ring) {
        std::vector<int> vertices(16);
        for (int i = 0; i < 16; ++i) vertices[i] = 1 + 16 * ring + i;
        return vertex_contour(vertices);
    };
    double whole = 0.0;
    for (int ring = 0; ring < 10; ++ring) {
        const double step = enclosed_change(ball, ones, parallel(ring), parallel(ring + 1));
        EXPECT_LT(step, 0.0);
        whole += step;
    }
    EXPECT_NEAR(enclosed_change(ball, ones, parallel(0), parallel(10)), whole, 1e-9);
    const double cap = 2.0 * std::numbers::pi * (1.0 - std::cos(std::numbers::pi / 12));
    EXPECT_NEAR(whole, -(4.0 * std::numbers::pi - 2.0 * cap), 0.05 * -whole);
}

}  // namespace
}  // namespace mrc
