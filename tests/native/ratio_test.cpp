// SPDX-License-Identifier: GPL-3.0-or-later
#include "brute_force.h"
#include "karp_search.h"
#include "random_graphs.h"
#include "thesis_search.h"

#include "ratio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

namespace {

using mrc::WeightedGraph;
using mrc_test::brute_force;
using mrc_test::layered_graph;

/// The ratio of a path, summed from the graph itself.
double ratio_of(const WeightedGraph& graph, const std::vector<int>& nodes) {
    double f = 0.0, g = 0.0;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        for (int a = graph.first_arc[nodes[i + 1]]; a < graph.first_arc[nodes[i + 1] + 1]; ++a) {
            if (graph.from[a] == nodes[i]) {
                f += graph.f[a];
                g += graph.g[a];
            }
        }
    }
    const auto at = [](int node) { return [node](const mrc::Terminal& t) { return t.node == node; }; };
    const auto source = std::ranges::find_if(graph.sources, at(nodes.front()));
    const auto end = std::ranges::find_if(graph.destinations, at(nodes.back()));
    EXPECT_NE(source, graph.sources.end());
    EXPECT_NE(end, graph.destinations.end());
    if (graph.matched) {
        EXPECT_EQ(source - graph.sources.begin(), end - graph.destinations.begin());
    }
    return (f + source->f + end->f) / (g + source->g + end->g);
}

class RandomGraphs : public testing::TestWithParam<bool> {};

TEST_P(RandomGraphs, optimum_is_that_of_brute_force_and_of_the_thesis) {
    int found = 0;
    for (unsigned seed = 0; seed < 500; ++seed) {
        const WeightedGraph graph = layered_graph(seed, GetParam());
        const double expected = brute_force(graph).objective;
        const mrc::RatioResult result = mrc::minimum_ratio(graph);
        const mrc_test::LinearSearch thesis = mrc_test::thesis_search(graph);
        ASSERT_EQ(result.found, std::isfinite(expected)) << "seed " << seed;
        ASSERT_EQ(thesis.found, result.found);
        if (!result.found) continue;
        ++found;
        EXPECT_NEAR(result.objective, expected, 1e-12 * (1.0 + std::abs(expected))) << "seed " << seed;
        EXPECT_NEAR(thesis.ratio, expected, 1e-12 * (1.0 + std::abs(expected))) << "seed " << seed;
        EXPECT_NEAR(ratio_of(graph, result.nodes), result.objective, 1e-12);
        EXPECT_NEAR(mrc_test::shared_lambda_search(graph).ratio, expected, 1e-12 * (1.0 + std::abs(expected)));
    }
    EXPECT_GT(found, 300);
}

TEST_P(RandomGraphs, certificate_bounds_every_path_and_meets_the_best) {
    for (unsigned seed = 1000; seed < 1200; ++seed) {
        const WeightedGraph graph = layered_graph(seed, GetParam());
        const mrc::RatioResult result = mrc::minimum_ratio(graph);
        if (!result.found) continue;
        EXPECT_LE(result.lower_bound, brute_force(graph).objective + 1e-12);
        EXPECT_NEAR(result.lower_bound, result.objective, 1e-12);
    }
}

TEST_P(RandomGraphs, where_the_search_begins_changes_nothing_but_the_work) {
    for (unsigned seed = 2000; seed < 2100; ++seed) {
        const WeightedGraph graph = layered_graph(seed, GetParam());
        const mrc::RatioResult cold = mrc::minimum_ratio(graph);
        if (!cold.found) continue;
        for (const double guess : {-1e15, -3.0, 0.0, cold.objective, 5.0, 1e15}) {
            const mrc::RatioResult warm = mrc::minimum_ratio(graph, {.objective = {}, .guess = mrc::Terminal{-1, guess, 1.0}});
            EXPECT_TRUE(warm.found);
            EXPECT_NEAR(warm.objective, cold.objective, 1e-12);
        }
    }
}

TEST_P(RandomGraphs, optimum_with_length_bias_is_that_of_brute_force) {
    int above_hull = 0;
    for (unsigned seed = 4000; seed < 4500; ++seed) {
        const WeightedGraph graph = layered_graph(seed, GetParam());
        const double lengths = 0.02 * (1.0 + seed % 7);
        const mrc::Objective objective{0.5 + seed % 3, lengths, seed % 2 ? 4.0 : 0.0};
        const double expected = brute_force(graph, objective).objective;
        const mrc::RatioResult result = mrc::minimum_ratio(graph, {.objective = objective, .guess = {}});
        ASSERT_EQ(result.found, std::isfinite(expected));
        if (!result.found) continue;
        EXPECT_NEAR(result.objective, expected, 1e-12 * (1.0 + std::abs(expected))) << "seed " << seed;
        EXPECT_NEAR(result.lower_bound, expected, 1e-12 * (1.0 + std::abs(expected)));
        EXPECT_NEAR(objective.value(result.numerator, result.length), result.objective, 1e-14);
        above_hull += result.labels > 0;
    }
    EXPECT_GT(above_hull, 0);
}

TEST_P(RandomGraphs, optimum_by_counts_is_that_of_brute_force) {
    for (unsigned seed = 6000; seed < 6300; ++seed) {
        WeightedGraph graph = layered_graph(seed, GetParam());
        std::ranges::fill(graph.g, 1.0);
        const mrc::Objective objective{0.5 + seed % 3, 0.02 * (1.0 + seed % 7), seed % 2 ? 3.0 : 0.0};
        const double expected = brute_force(graph, objective).objective;
        // So few labels that a search without Karp's recurrence would give up.
        const mrc::RatioResult result = mrc::minimum_ratio(graph, {.objective = objective, .guess = {}, .most_labels = 1});
        ASSERT_EQ(result.found, std::isfinite(expected));
        if (result.found) {
            EXPECT_NEAR(result.objective, expected, 1e-12 * (1.0 + std::abs(expected))) << "seed " << seed;
            EXPECT_NEAR(mrc_test::karp_search(graph, objective), expected, 1e-12 * (1.0 + std::abs(expected)));
        }
    }
}

TEST_P(RandomGraphs, optimum_by_counts_is_that_of_karps_program_on_larger_graphs) {
    for (unsigned seed = 7000; seed < 7060; ++seed) {
        WeightedGraph graph = layered_graph(seed, GetParam(), 10, 25);
        std::ranges::fill(graph.g, 1.0);
        const mrc::Objective objective{0.5 + seed % 3, 0.004 * (1.0 + seed % 7), seed % 2 ? 9.0 : 0.0};
        const double expected = mrc_test::karp_search(graph, objective);
        const mrc::RatioResult result = mrc::minimum_ratio(graph, {.objective = objective, .guess = {}});
        ASSERT_EQ(result.found, std::isfinite(expected));
        EXPECT_NEAR(result.objective, expected, 1e-12 * (1.0 + std::abs(expected))) << "seed " << seed;
        EXPECT_NEAR(result.lower_bound, expected, 1e-12 * (1.0 + std::abs(expected)));
    }
}

TEST_P(RandomGraphs, a_search_that_gives_up_still_bounds_the_optimum) {
    int gaps = 0;
    for (unsigned seed = 5000; seed < 5200; ++seed) {
        const WeightedGraph graph = layered_graph(seed, GetParam());
        const mrc::Objective objective{1.0, 0.1, 0.0};
        const mrc::RatioResult result = mrc::minimum_ratio(graph, {.objective = objective, .guess = {}, .most_labels = 2});
        if (!result.found) continue;
        EXPECT_LE(result.lower_bound, brute_force(graph, objective).objective + 1e-12);
        gaps += result.lower_bound < result.objective - 1e-9;
    }
    EXPECT_GT(gaps, 0);
}

TEST_P(RandomGraphs, adding_a_multiple_of_g_to_f_moves_the_ratio_and_nothing_else) {
    for (unsigned seed = 3000; seed < 3100; ++seed) {
        WeightedGraph graph = layered_graph(seed, GetParam());
        const mrc::RatioResult before = mrc::minimum_ratio(graph);
        if (!before.found) continue;
        for (int a = 0; a < graph.arc_count(); ++a) graph.f[a] += 3.0 * graph.g[a];
        for (auto* ends : {&graph.sources, &graph.destinations}) {
            for (mrc::Terminal& t : *ends) t.f += 3.0 * t.g;
        }
        const mrc::RatioResult after = mrc::minimum_ratio(graph);
        EXPECT_EQ(after.nodes, before.nodes);
        EXPECT_NEAR(after.objective, before.objective + 3.0, 1e-11);
    }
}

INSTANTIATE_TEST_SUITE_P(Pairs, RandomGraphs, testing::Bool(), [](const auto& pairs) { return pairs.param ? "matched" : "any"; });

TEST(Ratio, bounds_save_passes_over_one_search_a_source) {
    int ours = 0, thesis = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        const WeightedGraph graph = layered_graph(seed, true, 20, 12);
        ours += mrc::minimum_ratio(graph).passes;
        thesis += mrc_test::thesis_search(graph).passes;
    }
    EXPECT_LT(ours, thesis);
}

/// Pairs with one path each, of ratio 2, 1, 1, ...; and from any source to any other destination a path that costs the difference of
/// their heights more, or less: potentials of these heights show at once that none of them is too cheap.
WeightedGraph pairs_at_heights(int count) {
    WeightedGraph graph;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> height(0.0, 1.0);
    std::vector<double> heights(count);
    for (double& h : heights) h = height(random);
    graph.first_arc.assign(count + 1, 0);
    for (int end = 0; end < count; ++end) {
        for (int source = 0; source < count; ++source) {
            graph.from.push_back(source);
            graph.f.push_back(end == 0 && source == 0 ? 2.0 : 1.0 + heights[end] - heights[source]);
            graph.g.push_back(1.0);
        }
        graph.first_arc.push_back(graph.arc_count());
        graph.sources.push_back({end});
        graph.destinations.push_back({count + end});
    }
    return graph;
}

TEST(Ratio, potentials_decide_pairs_of_any_number_without_splitting) {
    for (const int count : {10, 50, 200}) {
        const mrc::RatioResult result = mrc::minimum_ratio(pairs_at_heights(count));
        EXPECT_NEAR(result.objective, 1.0, 1e-12);
        EXPECT_LE(result.passes, 4) << count << " pairs";
    }
}

TEST(Ratio, potentials_leave_the_bounds_of_single_pairs_as_they_are) {
    int passes = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        const mrc::RatioResult result =
            mrc::minimum_ratio(layered_graph(seed, true, 20, 12), {.objective = {1.0, 0.1}, .guess = {}});
        EXPECT_EQ(result.labels, 0) << "seed " << seed;
        passes += result.passes;
    }
    EXPECT_GT(passes, 200);
}

/// Two pairs: first a chain of diamonds whose many paths are bad, nearly alike and hard to tell apart; then three paths of which
/// the best lies above the line through the other two. A pass from both sources at once sees nothing of the second pair.
WeightedGraph distracting_graph() {
    WeightedGraph graph;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-1e-3, 1e-3), length(0.04, 0.07);
    const auto add_node = [&] {
        graph.first_arc.push_back(static_cast<int>(graph.from.size()));
        return static_cast<int>(graph.first_arc.size()) - 1;
    };
    const auto add_arc = [&](int from, double f, double g) {
        graph.from.push_back(from);
        graph.f.push_back(f);
        graph.g.push_back(g);
    };
    const int bad = add_node(), good = add_node();
    int last = bad;
    for (int diamond = 0; diamond < 40; ++diamond) {
        const int upper = add_node();
        add_arc(last, 0.17 + noise(random), length(random));
        const int lower = add_node();
        add_arc(last, 0.17 + noise(random), length(random));
        const int next = add_node();
        add_arc(upper, 0.0, 0.01);
        add_arc(lower, 0.0, 0.01);
        last = next;
    }
    const int end = add_node();
    add_arc(bad, -10.0, 1.0);
    for (const int path : {0, 1, 2}) add_arc(good, std::array{0.0, -6.0, -2.9}[path], std::array{1.0, 3.0, 2.0}[path]);
    graph.first_arc.push_back(static_cast<int>(graph.from.size()));
    graph.sources = {{bad}, {good}};
    graph.destinations = {{last}, {end}};
    return graph;
}

TEST(Ratio, a_pair_of_many_bad_paths_does_not_use_up_the_labels_of_the_others) {
    mrc::RatioOptions options;
    options.objective = {1.0, 1.0};
    options.most_labels = 1000;
    const mrc::RatioResult result = mrc::minimum_ratio(distracting_graph(), options);
    EXPECT_DOUBLE_EQ(result.objective, -2.9 / 2.0 + 2.0);
    EXPECT_DOUBLE_EQ(result.lower_bound, result.objective);
}

/// A single pair with paths (L, F): (0.1, -0.3) and (6.02, -50) on the lower hull, (0.3, -1.2) and (0.22, -1) above it. The search
/// meets (0.3, -1.2) first, so that none of its passes has a slope as steep as the objective is then low.
TEST(Ratio, a_short_path_above_the_hull_is_found_after_a_great_improvement) {
    WeightedGraph graph;
    graph.first_arc = {0, 0, 2, 5};
    graph.from = {0, 0, 0, 1, 0};
    graph.f = {-1.0, -50.0, -0.3, 0.0, -1.2};
    graph.g = {0.2, 6.0, 0.1, 0.02, 0.3};
    graph.sources = {{0}};
    graph.destinations = {{2}};
    const mrc::RatioResult result = mrc::minimum_ratio(graph, {.objective = {1.0, 1.0}, .guess = {}});
    EXPECT_DOUBLE_EQ(result.objective, -1.0 / 0.22 + 0.22);
    EXPECT_DOUBLE_EQ(result.lower_bound, result.objective);
}

/// The best of three sources on one node lies above the line through the other two.
TEST(Ratio, each_source_on_a_node_counts_above_the_hull) {
    WeightedGraph graph;
    graph.matched = false;
    graph.first_arc = {0, 0, 1};
    graph.from = {0};
    graph.f = {0.0};
    graph.g = {0.5};
    graph.sources = {{0, -2.9, 1.5}, {0, 0.0, 0.5}, {0, -6.0, 2.5}};
    graph.destinations = {{1}};
    for (int turn = 0; turn < 3; ++turn) {
        std::ranges::rotate(graph.sources, graph.sources.begin() + 1);
        EXPECT_DOUBLE_EQ(mrc::minimum_ratio(graph, {.objective = {1.0, 1.0}, .guess = {}}).objective, -2.9 / 2.0 + 2.0);
    }
}

TEST(Ratio, what_a_beat_throws_ends_the_search) {
    mrc::RatioOptions options;
    options.objective = {1.0, 1.0};
    int beats = 0;
    options.beat = [&] { ++beats; };
    mrc::minimum_ratio(distracting_graph(), options);
    EXPECT_GT(beats, 5);
    for (int last = 1; last < beats; ++last) {
        int left = last;
        options.beat = [&] {
            if (--left == 0) throw std::runtime_error("enough");
        };
        EXPECT_THROW(mrc::minimum_ratio(distracting_graph(), options), std::runtime_error);
    }
}

TEST(Ratio, a_graph_without_a_path_has_no_result) {
    WeightedGraph graph;
    graph.first_arc = {0, 0, 0};
    graph.sources = {{0, 0.0, 0.0}};
    graph.destinations = {{1, 0.0, 0.0}};
    EXPECT_FALSE(mrc::minimum_ratio(graph).found);
    graph.sources.clear();
    graph.destinations.clear();
    EXPECT_FALSE(mrc::minimum_ratio(graph).found);
}

/// Rows of nodes round a band, a quarter of a unit apart along each. Between rows arcs are long and cost next to nothing, as along
/// the straight edges of a shaft; the first row is what was given, the second the best, the last far away.
WeightedGraph rows_joined_by_long_arcs() {
    constexpr int columns = 120, rows = 5;
    constexpr std::array<double, rows> height = {0.0, 1.0, 40.0, 90.0, 200.0}, cost = {1.4, -1.0, 0.1, 0.1, 0.1};
    WeightedGraph graph;
    graph.first_arc.push_back(0);
    for (int node = 0; node < columns * rows; ++node) {
        const int column = node / rows, row = node % rows;
        for (int other = 0; other < rows && column > 0; ++other) {
            const double away = std::abs(height[row] - height[other]), length = 0.25 + away;
            const double far = 0.5 * (height[row] + height[other]) / 5.0;
            graph.from.push_back((column - 1) * rows + other);
            graph.g.push_back(length);
            graph.f.push_back((0.25 * 0.5 * (cost[row] + cost[other])) + 0.02 * length * far * far);
        }
        graph.first_arc.push_back(graph.arc_count());
    }
    for (int row = 0; row < rows; ++row) {
        graph.sources.push_back({row});
        graph.destinations.push_back({(columns - 1) * rows + row});
    }
    return graph;
}

TEST(LengthBias, is_not_led_astray_by_a_guess_at_which_long_ways_pay) {
    const WeightedGraph graph = rows_joined_by_long_arcs();
    const double length = 0.25 * 119;
    mrc::RatioOptions options;
    options.objective = {.scale = 0.3, .bias = 2.0 / length, .floor = 0.5 * length};
    options.guess = mrc::Terminal{-1, 1.4 * length, length};
    const mrc::RatioResult result = mrc::minimum_ratio(graph, options);
    EXPECT_EQ(result.labels, 0);
    EXPECT_NEAR(result.lower_bound, result.objective, 1e-12);
    EXPECT_LT(result.objective, options.objective.value(-0.9 * length, length));
}

}  // namespace
