// SPDX-License-Identifier: GPL-3.0-or-later
#include "certificate.h"
#include "brute_force.h"
#include "random_graphs.h"
#include "search_space.h"
#include "waisted_torus.h"

#include <mrc/optimize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace {

using mrc::RatioResult;
using mrc::WeightedGraph;
using mrc_test::BestPath;
using mrc_test::brute_force;
using mrc_test::GraphKind;
using mrc_test::objection;

class Certificate : public testing::TestWithParam<std::tuple<GraphKind, bool>> {
  protected:
    static WeightedGraph graph(unsigned seed) {
        return mrc_test::random_graph(std::get<0>(GetParam()), seed, std::get<1>(GetParam()));
    }
};

TEST_P(Certificate, stands_whenever_the_whole_graph_was_searched) {
    for (unsigned seed = 50000; seed < 50060; ++seed) {
        const WeightedGraph whole = graph(seed);
        EXPECT_EQ(objection(whole, mrc::minimum_ratio(whole)), "") << "seed " << seed;
    }
}

WeightedGraph without_source(WeightedGraph graph, int source) {
    graph.sources.erase(graph.sources.begin() + source);
    if (graph.matched) graph.destinations.erase(graph.destinations.begin() + source);
    return graph;
}

/// By how much the best path's F - lambda L is below 0 at the ratio of another; relative to the sizes of the terms.
double margin(const BestPath& best, const BestPath& other) {
    if (!std::isfinite(best.objective)) return 0.0;
    if (!std::isfinite(other.objective)) return 1.0;
    return (other.objective * best.length - best.numerator) / (1.0 + std::abs(other.objective) * best.length);
}

TEST_P(Certificate, falls_exactly_where_the_source_of_every_best_path_was_dropped) {
    int fell = 0, stood = 0;
    for (unsigned seed = 60000; seed < 60060; ++seed) {
        const WeightedGraph whole = graph(seed);
        for (int source = 0; source < static_cast<int>(whole.sources.size()); ++source) {
            const WeightedGraph rest = without_source(whole, source);
            const double lost = margin(brute_force(whole), brute_force(rest));
            const std::string found = objection(whole, mrc::minimum_ratio(rest));
            if (lost > 1e-10) {
                EXPECT_NE(found, "") << "seed " << seed << " without source " << source;
                ++fell;
            } else {
                EXPECT_EQ(found, "") << "seed " << seed << " without source " << source;
                ++stood;
            }
        }
    }
    // Where all weights are alike, no path is better than another.
    if (std::get<0>(GetParam()).weights != mrc_test::Weights::alike) {
        EXPECT_GE(fell, 20);
    }
    EXPECT_GE(stood, 20);
}

INSTANTIATE_TEST_SUITE_P(Graphs, Certificate, testing::Combine(testing::ValuesIn(mrc_test::graph_kinds), testing::Bool()),
                         [](const auto& kind) {
                             return std::string(std::get<0>(kind.param).name) + (std::get<1>(kind.param) ? "_matched" : "_any");
                         });

TEST(CertificateOfABand, stands_and_falls_with_the_best_source) {
    const mrc::Surface surface = mrc_test::waisted_torus();
    for (const int refinement : {0, 1, 2}) {
        mrc::Options options;
        options.refinement = refinement;
        const WeightedGraph whole = mrc::search_space(surface, mrc_test::loop_near(0), options).graph.search;
        const RatioResult result = mrc::minimum_ratio(whole);
        ASSERT_TRUE(result.found);
        EXPECT_EQ(objection(whole, result), "");
        const auto best = std::ranges::find(whole.sources, result.nodes.front(), &mrc::Terminal::node);
        const WeightedGraph rest = without_source(whole, static_cast<int>(best - whole.sources.begin()));
        EXPECT_NE(objection(whole, mrc::minimum_ratio(rest)), "") << "k = " << refinement;
    }
}

/// Two pairs of one node between each: ratios 1 and 2, and between the first source and the second destination -5.
struct TwoPairs : testing::Test {
    WeightedGraph graph;
    RatioResult result;

    TwoPairs() {
        graph.first_arc = {0, 0, 0, 1, 2, 3, 5};
        graph.from = {0, 1, 2, 3, 2};
        graph.f = {0.5, 1.0, 0.5, 1.0, -5.5};
        graph.g = {0.5, 0.5, 0.5, 0.5, 0.5};
        graph.sources = {{0}, {1}};
        graph.destinations = {{4}, {5}};
        result = mrc::minimum_ratio(graph);
    }
};

TEST_F(TwoPairs, give_the_first) {
    EXPECT_EQ(objection(graph, result), "");
    EXPECT_EQ(result.nodes, (std::vector{0, 2, 4}));
}

TEST_F(TwoPairs, a_path_between_two_pairs_is_none) {
    result.nodes = {0, 2, 5};
    result.numerator = -5.0;
    result.objective = result.lower_bound = -5.0;
    EXPECT_EQ(objection(graph, result), "the path is none of the graph with these sums");
    graph.matched = false;
    EXPECT_EQ(objection(graph, result), "");
}

TEST_F(TwoPairs, a_path_that_skips_a_node_is_none) {
    result.nodes = {0, 4};
    EXPECT_EQ(objection(graph, result), "the path is none of the graph with these sums");
}

TEST_F(TwoPairs, sums_of_other_arcs_are_none) {
    result.numerator = 0.5;
    result.objective = result.lower_bound = 0.5;
    EXPECT_EQ(objection(graph, result), "the path is none of the graph with these sums");
}

TEST_F(TwoPairs, an_objective_is_the_paths_own) {
    result.objective = result.lower_bound = 0.9;
    EXPECT_EQ(objection(graph, result), "the objective is not the path's");
}

TEST_F(TwoPairs, a_bound_below_the_best_leaves_a_gap) {
    result.lower_bound = 0.9;
    EXPECT_EQ(objection(graph, result), "the gap is open");
}

TEST_F(TwoPairs, the_second_is_not_the_best) {
    result.nodes = {1, 3, 5};
    result.numerator = 2.0;
    result.objective = result.lower_bound = 2.0;
    EXPECT_EQ(objection(graph, result), "source 0 and destination 0 have a better path");
}

TEST_F(TwoPairs, nothing_found_is_wrong_where_there_is_a_path) {
    EXPECT_EQ(objection(graph, RatioResult{}), "source 0 and destination 0 have a better path");
    graph.f.clear(), graph.g.clear(), graph.from.clear();
    std::ranges::fill(graph.first_arc, 0);
    EXPECT_EQ(objection(graph, RatioResult{}), "");
}

}  // namespace
