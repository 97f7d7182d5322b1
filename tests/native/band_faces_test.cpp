// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include <mrc/band.h>
#include <mrc/errors.h>
#include <mrc/optimize.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using mrc_test::loop_near;

const mrc::Surface torus = mrc_test::waisted_torus();

TEST(BandFaces, LieOnBothSidesOfALoopAndTurnWithIt) {
    mrc::Contour loop = loop_near(0);
    const mrc::BandFaces found = mrc::band(torus, loop);
    ASSERT_EQ(found.faces.size(), found.sides.size());
    EXPECT_TRUE(std::ranges::is_sorted(found.faces));
    EXPECT_GT(std::ranges::count(found.sides, 1), 0);
    EXPECT_EQ(std::ranges::count(found.sides, 1) + std::ranges::count(found.sides, -1), std::ssize(found.sides));
    std::ranges::reverse(loop.points);
    const mrc::BandFaces turned = mrc::band(torus, loop);
    EXPECT_EQ(turned.faces, found.faces);
    for (std::size_t i = 0; i < found.sides.size(); ++i) EXPECT_EQ(turned.sides[i], -found.sides[i]);
}

TEST(BandFaces, AreAsManyAsASearchHas) {
    const mrc::Result result = mrc::optimize(torus, loop_near(0));
    EXPECT_EQ(std::ssize(mrc::band(torus, loop_near(0)).faces), result.statistics.faces);
}

TEST(BandFaces, RefuseOptionsOutOfRange) {
    mrc::Options options;
    options.width = 0;
    EXPECT_THROW(mrc::band(torus, loop_near(0), options), mrc::InvalidInput);
}

}  // namespace
