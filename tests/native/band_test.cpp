// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace mrc {
namespace {

class BandOf : public testing::Test {
  protected:
    static constexpr int around = 12, row = 6;
    const made::Mesh tube_mesh = made::tube(around, 12);
    const Surface tube = tube_mesh.surface();
    const Contour loop = made::ring(around, row);
    const Contour chain = vertex_contour(std::vector<int>{73, 74, 75, 87, 88}, false);

    struct Grown {
        Patch patch;
        Band band;

        std::set<int> faces() const {
            std::set<int> faces;
            for (const int p : band.polygons) faces.insert(patch.polygon_face[p]);
            return faces;
        }
        std::set<int> vertices(Side side) const {
            std::set<int> vertices;
            for (std::size_t v = 0; v < band.side.size(); ++v) {
                if (band.side[v] == side) vertices.insert(patch.vertex[v]);
            }
            return vertices;
        }
        int euler_characteristic() const {
            const auto inside = [](Side side) { return side != Side::outside; };
            return static_cast<int>(std::ranges::count_if(band.side, inside) - std::ranges::count(band.edge, 1) +
                                    std::ranges::count(band.face, 1));
        }
    };
    static Grown grown(const Surface& surface, const Contour& contour, std::optional<int> width,
                       const Constraints& constraints = {}, const Exclusion& exclusion = {}) {
        Options options;
        options.width = width;
        Patch patch = make_patch(surface, contour, width);
        Band band = grow_band(surface, patch, options, constraints, exclusion);
        return {std::move(patch), std::move(band)};
    }
    static std::set<int> rows(int first, int end) {
        std::set<int> faces;
        for (int f = first * around; f < end * around; ++f) faces.insert(f);
        return faces;
    }
};

TEST_F(BandOf, a_ring_round_a_tube_is_the_rows_beside_it) {
    for (int width = 1; width <= 6; ++width) {
        const Grown grown = this->grown(tube, loop, width);
        EXPECT_EQ(grown.faces(), rows(row - width, row + width));
        EXPECT_EQ(grown.band.rounds, width);
        for (std::size_t v = 0; v < grown.band.side.size(); ++v) {
            const int rise = grown.patch.vertex[v] / around - row;
            EXPECT_EQ(static_cast<int>(grown.band.side[v]), (rise > 0) - (rise < 0));
            EXPECT_EQ(grown.band.round[v], std::abs(rise));
        }
        EXPECT_EQ(static_cast<int>(grown.band.left.size()), width + 1);
        EXPECT_EQ(static_cast<int>(grown.band.left.back().size()), around);
    }
}

TEST_F(BandOf, a_closed_contour_is_an_annulus_and_of_an_open_one_a_disk) {
    const Surface ball = made::ball(16, 11).surface(), torus = made::torus(24, 12).surface();
    for (const std::optional<int> width : {std::optional(1), std::optional(3), std::optional<int>()}) {
        EXPECT_EQ(grown(tube, loop, width).euler_characteristic(), 0);
        EXPECT_EQ(grown(tube, chain, width).euler_characteristic(), 1);
        EXPECT_EQ(
            grown(torus, vertex_contour(std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}), width).euler_characteristic(), 0);
        EXPECT_EQ(grown(ball, vertex_contour(std::vector<int>{65, 66, 67, 83, 82, 81}), width).euler_characteristic(), 0);
        EXPECT_EQ(grown(ball, vertex_contour(std::vector<int>{65, 66, 67, 83}, false), width).euler_characteristic(), 1);
    }
}

TEST_F(BandOf, polygons_takes_each_whole_or_not_at_all) {
    // Two squares side by side become one polygon of six corners, in every second row.
    made::Mesh mixed{tube_mesh.points, {}};
    for (int f = 0; f < around * 12; ++f) {
        const std::vector<int>&a = tube_mesh.faces[f], &b = tube_mesh.faces[f / around * around + (f + 1) % around];
        const bool merges = f / around % 2 == 1;
        if (!merges) mixed.faces.push_back(a);
        if (merges && f % 2 == 0) mixed.faces.push_back({a[0], a[1], b[1], b[2], b[3], a[3]});
    }
    const Surface surface = mixed.surface();
    for (const Contour& contour : {loop, chain}) {
        const Grown grown = this->grown(surface, contour, 3);
        std::vector<int> held(grown.patch.polygon_count(), 0);
        for (std::size_t f = 0; f < grown.band.face.size(); ++f) held[grown.patch.polygon[f]] += grown.band.face[f];
        for (int p = 0; p < grown.patch.polygon_count(); ++p) {
            const int all = static_cast<int>(surface.face(grown.patch.polygon_face[p]).size()) - 2;
            const bool entered = std::ranges::find(grown.band.polygons, p) != grown.band.polygons.end();
            EXPECT_EQ(held[p], entered ? all : 0);
        }
        EXPECT_EQ(grown.euler_characteristic(), contour.closed ? 0 : 1);
    }
}

TEST_F(BandOf, the_reversed_contour_has_the_same_faces_and_left_and_right_trade_places) {
    for (const Contour& contour : {loop, chain}) {
        const Grown one = grown(tube, contour, 3), other = grown(tube, made::reversed(contour), 3);
        EXPECT_EQ(one.faces(), other.faces());
        if (!contour.closed) continue;  // polygons around the ends of a curve are of whichever side comes first
        EXPECT_EQ(one.vertices(Side::left), other.vertices(Side::right));
        EXPECT_EQ(one.vertices(Side::right), other.vertices(Side::left));
    }
}

TEST_F(BandOf, a_contour_does_not_depend_on_the_numbering) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> any(-0.03, 0.03);
    const made::Mesh rough = tube_mesh.mapped([&](const Vec3& p) { return Vec3(p + Vec3(any(random), any(random), any(random))); });
    const std::vector<int> number = made::shuffled(static_cast<int>(rough.points.size()));
    for (const Contour& contour : {loop, chain})
        EXPECT_EQ(grown(rough.surface(), contour, 4).faces(),
                  grown(rough.renumbered(number).surface(), made::renumbered(contour, number), 4).faces());
}

TEST_F(BandOf, what_lies_between_barriers_ends_at_them) {
    Constraints fence;
    for (int i = 0; i < around; ++i) fence.barriers.push_back({(row + 2) * around + i, (row + 2) * around + (i + 1) % around});
    EXPECT_EQ(grown(tube, loop, 5, fence).faces(), rows(row - 5, row + 2));
}

TEST_F(BandOf, hidden_and_refused_faces_is_without_them_and_notes_those_refused) {
    const Surface hidden = tube_mesh.surface({(row + 1) * around + 3});
    std::set<int> expected = rows(row - 1, row + 2);
    expected.erase((row + 1) * around + 3);
    const std::set<int> found = grown(hidden, loop, 2).faces();
    EXPECT_FALSE(found.contains((row + 1) * around + 3));
    EXPECT_TRUE(std::ranges::includes(found, rows(row - 2, row + 1)));
    const Patch patch = make_patch(tube, loop, 2);
    Exclusion exclusion;
    for (const int face : patch.polygon_face) exclusion.refused.push_back(face / around == row);  // all on the left
    const Grown halved = grown(tube, loop, 2, {}, exclusion);
    EXPECT_EQ(halved.faces(), rows(row - 2, row));
    EXPECT_EQ(static_cast<int>(halved.band.refused.size()), around);
}

}  // namespace
}  // namespace mrc
