// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "snapped_contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace mrc {
namespace {

/// Refined contours around a tube, through the edges between two rows.
class Snapped : public testing::Test {
  protected:
    static constexpr int around = 16, row = 3;
    const Surface surface = made::tube(around, 8).surface();

    /// Through the upright edges at these fractions of them, and through the diagonals between.
    static Contour wave(const std::vector<double>& shares) {
        Contour contour;
        for (int i = 0; i < around; ++i) {
            const int below = row * around + i, above = below + around, next = row * around + (i + 1) % around + around;
            contour.points.push_back({below, above, shares[i]});
            contour.points.push_back({below, next, 0.5 * (shares[i] + shares[(i + 1) % around])});
        }
        return contour;
    }
    static std::vector<double> random_shares(std::mt19937& random) {
        std::uniform_real_distribution<double> any(0.05, 0.95);
        std::vector<double> shares(around);
        for (double& share : shares) share = any(random);
        return shares;
    }
    /// How often a closed chain goes around the axis.
    double turns(const std::vector<int>& chain) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const Vec3 &p = surface.position(chain[i]), &q = surface.position(chain[(i + 1) % chain.size()]);
            sum += std::atan2(p.x() * q.y() - p.y() * q.x(), p.x() * q.x() + p.y() * q.y());
        }
        return sum / (2.0 * std::numbers::pi);
    }
    static std::set<int> as_set(const std::vector<int>& vertices) { return {vertices.begin(), vertices.end()}; }
    static std::vector<int> ring_vertices(int r) {
        std::vector<int> vertices;
        for (const SurfacePoint& p : made::ring(around, r).points) vertices.push_back(p.a);
        return vertices;
    }
};

TEST_F(Snapped, what_runs_along_edges_stays_where_it_is) {
    EXPECT_EQ(snapped_contour(surface, made::ring(around, row)), ring_vertices(row));
    const std::vector<int> open{0, 1, 17, 18, 34};
    EXPECT_EQ(snapped_contour(surface, vertex_contour(open, false)), open);
}

TEST_F(Snapped, goes_to_the_nearer_end_of_each_edge) {
    const std::vector<int> low = snapped_contour(surface, wave(std::vector<double>(around, 0.3)));
    const std::vector<int> high = snapped_contour(surface, wave(std::vector<double>(around, 0.7)));
    EXPECT_EQ(as_set(low), as_set(ring_vertices(row)));
    EXPECT_EQ(as_set(high), as_set(ring_vertices(row + 1)));
}

TEST_F(Snapped, is_a_simple_loop_of_real_edges_that_goes_round_as_often) {
    std::mt19937 random(4);
    for (int i = 0; i < 200; ++i) {
        const Contour contour = wave(random_shares(random));
        const std::vector<int> chain = snapped_contour(surface, contour);
        ASSERT_GE(chain.size(), 3U);
        EXPECT_EQ(std::set<int>(chain.begin(), chain.end()).size(), chain.size());
        for (std::size_t k = 0; k < chain.size(); ++k) EXPECT_TRUE(surface.real_edge(chain[k], chain[(k + 1) % chain.size()]));
        EXPECT_NEAR(turns(chain), 1.0, 1e-9);
        std::set<int> ends;
        for (const SurfacePoint& p : contour.points) ends.insert({p.a, p.b});
        for (const int v : chain) EXPECT_TRUE(ends.contains(v));
        EXPECT_NEAR(turns(snapped_contour(surface, made::reversed(contour))), -1.0, 1e-9);
    }
}

TEST_F(Snapped, an_open_curve_begins_and_ends_beside_its_ends) {
    std::mt19937 random(8);
    for (int i = 0; i < 100; ++i) {
        const std::vector<double> shares = random_shares(random);
        Contour contour{wave(shares).points, false};
        contour.points.resize(11);
        const std::vector<int> chain = snapped_contour(surface, contour);
        ASSERT_GE(chain.size(), 2U);
        EXPECT_EQ(chain.front() % around, 0);
        EXPECT_EQ(chain.back() % around, 5);
        EXPECT_EQ(std::set<int>(chain.begin(), chain.end()).size(), chain.size());
        for (std::size_t k = 1; k < chain.size(); ++k) EXPECT_TRUE(surface.real_edge(chain[k - 1], chain[k]));
    }
}

TEST_F(Snapped, a_loop_close_round_a_vertex_goes_round_its_neighbors) {
    const int v = row * around + 4;
    const std::vector<int> neighbors{v + 1, v + around + 1, v + around, v - 1, v - around - 1, v - around};
    Contour small;
    for (const int neighbor : neighbors) small.points.push_back({v, neighbor, 0.1});
    const std::vector<int> chain = snapped_contour(surface, small);
    EXPECT_FALSE(as_set(chain).contains(v));
    EXPECT_EQ(as_set(chain),
              as_set({v + 1, v + around + 1, v + around, v + around - 1, v - 1, v - around - 1, v - around, v - around + 1}));
}

}  // namespace
}  // namespace mrc
