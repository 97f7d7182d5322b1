// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace mrc {
namespace {

/// Rings around one tube, with their bands, in any order.
class Shared : public testing::Test {
  protected:
    static constexpr int around = 12, rows = 16;
    const Surface surface = made::tube(around, rows).surface();

    struct Shares {
        Partition partition;
        std::vector<Contour> contours;
        std::vector<Patch> patches;
        std::vector<Exclusion> exclusions;
        std::vector<Band> bands;

        std::set<int> faces(int contour) const {
            std::set<int> faces;
            for (const int p : bands[contour].polygons) faces.insert(patches[contour].polygon_face[p]);
            return faces;
        }
        std::set<int> closed(int contour) const {
            std::set<int> vertices;
            for (std::size_t v = 0; v < patches[contour].vertex.size(); ++v) {
                if (exclusions[contour].closed_vertex[v]) vertices.insert(patches[contour].vertex[v]);
            }
            return vertices;
        }
        std::set<int> refused(int contour) const {
            std::set<int> faces;
            for (int p = 0; p < patches[contour].polygon_count(); ++p) {
                if (exclusions[contour].refused[p]) faces.insert(patches[contour].polygon_face[p]);
            }
            return faces;
        }
    };
    Shares shared(const std::vector<Contour>& contours) const {
        Shares s{Partition(surface), contours, {}, {}, {}};
        const int count = static_cast<int>(contours.size());
        for (int i = 0; i < count; ++i) {
            s.patches.push_back(make_patch(surface, contours[i], 4));
            s.partition.occupy(i, contours[i]);
            s.partition.claim(i, s.patches[i]);
        }
        for (int i = 0; i < count; ++i) {
            s.exclusions.push_back(s.partition.exclusion(i, s.patches[i]));
            s.bands.push_back(grow_band(surface, s.patches[i], Options(), {}, s.exclusions[i]));
        }
        for (int i = 0; i < count; ++i) s.partition.enclose(i, s.patches[i], s.bands[i]);
        for (int i = 0; i < count; ++i) s.partition.close(i, s.patches[i], s.exclusions[i]);
        return s;
    }
    static std::set<int> row_faces(int first, int end) {
        std::set<int> faces;
        for (int f = first * around; f < end * around; ++f) faces.insert(f);
        return faces;
    }
};

TEST_F(Shared, a_face_is_the_nearer_contours_and_in_a_tie_nobodys) {
    const Shares odd = shared({made::ring(around, 5), made::ring(around, 10)});  // five rows between them
    EXPECT_EQ(odd.faces(0), row_faces(1, 7));
    EXPECT_EQ(odd.faces(1), row_faces(8, 14));
    const Shares even = shared({made::ring(around, 5), made::ring(around, 9)});
    EXPECT_EQ(even.faces(0), row_faces(1, 7));
    EXPECT_EQ(even.faces(1), row_faces(7, 13));
    const Shares alone = shared({made::ring(around, 5)});
    EXPECT_EQ(alone.faces(0), row_faces(1, 9));
    EXPECT_TRUE(alone.closed(0).empty());
}

TEST_F(Shared, what_two_bands_have_in_common_is_closed_to_both) {
    const Shares shares = shared({made::ring(around, 5), made::ring(around, 9)});
    std::set<int> common;
    for (int i = 0; i < around; ++i) common.insert(7 * around + i);
    EXPECT_TRUE(std::ranges::includes(shares.closed(0), common));
    EXPECT_TRUE(std::ranges::includes(shares.closed(1), common));
    for (int i = 0; i < around; ++i)
        EXPECT_FALSE(shares.closed(0).contains(6 * around + i) || shares.closed(1).contains(8 * around + i));
    for (int i = 0; i < around; ++i) EXPECT_TRUE(shares.partition.shares(0, 9 * around + i));
    for (int i = 0; i < around; ++i) EXPECT_FALSE(shares.partition.shares(1, 9 * around + i));
}

TEST_F(Shared, nothing_depends_on_the_order_of_the_contours) {
    const std::vector<Contour> contours{made::ring(around, 4), made::ring(around, 7), made::ring(around, 12)};
    const Shares shares = shared(contours), turned = shared({contours[2], contours[0], contours[1]});
    const std::vector<int> number{1, 2, 0};
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(shares.faces(i), turned.faces(number[i]));
        EXPECT_EQ(shares.refused(i), turned.refused(number[i]));
        EXPECT_EQ(shares.closed(i), turned.closed(number[i]));
        std::set<int> held, turned_held;
        for (const int other : shares.partition.held_back_by(i, shares.patches[i], shares.bands[i])) held.insert(number[other]);
        for (const int other : turned.partition.held_back_by(number[i], turned.patches[number[i]], turned.bands[number[i]]))
            turned_held.insert(other);
        EXPECT_EQ(held, turned_held);
    }
}

TEST_F(Shared, contours_name_the_neighbors_that_hold_them_back) {
    const Shares shares = shared({made::ring(around, 3), made::ring(around, 8), made::ring(around, 13)});
    const auto held = [&](int i) { return shares.partition.held_back_by(i, shares.patches[i], shares.bands[i]); };
    EXPECT_EQ(held(0), std::vector<int>{1});
    EXPECT_EQ(held(1), (std::vector<int>{0, 2}));
    EXPECT_EQ(held(2), std::vector<int>{1});
}

TEST_F(Shared, a_contour_is_a_wall_to_all_others) {
    const Shares shares = shared({made::ring(around, 5), made::ring(around, 7)});
    for (int i = 0; i < 2; ++i) {
        for (int e = 0; e < static_cast<int>(shares.patches[i].mesh.n_edges()); ++e) {
            const int h = shares.patches[i].edge_halfedge(e), other = i == 0 ? 7 : 5;
            const bool on_other = surface.from(h) / around == other && surface.to(h) / around == other;
            EXPECT_EQ(shares.exclusions[i].wall[e] != 0, on_other);
        }
    }
}

TEST_F(Shared, contours_through_one_face_are_entangled_with_each_other) {
    const auto through_row = [](double t) {
        Contour contour;
        for (int i = 0; i < around; ++i) {
            contour.points.push_back({6 * around + i, 7 * around + i, t});
            contour.points.push_back({6 * around + i, 7 * around + (i + 1) % around, t});
        }
        return contour;
    };
    const std::vector<Contour> contours{through_row(0.3), through_row(0.7), made::ring(around, 6)};
    Partition partition(surface);
    for (int i = 0; i < 3; ++i) partition.occupy(i, contours[i]);
    EXPECT_EQ(partition.entangled_with(0, contours[0]), std::vector<int>{1});
    EXPECT_EQ(partition.entangled_with(1, contours[1]), std::vector<int>{0});
    EXPECT_TRUE(partition.entangled_with(2, contours[2]).empty());  // it runs along edges
}

}  // namespace
}  // namespace mrc
