// SPDX-License-Identifier: GPL-3.0-or-later
#include "allocated.h"
#include "waisted_torus.h"

#include "curvature_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace {

using mrc::VertexCurvature;

class CurvatureField : public testing::Test {
  protected:
    const mrc::Surface surface = mrc_test::waisted_torus();
    std::vector<int> all = std::vector<int>(surface.vertex_count());

    CurvatureField() { std::iota(all.begin(), all.end(), 0); }

    mrc::CurvatureField field() const { return {surface, mrc::Options()}; }

    /// Vertex by vertex.
    std::vector<VertexCurvature> expected() const { return read(field()); }

    std::vector<VertexCurvature> read(const mrc::CurvatureField& field) const {
        std::vector<VertexCurvature> result;
        for (const int v : all) result.push_back(field.at(v));
        return result;
    }

    static bool same(const std::vector<VertexCurvature>& one, const std::vector<VertexCurvature>& other) {
        return std::ranges::equal(one, other, [](const VertexCurvature& a, const VertexCurvature& b) {
            return a.kappa_min == b.kappa_min && a.kappa_max == b.kappa_max && a.direction_min == b.direction_min &&
                   a.direction_max == b.direction_max && a.normal == b.normal && a.umbilic == b.umbilic;
        });
    }
};

TEST_F(CurvatureField, is_the_same_in_any_order_at_once_or_in_parts) {
    const std::vector<VertexCurvature> one_by_one = expected();
    const mrc::CurvatureField at_once = field(), in_parts = field();
    at_once.prepare(all);
    EXPECT_TRUE(same(read(at_once), one_by_one));
    std::vector<int> backwards(all.rbegin(), all.rend());
    backwards.resize(all.size() / 2);
    in_parts.prepare(backwards);
    in_parts.at(3);
    in_parts.prepare(all);
    EXPECT_TRUE(same(read(in_parts), one_by_one));
}

TEST_F(CurvatureField, takes_no_more_memory_for_a_vertex_the_more_there_are) {
    const auto taken = [&](std::size_t count) {
        const mrc::CurvatureField one_by_one = field();
        const std::size_t before = mrc_test::allocated_bytes();
        for (std::size_t i = 0; i < count; ++i) one_by_one.at(all[i]);
        return static_cast<double>(mrc_test::allocated_bytes() - before) / static_cast<double>(count);
    };
    EXPECT_LE(taken(all.size()), 2.0 * taken(all.size() / 16));
}

TEST_F(CurvatureField, dihedral_angles_do_not_depend_on_what_was_prepared) {
    const mrc::CurvatureField prepared = field(), fresh = field();
    prepared.prepare(all);
    for (int h = 0; h < surface.halfedge_count(); ++h) EXPECT_EQ(prepared.dihedral(h), fresh.dihedral(h));
}

TEST_F(CurvatureField, what_a_beat_throws_ends_the_work_and_spoils_nothing) {
    const std::vector<VertexCurvature> one_by_one = expected();
    int beats = 0;
    field().prepare(all, [&] { ++beats; });
    ASSERT_GT(beats, 10);
    for (int last = 1; last <= beats; ++last) {
        const mrc::CurvatureField stopped = field();
        int left = last;
        const auto beat = [&] {
            if (--left == 0) throw std::runtime_error("enough");
        };
        EXPECT_THROW(stopped.prepare(all, beat), std::runtime_error);
        stopped.prepare(all);
        EXPECT_TRUE(same(read(stopped), one_by_one)) << "after beat " << last;
    }
}

}  // namespace
