// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/close_contour.h>
#include "distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace mrc {
namespace {

/// A tube of quads around the z axis: vertex row * columns + column.
struct Tube {
    int rows = 30;
    int columns = 24;
    double noise = 0.0;
    std::vector<int32_t> hidden = {};

    Surface surface() const {
        std::mt19937 random(5);
        std::normal_distribution<double> shift(0.0, 1.0);
        std::vector<double> positions;
        std::vector<int32_t> offsets{0}, corners;
        for (int v = 0; v < rows * columns; ++v) {
            const int row = v / columns;
            const double angle = 2.0 * std::numbers::pi * (v % columns) / columns;
            for (const double x : {std::cos(angle), std::sin(angle), 0.25 * row}) {
                positions.push_back(x + noise * shift(random));
            }
        }
        for (int f = 0; f < (rows - 1) * columns; ++f) {
            const int row = f / columns, next = (f + 1) % columns;
            corners.insert(corners.end(), {f, row * columns + next, (row + 1) * columns + next, f + columns});
            offsets.push_back(static_cast<int32_t>(corners.size()));
        }
        return Surface({positions, offsets, corners, {}, hidden});
    }

    Contour chain(int row, int first, int count) const {
        std::vector<int> vertices;
        for (int i = 0; i < count; ++i) vertices.push_back(row * columns + (first + i) % columns);
        return vertex_contour(vertices, false);
    }
};

std::set<int> vertices_of(const Contour& contour) {
    std::set<int> vertices;
    for (const SurfacePoint& p : contour.points) vertices.insert(p.a);
    return vertices;
}

Contour reversed(Contour contour) {
    std::ranges::reverse(contour.points);
    return contour;
}

std::string message_of(const Surface& surface, const Contour& chain) {
    try {
        close_contour(surface, chain);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return {};
}

TEST(CloseContour, ClosesEveryPartOfAStraightRingToTheRing) {
    const Tube tube;
    const Surface surface = tube.surface();
    const std::set<int> ring = vertices_of(tube.chain(14, 0, tube.columns));
    for (int count = 2; count <= tube.columns; ++count) {
        for (const int first : {0, 5, 23}) {
            const Contour chain = tube.chain(14, first, count);
            const Contour loop = close_contour(surface, chain);
            EXPECT_TRUE(loop.closed);
            EXPECT_TRUE(std::equal(chain.points.begin(), chain.points.end(), loop.points.begin()));
            EXPECT_EQ(vertices_of(loop), ring) << count;
            EXPECT_EQ(loop.points.size(), ring.size());
        }
    }
}

TEST(CloseContour, AReversedChainGivesTheSameLoopReversed) {
    for (const double noise : {0.0, 0.01}) {
        const Tube tube{.noise = noise};
        const Surface surface = tube.surface();
        for (int first = 0; first < tube.columns; ++first) {
            const Contour chain = tube.chain(14, first, 7);
            const Contour back = close_contour(surface, reversed(chain));
            Contour there = reversed(close_contour(surface, chain));
            std::ranges::rotate(there.points, there.points.end() - static_cast<std::ptrdiff_t>(chain.points.size()));
            EXPECT_EQ(there, back);
        }
    }
}

TEST(CloseContour, GoesAroundHiddenFacesWhereItCan) {
    Tube tube;
    for (int row = 13; row < 16; ++row) tube.hidden.push_back(row * tube.columns + 18);
    const std::set<int> loop = vertices_of(close_contour(tube.surface(), tube.chain(14, 2, 8)));
    for (const int inside : {14 * tube.columns + 18, 15 * tube.columns + 18}) {
        EXPECT_FALSE(loop.contains(inside) && loop.contains(inside + 1));
    }
}

TEST(CloseContour, SaysWhyItCannot) {
    Tube tube;
    const Surface whole = tube.surface();
    EXPECT_NE(message_of(whole, tube.chain(14, 3, 1)).find("1 vertices"), std::string::npos);
    EXPECT_NE(message_of(whole, vertex_contour(std::vector{30, 31, 32}, true)).find("closed already"), std::string::npos);
    EXPECT_NE(message_of(whole, {{vertex_point(340), {340, 341, 0.5}}, false}).find("(340, 341)"), std::string::npos);
    for (int row = 0; row + 1 < tube.rows; ++row) tube.hidden.push_back(row * tube.columns + 18);
    const std::string message = message_of(tube.surface(), tube.chain(14, 2, 8));
    EXPECT_NE(message.find("vertex " + std::to_string(14 * tube.columns + 2)), std::string::npos);
    EXPECT_NE(message.find("vertex " + std::to_string(14 * tube.columns + 9)), std::string::npos);
}

TEST(CloseContour, ProgressNeverFallsAndChangesNothing) {
    const Tube tube{.rows = 120, .columns = 200, .noise = 0.001};
    const Surface surface = tube.surface();
    const Contour chain = tube.chain(60, 3, 60);
    std::vector<double> shares;
    const Contour loop = close_contour(surface, chain, [&](double share) {
        shares.push_back(share);
        return true;
    });
    EXPECT_EQ(loop, close_contour(surface, chain));
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(shares.front(), 0.0);
    EXPECT_EQ(shares.back(), 1.0);
    EXPECT_GT(shares.size(), 2U);
}

TEST(CloseContour, CancelledItHasNoPoints) {
    const Tube tube;
    int calls = 0;
    const Contour loop = close_contour(tube.surface(), tube.chain(14, 2, 8), [&](double) { return ++calls < 1; });
    EXPECT_TRUE(loop.points.empty());
    EXPECT_EQ(calls, 1);
    const auto fail = [](double) -> bool { throw std::runtime_error("enough"); };
    EXPECT_THROW(close_contour(tube.surface(), tube.chain(14, 2, 8), fail), std::runtime_error);
}

TEST(DistanceField, TheNearestPointHasTheDistance) {
    const Tube tube{.rows = 12, .columns = 10, .noise = 0.05};
    const Surface surface = tube.surface();
    const Contour chain = tube.chain(5, 2, 4);
    const DistanceField field(surface, chain);
    std::vector<DistanceField> alone;
    for (const SurfacePoint& p : chain.points) alone.emplace_back(surface, Contour{{p}, false});
    for (int v = 0; v < surface.vertex_count(); ++v) {
        double least = std::numeric_limits<double>::infinity();
        for (const DistanceField& one : alone) least = std::min(least, one.at(v));
        EXPECT_NEAR(field.at(v), least, 1e-12);
        EXPECT_NEAR(alone.at(field.nearest(v)).at(v), least, 1e-12);
    }
}

}  // namespace
}  // namespace mrc
