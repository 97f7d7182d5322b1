// SPDX-License-Identifier: GPL-3.0-or-later
// The ratio stage compared with its baselines on the same graphs: one bare pass, the thesis's search, a shared lambda without bounds,
// and Karp's dynamic program. Arguments: the number of faces of the band, and k.
#include "cases.h"
#include "karp_search.h"
#include "search_space.h"
#include "thesis_search.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <utility>

namespace {

using benchmark::State;

const mrc_bench::Case& tube(int faces, int refinement) {
    static std::map<std::pair<int, int>, mrc_bench::Case> kept;
    const auto found = kept.find({faces, refinement});
    if (found != kept.end()) return found->second;
    return kept.emplace(std::pair(faces, refinement), mrc_bench::tube_case(faces, refinement)).first->second;
}

const mrc::WeightedGraph& graph_of(const State& state) {
    static std::map<std::pair<int, int>, mrc::WeightedGraph> kept;
    const std::pair key(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    if (const auto found = kept.find(key); found != kept.end()) return found->second;
    const mrc_bench::Case& c = tube(key.first, key.second);
    return kept.emplace(key, mrc::search_space(c.surface, c.contour, c.options).graph.search).first->second;
}

void report(State& state, const mrc::WeightedGraph& graph, double passes) {
    state.counters["nodes"] = graph.node_count();
    state.counters["arcs"] = graph.arc_count();
    state.counters["passes"] = passes;
}

void bare_pass(State& state) {
    const mrc::WeightedGraph& graph = graph_of(state);
    std::vector<double> value;
    for (auto _ : state) benchmark::DoNotOptimize(mrc_bench::bare_pass(graph, -0.1, value));
    report(state, graph, 1);
}

void ratio(State& state) {
    const mrc::WeightedGraph& graph = graph_of(state);
    mrc::RatioResult result;
    for (auto _ : state) benchmark::DoNotOptimize(result = mrc::minimum_ratio(graph));
    report(state, graph, result.passes);
}

/// A whole call with 20,000 faces and k = 2 for each variant of the tube; only the number of passes is of interest.
void passes(State& state) {
    const mrc_bench::Case c = mrc_bench::tube_case(20'000, 2, 0, static_cast<int>(state.range(0)));
    mrc::Result result;
    for (auto _ : state) benchmark::DoNotOptimize(result = mrc::optimize(c.surface, c.contour, c.options));
    state.counters["passes"] = result.statistics.passes;
    state.counters["faces"] = result.statistics.faces;
}

void shared_lambda(State& state) {
    const mrc::WeightedGraph& graph = graph_of(state);
    mrc_test::LinearSearch result;
    for (auto _ : state) benchmark::DoNotOptimize(result = mrc_test::shared_lambda_search(graph));
    report(state, graph, result.passes);
}

void thesis(State& state) {
    const mrc::WeightedGraph& graph = graph_of(state);
    mrc_test::LinearSearch result;
    for (auto _ : state) benchmark::DoNotOptimize(result = mrc_test::thesis_search(graph));
    report(state, graph, result.passes);
}

mrc::WeightedGraph counted(mrc::WeightedGraph graph) {
    std::ranges::fill(graph.g, 1.0);
    return graph;
}

constexpr mrc::Objective by_counts{1.0, 0.01, 0.0};

void karp(State& state) {
    const mrc::WeightedGraph graph = counted(graph_of(state));
    for (auto _ : state) benchmark::DoNotOptimize(mrc_test::karp_search(graph, by_counts));
    report(state, graph, 0);
}

void ratio_by_counts(State& state) {
    const mrc::WeightedGraph graph = counted(graph_of(state));
    mrc::RatioResult result;
    for (auto _ : state) benchmark::DoNotOptimize(result = mrc::minimum_ratio(graph, {.objective = by_counts, .guess = {}}));
    report(state, graph, result.passes);
}

void bands(benchmark::internal::Benchmark* b, const std::vector<long>& faces, const std::vector<long>& steiner) {
    for (const long k : steiner) {
        for (const long f : faces) b->Args({f, k});
    }
    b->ArgNames({"faces", "k"})->Unit(benchmark::kMicrosecond);
}
void all_bands(benchmark::internal::Benchmark* b) {
    bands(b, {250, 500, 1000, 2500, 5000, 10000, 20000}, {0, 1, 2});
    bands(b, {250, 1000, 5000}, {4});
}
void smaller_bands(benchmark::internal::Benchmark* b) { bands(b, {250, 1000, 5000}, {0, 1, 2}); }
void smallest_bands(benchmark::internal::Benchmark* b) { bands(b, {250, 500, 1000}, {0}); }  // up to 2,000 nodes

}  // namespace

BENCHMARK(bare_pass)->Apply(all_bands);
BENCHMARK(ratio)->Apply(all_bands);
BENCHMARK(passes)->ArgName("variant")->DenseRange(0, 9)->Iterations(1)->Repetitions(1)->Unit(benchmark::kMillisecond);
BENCHMARK(shared_lambda)->Apply(smaller_bands);
BENCHMARK(thesis)->Apply(smaller_bands);
BENCHMARK(karp)->Apply(smallest_bands);
BENCHMARK(ratio_by_counts)->Apply(smallest_bands);
