// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include "flow_levels.h"
#include "search_context.h"
#include "search_space.h"
#include "trace_contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace mrc {
namespace {

class Traced : public testing::TestWithParam<std::tuple<bool, int>> {
  protected:
    const Surface surface = mrc_test::waisted_torus();
    const int steiner = std::get<1>(GetParam());

    Contour given() const {
        Contour contour = mrc_test::loop_near(0);
        contour.closed = std::get<0>(GetParam());
        if (!contour.closed) contour.points.resize(9);
        return contour;
    }
    Options made_options() const {
        Options made;
        made.width = 3;
        made.refinement = steiner;
        return made;
    }
    const Options options = made_options();
    const SearchSpace space = search_space(surface, given(), options);
    const RatioResult best = minimum_ratio(space.graph.search);
    const Contour traced = trace_contour(space.graph, space.patch, best.nodes);

    const GraphPoint& point(int p) const { return space.graph.points[p]; }
};

TEST_P(Traced, a_contour_has_the_chords_of_its_path_in_their_order) {
    ASSERT_TRUE(best.found);
    const std::size_t count = traced.points.size();
    std::vector<std::pair<std::size_t, std::size_t>> steps;  // by the places in the contour
    const auto place = [&](int p) {
        return static_cast<std::size_t>(std::ranges::find(traced.points, point(p).place) - traced.points.begin());
    };
    for (const int node : best.nodes) {
        const Chord& chord = space.graph.chords[space.graph.chord_of(node)];
        steps.emplace_back(place(chord.tail), place(chord.head));
    }
    EXPECT_EQ(steps.size(), traced.closed ? count + 1 : count - 1);
    for (const auto& [tail, head] : steps) EXPECT_EQ(head, (tail + 1) % count);
    if (traced.closed) {
        EXPECT_EQ(steps.front(), steps.back());
    }
}

TEST_P(Traced, a_contour_measures_what_its_path_weighs) {
    const SearchContext context(surface, given(), options, {}, std::nullopt);
    const Measure found = measure(surface, context.energy, traced, steiner);
    EXPECT_NEAR(found.numerator, best.numerator, 1e-9);
    EXPECT_NEAR(found.length, best.length, 1e-9);
}

TEST_P(Traced, a_contour_starts_at_the_point_next_along_the_flow_after_the_first_given_one) {
    if (!traced.closed) {
        EXPECT_EQ(traced.points.front(), given().points.front());
        EXPECT_EQ(traced.points.back(), given().points.back());
        return;
    }
    const auto level = [&](const SurfacePoint& p) { return std::ranges::find(space.graph.points, p, &GraphPoint::place)->level; };
    const double start = level(given().points.front());
    const double first = above(level(traced.points.front()), start);
    for (const SurfacePoint& p : traced.points) EXPECT_GE(above(level(p), start), first);
}

TEST_P(Traced, each_segment_lies_in_its_face_and_along_an_edge_in_the_left_one) {
    const std::vector<int> faces = segment_faces(surface, traced);
    ASSERT_EQ(faces.size(), traced.points.size() - (traced.closed ? 0 : 1));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const SurfacePoint &p = traced.points[i], &q = traced.points[(i + 1) % traced.points.size()];
        const auto corners = surface.face(faces[i]);
        for (const int v : {p.a, p.b, q.a, q.b}) EXPECT_NE(std::ranges::find(corners, v), corners.end());
        if (p.is_vertex() && q.is_vertex() && surface.real_edge(p.a, q.a)) {
            EXPECT_EQ(faces[i], surface.halfedge_face(surface.find_halfedge(p.a, q.a)));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Contours, Traced, testing::Combine(testing::Bool(), testing::Values(0, 2)));

}  // namespace
}  // namespace mrc
