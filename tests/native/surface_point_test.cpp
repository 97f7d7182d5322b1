// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "surface_point.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mrc {
namespace {

class SurfacePoints : public testing::Test {
  protected:
    const Surface surface = made::plate(2, 1).surface();  // vertices 0 1 2 below 3 4 5, each square with a diagonal from its first
};

TEST_F(SurfacePoints, the_ends_of_an_edge_are_written_as_vertices_and_nothing_else_changes) {
    const Contour given{{{0, 1, 0.0}, {1, 2, 1.0}, {1, 4, 0.25}, {3, 3, 0.5}}, false};
    const Contour expected{{vertex_point(0), vertex_point(2), {1, 4, 0.25}, vertex_point(3)}, false};
    EXPECT_EQ(normalized(given), expected);
    EXPECT_EQ(normalized(expected), expected);
}

TEST_F(SurfacePoints, an_edge_holds_its_ends_and_its_points_whichever_way_they_are_written) {
    for (const SurfacePoint& p : {vertex_point(1), SurfacePoint{1, 4, 0.25}, SurfacePoint{4, 1, 0.75}}) {
        for (const SurfacePoint& q : {vertex_point(4), SurfacePoint{1, 4, 0.5}, SurfacePoint{4, 1, 0.5}}) {
            const auto edge = shared_edge(p, q), back = shared_edge(q, p);
            ASSERT_TRUE(edge && back);
            ASSERT_EQ(std::minmax(edge->a, edge->b), std::minmax(1, 4));
            ASSERT_EQ(std::minmax(back->a, back->b), std::minmax(1, 4));
            EXPECT_TRUE(edge->holds(p) && edge->holds(q));
            const Vec3 a = surface.position(edge->a), b = surface.position(edge->b);
            EXPECT_TRUE(((1.0 - edge->parameter(p)) * a + edge->parameter(p) * b).isApprox(surface.position(p)));
            EXPECT_TRUE(((1.0 - edge->parameter(q)) * a + edge->parameter(q) * b).isApprox(surface.position(q)));
        }
    }
}

TEST_F(SurfacePoints, points_of_two_edges_and_one_vertex_twice_share_none) {
    EXPECT_FALSE(shared_edge({0, 1, 0.5}, {1, 4, 0.5}));
    EXPECT_FALSE(shared_edge({0, 1, 0.5}, vertex_point(4)));
    EXPECT_FALSE(shared_edge(vertex_point(4), {0, 1, 0.5}));
    EXPECT_FALSE(shared_edge(vertex_point(1), vertex_point(1)));
}

TEST_F(SurfacePoints, a_segments_triangle_holds_both_its_ends) {
    const std::vector<SurfacePoint> points{vertex_point(0), vertex_point(1), vertex_point(2), vertex_point(3), vertex_point(4),
                                           {0, 1, 0.5},     {1, 2, 0.5},     {1, 4, 0.5},     {4, 0, 0.5},     {3, 4, 0.25}};
    for (const SurfacePoint& p : points) {
        for (const SurfacePoint& q : points) {
            const auto holds_both = [&](int t) {
                const auto& corners = surface.triangle(t);
                return std::ranges::all_of(std::array{p.a, p.b, q.a, q.b},
                                           [&](int v) { return std::ranges::find(corners, v) != corners.end(); });
            };
            bool any = false;
            for (int t = 0; t < surface.triangle_count(); ++t) any |= holds_both(t);
            const int found = triangle_of_segment(surface, p, q);
            ASSERT_EQ(found >= 0, any);
            if (found >= 0) {
                EXPECT_TRUE(holds_both(found));
            }
        }
    }
}

}  // namespace
}  // namespace mrc
