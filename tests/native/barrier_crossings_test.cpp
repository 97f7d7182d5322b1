// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "barrier_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mrc {
namespace {

/// Contours across a plate whose vertex j * 10 + i lies at (i, j).
class Barriers : public testing::Test {
  protected:
    using Edges = std::vector<std::array<int, 2>>;
    const Surface surface = made::plate(9, 6).surface();
    const Contour straight = line({31, 32, 33, 34, 35, 36});

    static Contour line(const std::vector<int>& vertices) { return vertex_contour(vertices, false); }

    bool crosses_one_way(const Contour& contour, const Edges& barriers) const {
        Constraints constraints;
        constraints.barriers = barriers;
        try {
            check_barriers(surface, contour, constraints);
        } catch (const InvalidInput&) {
            return true;
        }
        return false;
    }
    /// Which must not depend on how contour and barriers are written.
    bool crosses(const Contour& contour, const Edges& barriers) const {
        Edges turned = barriers;
        for (auto& [a, b] : turned) std::swap(a, b);
        const bool found = crosses_one_way(contour, barriers);
        EXPECT_EQ(crosses_one_way(contour, turned), found);
        EXPECT_EQ(crosses_one_way(made::reversed(contour), barriers), found);
        return found;
    }
};

TEST_F(Barriers, are_crossed_where_they_leave_a_vertex_to_both_sides) {
    EXPECT_TRUE(crosses(straight, {{33, 43}, {33, 23}}));
    EXPECT_FALSE(crosses(straight, {{33, 43}}));
    EXPECT_FALSE(crosses(straight, {{33, 23}}));
    EXPECT_FALSE(crosses(straight, {{33, 43}, {34, 24}}));
    EXPECT_FALSE(crosses(straight, {{53, 43}, {13, 23}}));
    EXPECT_FALSE(crosses(straight, {}));
}

TEST_F(Barriers, are_crossed_where_the_contour_first_runs_along_them) {
    EXPECT_TRUE(crosses(straight, {{33, 43}, {33, 34}, {34, 24}}));
    EXPECT_TRUE(crosses(straight, {{33, 23}, {33, 34}, {34, 35}, {35, 45}}));
    EXPECT_FALSE(crosses(straight, {{33, 43}, {33, 34}, {34, 44}}));
    EXPECT_FALSE(crosses(straight, {{32, 33}, {33, 34}, {34, 35}}));
    EXPECT_FALSE(crosses(straight, {{32, 42}, {32, 33}, {34, 35}, {35, 25}}));
}

TEST_F(Barriers, are_not_crossed_at_the_ends_of_an_open_curve) {
    EXPECT_FALSE(crosses(straight, {{31, 41}, {31, 21}, {36, 46}, {36, 26}}));
}

TEST_F(Barriers, are_crossed_at_a_corner_by_what_lies_inside_and_outside) {
    const Contour corner = line({31, 32, 33, 43, 53});
    EXPECT_TRUE(crosses(corner, {{33, 34}, {33, 32}, {32, 42}}));
    EXPECT_FALSE(crosses(corner, {{33, 34}, {33, 23}}));
}

TEST_F(Barriers, round_a_closed_contour_count_wherever_it_starts) {
    std::vector<int> loop{22, 23, 24, 34, 44, 43, 42, 32};
    const Edges barriers{{22, 12}, {22, 32}, {32, 33}};  // along its last segment, out below and in on the left
    for (std::size_t start = 0; start < loop.size(); ++start) {
        EXPECT_TRUE(crosses(vertex_contour(loop), barriers));
        EXPECT_FALSE(crosses(vertex_contour(loop), {{22, 12}, {22, 32}, {32, 31}}));
        std::ranges::rotate(loop, loop.begin() + 1);
    }
}

TEST_F(Barriers, are_crossed_inside_an_edge_but_not_where_the_contour_turns_back_along_it) {
    const Contour across{{{32, 42, 0.5}, {32, 43, 0.5}, {33, 43, 0.5}, {33, 44, 0.5}, {34, 44, 0.5}}, false};
    EXPECT_TRUE(crosses(across, {{33, 43}}));
    EXPECT_FALSE(crosses(across, {{32, 42}, {34, 44}, {32, 33}, {43, 44}}));
    const Contour up_and_on{{{32, 42, 0.5}, {32, 43, 0.5}, {33, 43, 0.5}, vertex_point(43), vertex_point(44)}, false};
    const Contour up_and_back{{{32, 42, 0.5}, {32, 43, 0.5}, {33, 43, 0.5}, vertex_point(43), vertex_point(42)}, false};
    EXPECT_TRUE(crosses(up_and_on, {{33, 43}, {43, 53}}));
    EXPECT_FALSE(crosses(up_and_on, {{33, 43}}));
    EXPECT_FALSE(crosses(up_and_back, {{33, 43}, {43, 53}}));
}

}  // namespace
}  // namespace mrc
