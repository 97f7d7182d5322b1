// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include <mrc/constraints.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace mrc {
namespace {

class ConstraintsOf : public testing::Test {
  protected:
    const Surface surface = made::plate(2, 2).surface();  // vertices 0 to 8, and a diagonal from 0 to 4
    const double none = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

    std::string refusal(const Constraints& constraints) const {
        try {
            constraints.check(surface);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "";
    }
    std::string refusal_of(const Attractor& attractor) const {
        Constraints constraints;
        constraints.attractors = {{0, 1.0, 1.0, {}}, attractor};
        return refusal(constraints);
    }
};

#define EXPECT_NAMES(name, message) EXPECT_NE((message).find(name), std::string::npos) << "said: " << (message)

TEST_F(ConstraintsOf, a_mesh_may_name_all_its_vertices_and_edges) {
    Constraints constraints;
    const std::vector<double> density{-1.0, 0.0, 1e50, 2.0};
    constraints.required_vertices = {0, 8};
    constraints.required_edges = {{0, 1}, {1, 0}};
    constraints.barriers = {{4, 5}};
    constraints.attractors = {{8, 1e-9, -3.0, 1e-9}, {0, 1e50, 0.0, {}}};
    constraints.region_density = std::make_shared<const std::vector<double>>(density);
    EXPECT_EQ(refusal(constraints), "");
    EXPECT_EQ(refusal({}), "");
}

TEST_F(ConstraintsOf, vertices_out_of_range_are_named) {
    for (const int v : {-1, 9, 1 << 30}) {
        Constraints vertex, edge, barrier;
        vertex.required_vertices = {0, v};
        edge.required_edges = {{0, v}};
        barrier.barriers = {{v, 0}};
        EXPECT_NAMES("required vertex " + std::to_string(v), refusal(vertex));
        EXPECT_NAMES("required edge " + std::to_string(v), refusal(edge));
        EXPECT_NAMES("barrier " + std::to_string(v), refusal(barrier));
        EXPECT_NAMES("attractor vertex " + std::to_string(v), refusal_of({v, 1.0, 1.0, {}}));
    }
}

TEST_F(ConstraintsOf, vertices_that_no_edge_of_the_mesh_joins_are_named) {
    for (const std::array<int, 2> pair : {std::array{0, 4}, std::array{4, 0}, std::array{0, 8}, std::array{3, 3}}) {
        const std::string name = "(" + std::to_string(pair[0]) + ", " + std::to_string(pair[1]) + ")";
        Constraints edge, barrier;
        edge.required_edges = {{0, 1}, pair};
        barrier.barriers = {{0, 1}, pair};
        EXPECT_NAMES("required edge " + name, refusal(edge));
        EXPECT_NAMES("barrier " + name, refusal(barrier));
    }
}

TEST_F(ConstraintsOf, attractors_need_numbers_a_radius_and_a_sigma) {
    for (const double bad : {0.0, -1.0, 1e51, none, infinite}) {
        EXPECT_NAMES("vertex 7 has radius", refusal_of({7, bad, 1.0, {}}));
        EXPECT_NAMES("vertex 7 has a sigma", refusal_of({7, 1.0, 1.0, bad}));
    }
    for (const double bad : {1e51, -1e51, none, infinite}) EXPECT_NAMES("vertex 7 has a strength", refusal_of({7, 1.0, bad, {}}));
}

TEST_F(ConstraintsOf, a_density_has_a_number_for_each_face) {
    for (const std::size_t count : {1U, 3U, 5U}) {
        const std::vector<double> density(count, 1.0);
        Constraints constraints;
        constraints.region_density = std::make_shared<const std::vector<double>>(density);
        EXPECT_NAMES(std::to_string(count) + " entries for 4 faces", refusal(constraints));
    }
    for (const double bad : {1e51, -infinite, none}) {
        const std::vector<double> density{0.0, 0.0, 0.0, bad};
        Constraints constraints;
        constraints.region_density = std::make_shared<const std::vector<double>>(density);
        EXPECT_NAMES("of face 3", refusal(constraints));
    }
}

#undef EXPECT_NAMES

}  // namespace
}  // namespace mrc
