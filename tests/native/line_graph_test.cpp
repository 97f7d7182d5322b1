// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include "contour_scales.h"
#include "search_context.h"
#include "search_space.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace mrc {
namespace {

/// The graph around a torus: closed or open, regular or refined.
class LineGraph : public testing::TestWithParam<std::tuple<bool, int>> {
  protected:
    const Surface surface = mrc_test::waisted_torus();
    const Options options = settings();
    const Contour contour = given();
    const SearchSpace space = search_space(surface, contour, options);
    const ContourGraph& graph = space.graph;
    const WeightedGraph& search = space.graph.search;
    const SearchContext context{surface, contour, options, {}, std::nullopt};

    static Options settings() {
        Options options;
        options.width = 2;
        options.refinement = std::get<1>(GetParam());
        options.ends = Ends::vertices;
        return options;
    }
    static Contour given() {
        Contour contour = mrc_test::loop_near(0);
        contour.closed = std::get<0>(GetParam());
        if (!contour.closed) contour.points.resize(9);
        return contour;
    }
    /// A node's chord; those of an open curve come once.
    const Chord& chord(int node) const { return graph.chords[graph.chord_of(node)]; }
    Vec3 way(int node) const {
        return surface.position(graph.points[chord(node).head].place) - surface.position(graph.points[chord(node).tail].place);
    }
    template <class Visit>
    void for_each_arc(Visit&& visit) const {
        for (int node = 0; node < search.node_count(); ++node) {
            for (int arc = search.first_arc[node]; arc < search.first_arc[node + 1]; ++arc) visit(search.from[arc], node, arc);
        }
    }
    /// Eq. 3.2 as it stands in the thesis.
    static double energy_of_arc(const VertexCurvature& c, double kappa_0, const Vec3& e1, const Vec3& e2) {
        const auto flat = [&](const Vec3& e) { return Vec3(e - e.dot(c.normal) * c.normal); };
        const Vec3 direction = c.umbilic ? Vec3((flat(e1) + flat(e2)).normalized()) : c.direction_max;
        const auto along = [&](const Vec3& e) { return e.norm() * flat(e).normalized().dot(direction); };
        const double both = std::abs(along(e1) + along(e2));
        return c.kappa_min < 0.0 ? 0.5 * c.kappa_min * both : 0.5 * kappa_0 * (e1.norm() + e2.norm() - both);
    }
};

TEST_P(LineGraph, every_arc_leads_on_to_a_later_node_that_starts_where_the_first_ends) {
    ASSERT_GT(search.arc_count(), 100);
    for_each_arc([&](int from, int to, int) {
        EXPECT_LT(from, to);
        EXPECT_EQ(chord(from).head, chord(to).tail);
        EXPECT_NE(chord(from).tail, chord(to).head);
    });
}

TEST_P(LineGraph, an_arc_at_a_vertex_weighs_what_the_equations_say) {
    for_each_arc([&](int from, int to, int arc) {
        const SurfacePoint& middle = graph.points[chord(to).tail].place;
        EXPECT_NEAR(search.g[arc], 0.5 * (way(from).norm() + way(to).norm()), 1e-12);
        if (!middle.is_vertex()) return;
        EXPECT_NEAR(search.f[arc], energy_of_arc(context.field.at(middle.a), context.scales.kappa_0, way(from), way(to)), 1e-9);
    });
}

TEST_P(LineGraph, no_arc_turns_by_more_than_it_may_but_along_the_given_contour) {
    std::set<std::pair<int, int>> own;  // of the graph's points
    const std::vector<SurfacePoint> points = expressed(contour, options.refinement).points;
    std::map<std::tuple<int, int, long>, int> number;
    const auto key = [](const SurfacePoint& p) {
        return std::tuple(std::min(p.a, p.b), std::max(p.a, p.b), std::lround(1e6 * (p.a <= p.b ? p.t : 1.0 - p.t)));
    };
    for (std::size_t p = 0; p < graph.points.size(); ++p) number[key(graph.points[p].place)] = static_cast<int>(p);
    for (std::size_t i = 0; i < points.size(); ++i)
        own.emplace(number[key(points[i])], number[key(points[(i + 1) % points.size()])]);
    for_each_arc([&](int from, int to, int) {
        const SurfacePoint& middle = graph.points[chord(to).tail].place;
        const bool given = own.contains({chord(from).tail, chord(from).head}) && own.contains({chord(to).tail, chord(to).head});
        if (!middle.is_vertex() || given) return;
        const Vec3 normal = context.field.at(middle.a).normal;
        const auto flat = [&](const Vec3& e) { return Vec3(e - e.dot(normal) * normal).normalized(); };
        EXPECT_GT(flat(way(from)).dot(flat(way(to))), std::cos(options.max_turn) - 2e-6);
    });
}

TEST_P(LineGraph, chords_run_along_with_the_flow_and_those_that_cross_the_cut_come_last) {
    for (std::size_t c = 0; c < graph.chords.size(); ++c) {
        const Chord& chord = graph.chords[c];
        const double rise = graph.points[chord.head].level - graph.points[chord.tail].level;
        const bool crosses = c + graph.crossing >= graph.chords.size();
        EXPECT_GE(chord.increment, 0.0);
        EXPECT_NEAR(chord.increment, rise + crosses, 1e-12);
    }
}

TEST_P(LineGraph, a_closed_contour_begins_and_ends_with_one_chord_across_the_cut_and_an_open_one_at_its_ends) {
    EXPECT_EQ(search.matched, contour.closed);
    ASSERT_FALSE(search.sources.empty());
    for (std::size_t i = 0; i < search.sources.size(); ++i) {
        const Terminal& source = search.sources[i];
        if (contour.closed) {
            EXPECT_EQ(graph.chord_of(source.node), graph.chord_of(search.destinations[i].node));
            EXPECT_LT(source.node, search.destinations[i].node);
        } else {
            EXPECT_EQ(graph.points[chord(source.node).tail].place, contour.points.front());
            EXPECT_NEAR(source.g, 0.5 * way(source.node).norm(), 1e-12);
        }
    }
    if (contour.closed) return;
    for (const Terminal& last : search.destinations) EXPECT_EQ(graph.points[chord(last.node).head].place, contour.points.back());
}

INSTANTIATE_TEST_SUITE_P(Contours, LineGraph, testing::Combine(testing::Bool(), testing::Values(0, 2)));

}  // namespace
}  // namespace mrc
