// SPDX-License-Identifier: GPL-3.0-or-later
#include "brute_force.h"
#include "certificate.h"
#include "karp_search.h"
#include "random_graphs.h"
#include "thesis_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace {

using mrc::WeightedGraph;
using mrc_test::BestPath;
using mrc_test::brute_force;
using mrc_test::GraphKind;

/// Sums of f have sizes about 1: this is what another order of summing may change, over a length and as it stands.
double rounding(const BestPath& best) { return 1e-12 * (1.0 + std::abs(best.objective) + 1.0 / best.length); }

mrc::Objective objective_of(unsigned seed) { return {0.5 + seed % 3, 0.02 * (1.0 + seed % 7), seed % 2 ? 4.0 : 0.0}; }

class EveryKind : public testing::TestWithParam<std::tuple<GraphKind, bool>> {
  protected:
    /// Calls check(graph, seed) for many graphs of the kind; among them are some with a path and, where that is the kind, without.
    template <class Check>
    static void for_each_graph(unsigned first, Check&& check) {
        const auto& [kind, matched] = GetParam();
        int reachable = 0;
        for (unsigned seed = first; seed < first + 60; ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            const WeightedGraph graph = mrc_test::random_graph(kind, seed, matched);
            ASSERT_NO_FATAL_FAILURE(check(graph, seed));
            reachable += std::isfinite(brute_force(graph).objective);
        }
        EXPECT_GE(reachable, 10);
    }

    /// The result is a path of the graph with the objective that brute force found, and its bound is tight.
    static void expect_optimum(const WeightedGraph& graph, const mrc::RatioResult& result, const BestPath& best) {
        ASSERT_EQ(result.found, std::isfinite(best.objective));
        if (!result.found) return;
        EXPECT_NEAR(result.objective, best.objective, rounding(best));
        EXPECT_NEAR(result.lower_bound, best.objective, rounding(best));
        EXPECT_TRUE(mrc_test::is_path(graph, result.nodes, result.numerator, result.length));
    }
};

TEST_P(EveryKind, optimum_is_that_of_brute_force_and_of_the_thesis) {
    for_each_graph(10000, [](const WeightedGraph& graph, unsigned) {
        const BestPath best = brute_force(graph);
        const mrc::RatioResult result = mrc::minimum_ratio(graph);
        const mrc_test::LinearSearch thesis = mrc_test::thesis_search(graph);
        ASSERT_EQ(result.found, std::isfinite(best.objective));
        ASSERT_EQ(thesis.found, result.found);
        if (!result.found) return;
        EXPECT_NEAR(result.objective, best.objective, rounding(best));
        EXPECT_NEAR(thesis.ratio, best.objective, rounding(best));
        EXPECT_NEAR(mrc_test::shared_lambda_search(graph).ratio, best.objective, rounding(best));
        EXPECT_TRUE(mrc_test::is_path(graph, result.nodes, result.numerator, result.length));
    });
}

TEST_P(EveryKind, optimum_with_length_bias_is_that_of_brute_force) {
    for_each_graph(20000, [](const WeightedGraph& graph, unsigned seed) {
        const mrc::Objective objective = objective_of(seed);
        const BestPath best = brute_force(graph, objective);
        const mrc::RatioResult result = mrc::minimum_ratio(graph, {.objective = objective, .guess = {}});
        expect_optimum(graph, result, best);
    });
}

TEST_P(EveryKind, optimum_by_counts_is_that_of_brute_force_and_of_karps_program) {
    for_each_graph(30000, [](WeightedGraph graph, unsigned seed) {
        std::ranges::fill(graph.g, 1.0);
        const mrc::Objective objective = objective_of(seed);
        const BestPath best = brute_force(graph, objective);
        const mrc::RatioResult result = mrc::minimum_ratio(graph, {.objective = objective, .guess = {}});
        expect_optimum(graph, result, best);
        if (!result.found) return;
        EXPECT_NEAR(mrc_test::karp_search(graph, objective), best.objective, rounding(best));
    });
}

TEST_P(EveryKind, a_warm_start_changes_nothing) {
    for_each_graph(40000, [](const WeightedGraph& graph, unsigned) {
        const BestPath best = brute_force(graph);
        for (const double guess : {-1e15, -3.0, 0.0, best.objective, 5.0, 1e15}) {
            if (!std::isfinite(guess)) continue;
            const mrc::RatioResult result = mrc::minimum_ratio(graph, {.objective = {}, .guess = mrc::Terminal{-1, guess, 1.0}});
            ASSERT_EQ(result.found, std::isfinite(best.objective));
            if (!result.found) continue;
            EXPECT_NEAR(result.objective, best.objective, rounding(best)) << "guess " << guess;
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Graphs, EveryKind, testing::Combine(testing::ValuesIn(mrc_test::graph_kinds), testing::Bool()),
                         [](const auto& kind) {
                             return std::string(std::get<0>(kind.param).name) + (std::get<1>(kind.param) ? "_matched" : "_any");
                         });

}  // namespace
