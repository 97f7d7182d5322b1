// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include <mrc/check_contour.h>
#include <mrc/optimize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <vector>

namespace mrc {
namespace {

using Edge = std::array<int, 2>;

/// A torus with hidden faces, two that are missing, and one that faces the other way: obstacles of every kind on the path of loops.
Surface worn_torus() {
    const Surface whole = mrc_test::waisted_torus();
    std::vector<double> positions;
    for (int v = 0; v < whole.vertex_count(); ++v) {
        for (const double x : whole.position(v)) positions.push_back(x);
    }
    std::vector<int32_t> offsets{0}, corners;
    for (int f = 0; f < whole.face_count(); ++f) {
        if (f == 100 || f == 700) continue;
        std::vector<int> face(whole.face(f).begin(), whole.face(f).end());
        if (f == 380) std::ranges::reverse(face);
        corners.insert(corners.end(), face.begin(), face.end());
        offsets.push_back(static_cast<int32_t>(corners.size()));
    }
    const std::vector<int32_t> hidden{24, 25, 44, 45, 64, 65};
    return Surface({positions, offsets, corners, {}, hidden});
}

std::optional<InvalidInput> refusal(const Surface& surface, const Contour& contour, const std::vector<Edge>& barriers) {
    Options options;
    options.width = 1;
    Constraints constraints;
    constraints.barriers = barriers;
    try {
        optimize(surface, contour, options, constraints);
    } catch (const InvalidInput& error) {
        return error;
    }
    return std::nullopt;
}

class RandomContours {
  public:
    explicit RandomContours(const Surface& surface) : surface_(surface) {}

    /// A loop around the tube with up to two faults, open or closed, on vertices or beside them.
    Contour next() {
        Contour contour = mrc_test::loop_near(below(mrc_test::waists));
        std::ranges::rotate(contour.points, contour.points.begin() + below(static_cast<int>(contour.points.size())));
        if (below(3) == 0) contour = walk();
        for (int faults = below(3); faults > 0; --faults) spoil(contour);
        return contour;
    }
    std::vector<Edge> barriers() {
        std::vector<Edge> edges;
        for (int n = below(3) == 0 ? below(3) : 0; n > 0; --n) edges.push_back(edge());
        if (below(20) == 0) edges.push_back({below(surface_.vertex_count()), below(surface_.vertex_count() + 5)});
        return edges;
    }

  private:
    const Surface& surface_;
    std::mt19937 random_{7};

    int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    Edge edge() {
        const int h = below(surface_.halfedge_count());
        return {surface_.from(h), surface_.to(h)};
    }
    Contour walk() {
        std::vector<int> vertices{below(surface_.vertex_count())};
        for (int n = below(6); n > 0; --n) {
            const auto ways = surface_.outgoing(vertices.back());
            if (!ways.empty()) vertices.push_back(surface_.to(ways[below(static_cast<int>(ways.size()))]));
        }
        return vertex_contour(vertices, below(3) == 0);
    }
    void spoil(Contour& contour) {
        if (contour.points.empty()) return;
        SurfacePoint& p = contour.points[below(static_cast<int>(contour.points.size()))];
        switch (below(7)) {
            case 0:
                contour.closed = !contour.closed;
                return;
            case 1:
                p = vertex_point(below(surface_.vertex_count() + 50) - 25);
                return;
            case 2:
                p = {edge()[0], edge()[1], 0.5};
                return;
            case 3: {
                const auto ways = surface_.outgoing(std::clamp(p.a, 0, surface_.vertex_count() - 1));
                if (!ways.empty()) p = {p.a, surface_.to(ways[below(static_cast<int>(ways.size()))]), 0.25 * below(7) - 0.25};
                return;
            }
            case 4:
                contour.points.resize(below(static_cast<int>(contour.points.size())));
                return;
            case 5:
                std::swap(p, contour.points.front());
                return;
            default:
                contour.points.push_back(contour.points[below(static_cast<int>(contour.points.size()))]);
        }
    }
};

TEST(CheckContour, refuses_exactly_what_optimize_refuses) {
    const Surface surface = worn_torus();
    RandomContours contours(surface);
    int refused = 0, taken = 0;
    std::vector<ErrorCode> codes;
    for (int i = 0; i < 1500; ++i) {
        const Contour contour = contours.next();
        const std::vector<Edge> barriers = contours.barriers();
        const std::optional<InvalidInput> found = check_contour(surface, contour, barriers),
                                          expected = refusal(surface, contour, barriers);
        ASSERT_EQ(found.has_value(), expected.has_value()) << "contour " << i << ": " << (found ? found : expected)->what();
        ++(found ? refused : taken);
        if (!found) continue;
        EXPECT_STREQ(found->what(), expected->what());
        EXPECT_EQ(found->code(), expected->code());
        EXPECT_EQ(found->elements(), expected->elements());
        EXPECT_EQ(found->contour(), std::nullopt);
        if (std::ranges::find(codes, found->code()) == codes.end()) codes.push_back(found->code());
    }
    EXPECT_GT(refused, 200);
    EXPECT_GT(taken, 200);
    EXPECT_GE(codes.size(), 8U);
}

TEST(CheckContour, does_not_depend_on_where_a_loop_begins_nor_on_its_direction) {
    const Surface surface = worn_torus();
    RandomContours contours(surface);
    for (int i = 0; i < 300; ++i) {
        Contour contour = contours.next();
        const bool refused = check_contour(surface, contour).has_value();
        std::ranges::reverse(contour.points);
        EXPECT_EQ(check_contour(surface, contour).has_value(), refused);
        if (contour.closed && !contour.points.empty()) std::ranges::rotate(contour.points, contour.points.begin() + 1);
        EXPECT_EQ(check_contour(surface, contour).has_value(), refused);
    }
}

TEST(CheckContour, refuses_what_has_no_length) {
    const std::vector<double> positions(3 * 4, 1.0);
    const std::vector<int32_t> triangles{0, 1, 2, 0, 2, 3};
    const Surface surface({positions, {}, triangles, {}, {}});
    const auto error = check_contour(surface, vertex_contour(std::vector{0, 2}, false));
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::no_length);
}

}  // namespace
}  // namespace mrc
