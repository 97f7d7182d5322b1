// SPDX-License-Identifier: GPL-3.0-or-later
#include "segments.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace mrc {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

Pairs pairs_of(const std::vector<int>& points, bool closed) {
    Pairs found;
    for (const auto& [a, b] : segments(points, closed)) found.emplace_back(a, b);
    return found;
}

TEST(Segments, a_closed_curve_also_joins_its_last_point_to_its_first) {
    EXPECT_EQ(pairs_of({4, 7, 5}, true), (Pairs{{4, 7}, {7, 5}, {5, 4}}));
    EXPECT_EQ(pairs_of({4, 7, 5}, false), (Pairs{{4, 7}, {7, 5}}));
}

TEST(Segments, fewer_than_two_points_make_no_open_segment) {
    EXPECT_EQ(pairs_of({}, true), Pairs{});
    EXPECT_EQ(pairs_of({}, false), Pairs{});
    EXPECT_EQ(pairs_of({3}, false), Pairs{});
}

TEST(Segments, neighbors_wrap_around_closed_contours_and_end_at_open_ones) {
    const std::vector<int> vertices{4, 7, 5};
    const Contour closed = vertex_contour(vertices), open = vertex_contour(vertices, false);
    EXPECT_EQ(*neighbor(closed, 0, -1), vertex_point(5));
    EXPECT_EQ(*neighbor(closed, 2, 1), vertex_point(4));
    EXPECT_EQ(neighbor(open, 0, -1), nullptr);
    EXPECT_EQ(neighbor(open, 2, 1), nullptr);
    EXPECT_EQ(*neighbor(open, 1, 1), vertex_point(5));
}

}  // namespace
}  // namespace mrc
