// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_off.h"
#include "made_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace mrc {
namespace {

constexpr int around = 12, rows = 30;

std::vector<int> ring(int row) {
    std::vector<int> vertices;
    for (int i = 0; i < around; ++i) vertices.push_back(row * around + i);
    return vertices;
}

TEST(CutOff, CountsTheTrianglesOnBothSidesUpToTheLimit) {
    const Surface surface = made::tube(around, rows).surface();
    const int all = surface.triangle_count();
    for (const int row : {1, 4, rows - 2}) {
        const CutOff cut = cut_off_by(surface, ring(row), true, all);
        EXPECT_TRUE(cut.separates);
        EXPECT_EQ(std::min(cut.left, cut.right), 2 * around * std::min(row, all / (2 * around) - row));
        EXPECT_EQ(cut.left + cut.right, all);
        std::vector<int> back = ring(row);
        std::ranges::reverse(back);
        const CutOff turned = cut_off_by(surface, back, true, all);
        EXPECT_EQ(turned.left, cut.right);
        EXPECT_EQ(turned.right, cut.left);
        const CutOff limited = cut_off_by(surface, ring(row), true, 7);
        EXPECT_EQ(limited.left, 7);
        EXPECT_EQ(limited.right, 7);
    }
}

TEST(CutOff, AroundAHandleAndAlongAChainNothingIsSeparated) {
    const Surface torus = made::torus(20, around).surface();
    EXPECT_FALSE(cut_off_by(torus, ring(3), true, torus.triangle_count()).separates);
    const Surface tube = made::tube(around, rows).surface();
    const std::vector<int> chain{4 * around, 4 * around + 1, 4 * around + 2};
    EXPECT_FALSE(cut_off_by(tube, chain, false, tube.triangle_count()).separates);
}

TEST(SlippedOff, IsWhatFollowsNothingAndCutsOffNextToNothing) {
    const Surface surface = made::ball(30, 240).surface();
    const auto loop = [](int row) {
        std::vector<int> vertices;
        for (int i = 0; i < 30; ++i) vertices.push_back(1 + 30 * row + i);
        return vertex_contour(vertices);
    };
    EXPECT_EQ(slipped_off(surface, loop(20), loop(0), 0.0), 30);  // the fan around the pole
    EXPECT_EQ(slipped_off(surface, loop(20), loop(0), 0.3), 0);   // it follows something
    EXPECT_EQ(slipped_off(surface, loop(0), loop(0), 0.0), 0);    // no less than before
    EXPECT_EQ(slipped_off(surface, loop(60), loop(20), 0.0), 0);  // a part
}

}  // namespace
}  // namespace mrc
