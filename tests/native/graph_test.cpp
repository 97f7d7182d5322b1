// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include <mrc/graph.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using mrc::Chord, mrc::ContourGraph, mrc::GraphPoint, mrc::Patch;

/// A refined graph round a torus over a flow that rises in two steps of one half; in between it is flat but for noise.
class FlatFlow : public testing::TestWithParam<std::tuple<int, int>> {
  protected:
    const int steiner = std::get<0>(GetParam());
    const double noise = std::pow(10.0, std::get<1>(GetParam()));
    const mrc::Surface surface = mrc_test::waisted_torus();
    const mrc::Contour loop = mrc_test::loop_near(0);
    const mrc::Options options = narrow();
    const Patch patch = mrc::make_patch(surface, loop, options.width);
    const mrc::Band band = mrc::grow_band(surface, patch, options);

    ContourGraph graph() const {
        const mrc::CurvatureField field(surface, 0.3, options);
        const mrc::Scales scales = mrc::contour_scales(surface, field, 0.3, loop, options);
        const mrc::Energy energy(surface, field, scales, options);
        return mrc::make_graph(surface, patch, band, flow(), energy, options, {}, steiner);
    }

  private:
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

/// Where a point lies on the way round a triangle: i at corner i, or -1.
double border_place(const std::array<int, 3>& corners, const mrc::SurfacePoint& p) {
    for (int i = 0; i < 3; ++i) {
        const int a = corners[i], b = corners[(i + 1) % 3];
        if (p.is_vertex() && p.a == a) return i;
        if (p.a == a && p.b == b) return i + p.t;
        if (p.a == b && p.b == a) return i + 1.0 - p.t;
    }
    return -1.0;
}

/// The chords inside a triangle and along its sides, with their ends' places on its border, the lower first.
using PlacedChords = std::vector<std::pair<int, std::array<double, 2>>>;

PlacedChords chords_of(const ContourGraph& graph, const std::array<int, 3>& corners) {
    std::map<int, double> place;
    for (std::size_t p = 0; p < graph.points.size(); ++p) {
        const double at = border_place(corners, graph.points[p].place);
        if (at >= 0.0) place[static_cast<int>(p)] = at;
    }
    PlacedChords chords;
    for (std::size_t c = 0; c < graph.chords.size(); ++c) {
        const auto tail = place.find(graph.chords[c].tail), head = place.find(graph.chords[c].head);
        if (tail == place.end() || head == place.end()) continue;
        const auto [low, high] = std::minmax(tail->second, head->second);
        chords.push_back({static_cast<int>(c), {low, high}});
    }
    return chords;
}

/// True where a contour, which passes each level once, may hold first `a` and then, before it comes round again, `b`.
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
    const ContourGraph graph = this->graph();
    int crossings = 0;
    for (const auto face : patch.mesh.faces()) {
        if (!band.face[face.idx()]) continue;
        std::array<int, 3> corners{};
        std::ranges::transform(patch.mesh.fv_range(face), corners.begin(), [&](auto v) { return patch.vertex[v.idx()]; });
        const PlacedChords chords = chords_of(graph, corners);
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

// Far below, near and far above the increments that count as level.
INSTANTIATE_TEST_SUITE_P(Noise, FlatFlow, testing::Combine(testing::Values(1, 2, 3), testing::Values(-15, -12, -10, -9, -8, -5)));

}  // namespace
