// SPDX-License-Identifier: GPL-3.0-or-later
#include "required_elements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mrc {
namespace {

using Held = RequiredElements;

/// A chord that the flow runs along, from a level to another; wrapping where that is not above it.
Held::Span rising_chord(double tail, double head, int segment = 0) { return {tail, head, head <= tail, 0.0, 0.0, segment}; }
Held::Span level_chord(double level, double from, double to, int segment = 0) { return {level, level, false, from, to, segment}; }

TEST(Required, a_chord_may_touch_the_level_of_a_required_vertex_but_not_step_over_it) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const double level = any(random), tail = any(random), head = any(random);
        Held held;
        held.require({level, 0.0, 1});
        const double length = head - tail + (head <= tail), until = level - tail + (level < tail);  // along the flow
        EXPECT_EQ(held.allows(rising_chord(tail, head)), until >= length);
        EXPECT_TRUE(held.allows(rising_chord(level, head)));
        EXPECT_TRUE(held.allows(rising_chord(tail, level)));
    }
}

TEST(Required, a_level_chord_may_not_pass_a_required_vertex_on_its_level) {
    Held held;
    held.require({0.5, 2.0, 1});
    EXPECT_FALSE(held.allows(level_chord(0.5, 1.0, 3.0)));
    EXPECT_FALSE(held.allows(level_chord(0.5, 3.0, 1.0)));
    EXPECT_TRUE(held.allows(level_chord(0.5, 1.0, 2.0)));
    EXPECT_TRUE(held.allows(level_chord(0.5, 3.0, 4.0)));
    EXPECT_TRUE(held.allows(level_chord(0.25, 1.0, 3.0)));
}

TEST(Required, a_required_edge_leaves_no_other_chord_beside_it) {
    std::mt19937 random(2);
    const auto level = [&] { return static_cast<double>(random() % 12) / 12.0; };
    for (int i = 0; i < 3000; ++i) {
        const Held::Span edge = rising_chord(level(), level(), 7), chord = rising_chord(level(), level(), 3);
        if (edge.tail_level == edge.head_level || chord.tail_level == chord.head_level) continue;
        Held held;
        held.require(edge, {7});
        bool overlap = false;  // of the open intervals, by a sample in each twelfth
        for (int k = 0; k < 12; ++k) {
            const double at = (k + 0.5) / 12.0;
            const auto holds = [&](const Held::Span& s) {
                return s.wraps ? at > s.tail_level || at < s.head_level : at > s.tail_level && at < s.head_level;
            };
            overlap |= holds(edge) && holds(chord);
        }
        EXPECT_EQ(held.allows(chord), !overlap);
        EXPECT_TRUE(held.allows(edge));
    }
}

TEST(Required, a_required_level_edge_leaves_no_chord_over_its_level_nor_another_beside_it) {
    Held held;
    held.require({0.5, 1.0, 1});
    held.require({0.5, 2.0, 2});
    held.require(level_chord(0.5, 1.0, 2.0, 7), {7});
    EXPECT_TRUE(held.allows(level_chord(0.5, 1.0, 2.0, 7)));
    EXPECT_FALSE(held.allows(level_chord(0.5, 1.0, 2.0, 3)));
    EXPECT_FALSE(held.allows(level_chord(0.5, 1.8, 1.2)));
    EXPECT_TRUE(held.allows(level_chord(0.5, 2.0, 4.0)));
    EXPECT_FALSE(held.allows(rising_chord(0.4, 0.6)));
    EXPECT_FALSE(held.allows(rising_chord(0.6, 0.55)));
    EXPECT_TRUE(held.allows(rising_chord(0.5, 0.6)));
}

/// What passes a required vertex's level elsewhere must come from it or go on to it.
TEST(Required, an_arc_on_the_level_of_a_required_vertex_is_on_the_way_to_it_or_from_it) {
    Held held;
    held.require({0.5, 2.0, 1});
    for (int in = -1; in <= 1; ++in) {
        for (int out = -1; out <= 1; ++out) {
            EXPECT_TRUE(held.allows_arc({0.5, 2.0, 1}, in, out));
            EXPECT_TRUE(held.allows_arc({0.4, 1.0, 2}, in, out));
            if (in * out < 0) continue;  // no contour rises and falls on one level
            for (const double rank : {1.0, 3.0}) {
                const int towards = rank < 2.0 ? 1 : -1;
                const bool leads_on = out == towards, comes_from = in == -towards;
                const bool expected = (in != 0 || leads_on) && (out != 0 || comes_from);
                EXPECT_EQ(held.allows_arc({0.5, rank, 2}, in, out), expected) << rank << in << out;
            }
        }
    }
    EXPECT_FALSE(held.allows_arc({0.5, 2.0, 2}, 1, 1));  // another point of one rank
}

TEST(Required, a_contour_has_vertices_that_it_passes_and_edges_that_it_runs_along_either_way) {
    const auto has = [](const Contour& contour, std::vector<int> vertices, std::vector<std::array<int, 2>> edges) {
        Constraints constraints;
        constraints.required_vertices = std::move(vertices);
        constraints.required_edges = std::move(edges);
        return has_required_elements(contour, constraints);
    };
    const Contour loop{{vertex_point(0), {0, 1, 0.5}, vertex_point(1), vertex_point(2), {2, 5, 0.5}, {5, 7, 0.5}}, true};
    const Contour open{loop.points, false};
    EXPECT_TRUE(has(loop, {0, 1, 2}, {{0, 1}, {1, 2}, {2, 1}, {1, 0}}));
    EXPECT_TRUE(has(loop, {}, {}));
    EXPECT_FALSE(has(loop, {0, 5}, {}));
    EXPECT_FALSE(has(loop, {}, {{2, 5}}));
    EXPECT_FALSE(has(loop, {}, {{0, 2}}));
    const Contour ring = vertex_contour(std::vector<int>{0, 1, 2, 3});
    EXPECT_TRUE(has(ring, {}, {{3, 0}}));
    EXPECT_FALSE(has({ring.points, false}, {}, {{3, 0}}));
    EXPECT_TRUE(has(open, {2}, {{0, 1}}));
}

}  // namespace
}  // namespace mrc
