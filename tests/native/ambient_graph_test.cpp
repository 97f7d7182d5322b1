// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include "ambient_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace mrc {
namespace {

/// The points and segments of a band of quads, with k Steiner points an edge.
class Ambient : public testing::TestWithParam<int> {
  protected:
    const int k = GetParam();
    const Surface surface = mrc_test::waisted_torus();
    const Options options;
    const Patch patch = make_patch(surface, mrc_test::loop_near(0), options.width);
    const Band band = grow_band(surface, patch, options);
    const Flow flow = make_flow(patch, band, options);
    const AmbientGraph ambient = make_ambient_graph(patch, band, flow, k);

    int vertices() const {
        return static_cast<int>(std::ranges::count_if(band.side, [](Side side) { return side != Side::outside; }));
    }
    /// Diagonals are seen by refined contours alone.
    int edges() const {
        int count = 0;
        for (std::size_t e = 0; e < band.edge.size(); ++e) count += band.edge[e] && (k > 0 || !patch.diagonal[e]);
        return count;
    }
    int faces() const { return static_cast<int>(std::ranges::count(band.face, 1)); }
    double value_at(const SurfacePoint& p) const {
        const auto h = patch.mesh.find_halfedge(PatchMesh::VertexHandle(ambient.local.at(p.a)),
                                                PatchMesh::VertexHandle(ambient.local.at(p.b)));
        const double start = flow.value[ambient.local.at(p.a)];
        return p.is_vertex() ? start : start + p.t * flow.increment(patch.mesh, h.idx());
    }
};

TEST_P(Ambient, has_the_bands_vertices_and_k_points_an_edge) {
    EXPECT_EQ(ambient.point_count(), vertices() + k * edges());
    for (const SurfacePoint& p : ambient.places) {
        if (!p.is_vertex()) {
            EXPECT_NEAR(p.t * (k + 1), std::round(p.t * (k + 1)), 1e-12);
        }
    }
}

TEST_P(Ambient, joins_neighbors_along_edges_and_all_points_of_two_sides_of_a_triangle) {
    const int across = faces() * (3 * k + 3 * k * k);  // corners with the side opposite, and pairs of sides
    EXPECT_EQ(static_cast<int>(ambient.segments.size()), edges() * (k + 1) + across);
    std::set<std::pair<int, int>> pairs;
    for (const Segment& s : ambient.segments) {
        EXPECT_TRUE(pairs.insert(std::minmax(s.a, s.b)).second);
        EXPECT_NE(s.halfedge >= 0, s.triangle >= 0);
        EXPECT_TRUE(s.walkable);
    }
}

TEST_P(Ambient, finds_each_point_by_its_place_whichever_way_that_is_written) {
    for (int p = 0; p < ambient.point_count(); ++p) {
        const SurfacePoint& place = ambient.places[p];
        EXPECT_EQ(ambient.point_at(patch, place), p);
        if (!place.is_vertex()) {
            EXPECT_EQ(ambient.point_at(patch, {place.b, place.a, 1.0 - place.t}), p);
        }
    }
    EXPECT_EQ(ambient.point_at(patch, {ambient.places[0].a, patch.vertex[1], 0.123}), -1);
    const auto outside = std::ranges::find(band.side, Side::outside) - band.side.begin();
    if (outside < static_cast<std::ptrdiff_t>(band.side.size())) {
        EXPECT_EQ(ambient.point_at(patch, vertex_point(patch.vertex[outside])), -1);
    }
}

TEST_P(Ambient, has_ranks_that_grow_from_right_to_left_and_are_linear_on_edges) {
    const auto rank = [&](int v) { return static_cast<double>(band.side[v]) * patch.distance[v]; };
    for (int p = 0; p < ambient.point_count(); ++p) {
        const SurfacePoint& place = ambient.places[p];
        const double a = rank(ambient.local.at(place.a)), b = rank(ambient.local.at(place.b));
        EXPECT_NEAR(ambient.ranks[p], (1.0 - place.t) * a + place.t * b, 1e-12);
    }
}

TEST_P(Ambient, takes_the_flow_as_linear_along_edges_and_closed_round_its_segments) {
    for (const Segment& s : ambient.segments) {
        const double rise = ambient.values[s.b] - ambient.values[s.a] + s.jump;
        EXPECT_LT(std::abs(rise), 0.5);
        const double turned = value_at(ambient.places[s.b]) - value_at(ambient.places[s.a]) - rise;
        EXPECT_NEAR(turned, std::round(turned), 1e-7);
    }
}

INSTANTIATE_TEST_SUITE_P(SteinerPoints, Ambient, testing::Values(0, 1, 3));

}  // namespace
}  // namespace mrc
