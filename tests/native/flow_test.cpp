// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mrc {
namespace {

using FlowHalfedge = PatchMesh::HalfedgeHandle;

/// Flows of all kinds in the bands of a rough tube.
class FlowOf : public testing::TestWithParam<FlowKind> {
  protected:
    static constexpr int around = 12, row = 6;
    const Surface surface = rough_tube();

    struct Flowing {
        Patch patch;
        Band band;
        Flow flow;

        double along(int h) const { return flow.increment(patch.mesh, h); }
        double along(const std::vector<int>& curve) const {
            double sum = 0.0;
            for (std::size_t i = 0; i + (patch.closed ? 0 : 1) < curve.size(); ++i) {
                const PatchMesh::VertexHandle a(curve[i]), b(curve[(i + 1) % curve.size()]);
                sum += along(patch.mesh.find_halfedge(a, b).idx());
            }
            return sum;
        }
    };
    static Surface rough_tube() {
        std::mt19937 random(6);
        std::uniform_real_distribution<double> any(-0.05, 0.05);
        return made::tube(around, 12)
            .mapped([&](const Vec3& p) { return Vec3(p + Vec3(any(random), any(random), any(random))); })
            .surface();
    }
    static Flowing flowing(const Surface& surface, const Contour& contour, FlowKind kind) {
        Options options;
        options.width = 3;
        options.flow = kind;
        Patch patch = make_patch(surface, contour, options.width);
        Band band = grow_band(surface, patch, options);
        Flow flow = make_flow(patch, band, options);
        return {std::move(patch), std::move(band), std::move(flow)};
    }
    static Contour jagged() {
        std::vector<int> vertices;
        for (int i = 0; i < around; ++i) {
            vertices.push_back((row + i / 3 % 2) * around + i);
            if (i % 3 == 2) vertices.push_back((row + (i + 1) / 3 % 2) * around + i);
        }
        return vertex_contour(vertices);
    }
    static Contour part() { return {made::ring(around, row).points, false}; }
    static Contour chain() { return vertex_contour(std::vector<int>{73, 74, 75, 87, 88}, false); }
};

TEST_P(FlowOf, a_band_is_the_opposite_the_other_way_and_closed_round_every_triangle) {
    for (const Contour& contour : {jagged(), chain()}) {
        const Flowing f = flowing(surface, contour, GetParam());
        for (int h = 0; h < static_cast<int>(f.patch.mesh.n_halfedges()); ++h) EXPECT_EQ(f.flow.jump[h], -f.flow.jump[h ^ 1]);
        for (const auto face : f.patch.mesh.faces()) {
            if (!f.band.face[face.idx()]) continue;
            double sum = 0.0;
            for (const auto h : f.patch.mesh.fh_range(face)) sum += f.along(h.idx());
            EXPECT_NEAR(sum, 0.0, 1e-12);
        }
    }
}

TEST_P(FlowOf, a_closed_band_rises_by_one_along_every_curve_round_it) {
    const Flowing f = flowing(surface, jagged(), GetParam());
    EXPECT_NEAR(f.along(f.patch.contour), 1.0, 1e-12);
    for (const auto& curve : f.band.left) EXPECT_NEAR(f.along(curve), 1.0, 1e-12);
    for (const auto& curve : f.band.right) EXPECT_NEAR(f.along(curve), 1.0, 1e-12);
    for (const auto& curve : strip_boundaries(f.patch, f.band)) EXPECT_NEAR(f.along(curve), 1.0, 1e-12);
}

TEST_P(FlowOf, an_open_band_rises_from_zero_at_the_first_vertex_to_one_at_the_last) {
    const Flowing f = flowing(surface, chain(), GetParam());
    EXPECT_NEAR(f.flow.value[f.patch.contour.front()], 0.0, 1e-12);
    EXPECT_NEAR(f.flow.value[f.patch.contour.back()], 1.0, 1e-12);
    EXPECT_TRUE(std::ranges::all_of(f.flow.jump, [](int jump) { return jump == 0; }));
    for (const double value : f.flow.value) EXPECT_TRUE(value > -1e-12 && value < 1.0 + 1e-12);
}

TEST_P(FlowOf, the_reversed_contour_from_the_same_start_is_the_opposite) {
    const Contour ring = made::ring(around, row);
    Contour back = made::reversed(ring);
    std::ranges::rotate(back.points, back.points.end() - 1);
    const Flowing one = flowing(surface, ring, GetParam()), other = flowing(surface, back, GetParam());
    std::vector<int> there(surface.vertex_count(), -1);
    for (std::size_t v = 0; v < other.patch.vertex.size(); ++v) there[other.patch.vertex[v]] = static_cast<int>(v);
    for (int h = 0; h < static_cast<int>(one.patch.mesh.n_halfedges()); ++h) {
        if (!one.band.edge[h / 2]) continue;
        const auto in_other = [&](auto v) { return PatchMesh::VertexHandle(there[one.patch.vertex[v.idx()]]); };
        const auto same = other.patch.mesh.find_halfedge(in_other(one.patch.mesh.from_vertex_handle(FlowHalfedge(h))),
                                                         in_other(one.patch.mesh.to_vertex_handle(FlowHalfedge(h))));
        EXPECT_NEAR(one.along(h), -other.along(same.idx()), 1e-9);
    }
}

TEST_P(FlowOf, a_regular_tube_rises_evenly_round_it_and_not_at_all_along_it) {
    const Flowing f = flowing(made::tube(around, 12).surface(), made::ring(around, row), GetParam());
    for (int h = 0; h < static_cast<int>(f.patch.mesh.n_halfedges()); ++h) {
        if (!f.band.edge[h / 2] || f.patch.diagonal_halfedge(h)) continue;
        const int a = f.patch.vertex[f.patch.mesh.from_vertex_handle(FlowHalfedge(h)).idx()];
        const int b = f.patch.vertex[f.patch.mesh.to_vertex_handle(FlowHalfedge(h)).idx()];
        const int step = a / around != b / around ? 0 : (b - a + around) % around == 1 ? 1 : -1;
        EXPECT_NEAR(f.along(h), static_cast<double>(step) / around, 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FlowOf, testing::Values(FlowKind::gates, FlowKind::arc_length, FlowKind::harmonic));

class HarmonicFlow : public FlowOf {};

TEST_F(HarmonicFlow, what_flows_into_a_vertex_along_real_edges_flows_out_again_but_at_the_ends_of_a_curve) {
    for (const Contour& contour : {jagged(), chain()}) {
        const Flowing f = flowing(surface, contour, FlowKind::harmonic);
        std::vector<double> sum(f.patch.vertex.size(), 0.0);
        for (int h = 0; h < static_cast<int>(f.patch.mesh.n_halfedges()); ++h) {
            if (f.band.edge[h / 2] && !f.patch.diagonal_halfedge(h))
                sum[f.patch.mesh.from_vertex_handle(FlowHalfedge(h)).idx()] += f.along(h);
        }
        for (std::size_t v = 0; v < sum.size(); ++v) {
            const int vertex = static_cast<int>(v);
            const bool end = !contour.closed && (vertex == f.patch.contour.front() || vertex == f.patch.contour.back());
            EXPECT_EQ(std::abs(sum[v]) > 1e-9, end);
        }
    }
}

}  // namespace
}  // namespace mrc
