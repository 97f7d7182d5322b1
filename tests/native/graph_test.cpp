// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include "contour_scales.h"
#include "graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using mrc::Chord, mrc::ContourGraph, mrc::GraphPoint, mrc::Patch;

/// A refined graph around a torus over a flow that rises in two steps of one half; in between it is flat but for noise.
class FlatFlow : public testing::TestWithParam<std::tuple<int, double>> {
  protected:
    const int steiner = std::get<0>(GetParam());
    const double noise = std::pow(10.0, std::get<1>(GetParam()));
    const mrc::Surface surface = mrc_test::waisted_torus();
    const mrc::Contour loop = mrc_test::loop_near(0);
    const mrc::Options options = narrow();
    const Patch patch = mrc::make_patch(surface, loop, options.width);
    const mrc::Band band = mrc::grow_band(surface, patch, options);
    const ContourGraph graph = make_graph();

    /// The corners of the band's triangles.
    std::vector<std::array<int, 3>> triangles() const {
        std::vector<std::array<int, 3>> triangles;
        for (const auto face : patch.mesh.faces()) {
            if (!band.face[face.idx()]) continue;
            std::ranges::transform(patch.mesh.fv_range(face), triangles.emplace_back().begin(),
                                   [&](auto v) { return patch.vertex[v.idx()]; });
        }
        return triangles;
    }

  private:
    ContourGraph make_graph() const {
        const mrc::CurvatureField field(surface, options);
        const mrc::Scales scales = mrc::contour_scales(surface, field, loop, options);
        const mrc::Energy energy(surface, field, scales, options);
        return mrc::make_graph(surface, patch, band, flow(), energy, options, {}, steiner);
    }

    static mrc::Options narrow() {
        mrc::Options options;
        options.width = 2;
        options.flow = mrc::FlowKind::harmonic;
        return options;
    }

    mrc::Flow flow() const {
        mrc::Flow flow = mrc::make_flow(patch, band, options);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> any(-noise, noise);
        for (double& value : flow.value) value = 0.5 * std::floor(2.0 * value) + any(random);
        return flow;
    }
};

/// Where a point lies on the path around a triangle: i at corner i, or -1.
double border_place(const std::array<int, 3>& corners, const mrc::SurfacePoint& p) {
    for (int i = 0; i < 3; ++i) {
        const int a = corners[i], b = corners[(i + 1) % 3];
        if (p.is_vertex() && p.a == a) return i;
        if (p.a == a && p.b == b) return i + p.t;
        if (p.a == b && p.b == a) return i + 1.0 - p.t;
    }
    return -1.0;
}

/// The graph's points on a triangle's border, with their places there.
std::map<int, double> points_of(const ContourGraph& graph, const std::array<int, 3>& corners) {
    std::map<int, double> place;
    for (std::size_t p = 0; p < graph.points.size(); ++p) {
        const double at = border_place(corners, graph.points[p].place);
        if (at >= 0.0) place[static_cast<int>(p)] = at;
    }
    return place;
}

bool on_one_side(double one, double other) {
    const auto on = [](int side, double at) { return (side <= at && at <= side + 1.0) || (side == 2 && at == 0.0); };
    return (on(0, one) && on(0, other)) || (on(1, one) && on(1, other)) || (on(2, one) && on(2, other));
}

/// The chords inside a triangle and along its sides, with their ends' places on its border, the lower first.
using PlacedChords = std::vector<std::pair<int, std::array<double, 2>>>;

PlacedChords chords_of(const ContourGraph& graph, const std::map<int, double>& place) {
    PlacedChords chords;
    for (std::size_t c = 0; c < graph.chords.size(); ++c) {
        const auto tail = place.find(graph.chords[c].tail), head = place.find(graph.chords[c].head);
        if (tail == place.end() || head == place.end()) continue;
        const auto [low, high] = std::minmax(tail->second, head->second);
        chords.push_back({static_cast<int>(c), {low, high}});
    }
    return chords;
}

/// True where a contour, which passes each level once, may hold first `a` and then, before it comes around again, `b`.
bool may_follow(const ContourGraph& graph, const Chord& a, const Chord& b) {
    const GraphPoint &tail_a = graph.points[a.tail], &head_a = graph.points[a.head];
    const GraphPoint &tail_b = graph.points[b.tail], &head_b = graph.points[b.head];
    const bool level = a.increment == 0.0 && b.increment == 0.0 && tail_a.level == tail_b.level;
    if (level) {
        const bool rising = head_a.rank > tail_a.rank;
        if (rising != (head_b.rank > tail_b.rank)) return false;
        return rising ? head_a.rank <= tail_b.rank : head_a.rank >= tail_b.rank;
    }
    const auto lifted_head = [](const GraphPoint& tail, const GraphPoint& head) { return head.level + (head.level < tail.level); };
    const int period = tail_b.level < lifted_head(tail_a, head_a);
    return lifted_head(tail_a, head_a) <= tail_b.level + period && lifted_head(tail_b, head_b) + period <= tail_a.level + 1.0;
}

TEST_P(FlatFlow, no_contour_can_hold_two_chords_that_cross) {
    int crossings = 0;
    for (const std::array<int, 3>& triangle : triangles()) {
        const PlacedChords chords = chords_of(graph, points_of(graph, triangle));
        for (const auto& [a, of_a] : chords) {
            for (const auto& [b, of_b] : chords) {
                if (!(of_a[0] < of_b[0] && of_b[0] < of_a[1] && of_a[1] < of_b[1])) continue;
                ++crossings;
                ASSERT_FALSE(may_follow(graph, graph.chords[a], graph.chords[b])) << "chords " << a << " and " << b;
                ASSERT_FALSE(may_follow(graph, graph.chords[b], graph.chords[a])) << "chords " << b << " and " << a;
            }
        }
    }
    EXPECT_GT(crossings, 1000);
}

TEST_P(FlatFlow, a_chord_is_level_or_rises_by_more_than_what_counts_as_level) {
    constexpr double nearly = 1.0 - 1e-3;  // increments of 1e-12 have the rounding of the levels
    for (const Chord& chord : graph.chords) {
        if (chord.increment == 0.0) {
            ASSERT_EQ(graph.points[chord.tail].level, graph.points[chord.head].level);
        } else {
            ASSERT_GE(chord.increment, nearly * 1e-12);
        }
    }
    for (const std::array<int, 3>& triangle : triangles()) {
        const std::map<int, double> place = points_of(graph, triangle);
        for (const auto& [c, ends] : chords_of(graph, place)) {
            const double rise = graph.chords[c].increment;
            if (rise == 0.0 || !on_one_side(ends[0], ends[1])) continue;
            ASSERT_GE(rise, nearly * 1e-9 / (steiner + 1));
        }
    }
}

TEST_P(FlatFlow, all_points_of_a_triangle_are_joined_but_on_one_side_and_at_one_rank) {
    for (const std::array<int, 3>& triangle : triangles()) {
        const std::map<int, double> place = points_of(graph, triangle);
        ASSERT_EQ(static_cast<int>(place.size()), 3 + 3 * steiner);
        std::set<std::pair<int, int>> joined;
        for (const auto& [c, ends] : chords_of(graph, place))
            joined.insert(std::minmax(graph.chords[c].tail, graph.chords[c].head));
        for (const auto& [p, at_p] : place) {
            for (const auto& [q, at_q] : place) {
                if (p >= q || on_one_side(at_p, at_q)) continue;
                const GraphPoint &one = graph.points[p], &other = graph.points[q];
                const bool level_at_one_rank = one.level == other.level && std::abs(one.rank - other.rank) < 1e-9;
                ASSERT_NE(joined.contains({p, q}), level_at_one_rank) << "points " << p << " and " << q;
            }
        }
    }
}

// Far below, near and far above the increments that count as level.
INSTANTIATE_TEST_SUITE_P(Noise, FlatFlow,
                         testing::Combine(testing::Values(1, 2, 3, 6), testing::Values(-12.0, -10.0, -9.0, -8.5, -8.0, -7.0)));

}  // namespace
