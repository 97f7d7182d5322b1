// SPDX-License-Identifier: GPL-3.0-or-later
// Every stage, the whole call, and its cost within a large mesh, from arrays and on two threads.
#include "cases.h"

#include <mrc/optimize.h>
#include "curvature_field.h"
#include "trace_contour.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace {

using benchmark::State;

mrc_bench::Case case_of(const State& state) {
    return mrc_bench::tube_case(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
}

/// The whole call. Counters: the mean microseconds of every stage, and the columns of table 5.1.
void optimize(State& state) {
    const mrc_bench::Case c = case_of(state);
    std::map<std::string, double> seconds;
    mrc::Statistics last;
    for (auto _ : state) {
        last = mrc::optimize(c.surface, c.contour, c.options).statistics;
        for (const auto& [stage, time] : last.seconds) seconds[stage] += time;
    }
    for (const auto& [stage, time] : seconds)
        state.counters[stage] = benchmark::Counter(1e6 * time, benchmark::Counter::kAvgIterations);
    state.counters["faces"] = last.faces;
    state.counters["cut"] = last.cut;
    state.counters["nodes"] = last.nodes;
    state.counters["arcs"] = last.arcs;
    state.counters["passes"] = last.passes;
    state.counters["linear_steps"] = last.linear_steps;
}

/// Whether two results have the same points and ratios, bit for bit.
bool same(const mrc::Result& a, const mrc::Result& b) {
    return a.contour == b.contour && a.ratio == b.ratio && a.lower_bound == b.lower_bound;
}

/// Cached, since a mesh of a million triangles takes long to build.
const mrc_bench::Case& case_in_mesh(int triangles) {
    static std::map<int, mrc_bench::Case> kept;
    const auto found = kept.find(triangles);
    return found != kept.end() ? found->second : kept.emplace(triangles, mrc_bench::tube_case(1000, 0, triangles)).first->second;
}

/// The same band of 1,000 faces in meshes of different sizes; building the surface is not measured.
void optimize_in_mesh(State& state) {
    const mrc_bench::Case& c = case_in_mesh(static_cast<int>(state.range(0)));
    mrc::Result result;
    for (auto _ : state) result = mrc::optimize(c.surface, c.contour, c.options);
    const mrc_bench::Case& alone = case_in_mesh(0);
    state.counters["same"] = same(result, mrc::optimize(alone.surface, alone.contour, alone.options));
    state.counters["triangles"] = c.surface.triangle_count();
}

void surface(State& state) {
    const mrc_bench::Arrays arrays = mrc_bench::torus_arrays(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(mrc::Surface(arrays.view()).edge_count());
    state.counters["triangles"] = static_cast<double>(arrays.triangles.size()) / 3.0;
}

std::vector<mrc::Result> all_results(mrc_bench::Row& row, int threads) {
    row.options.threads = threads;
    std::vector<mrc::Task> tasks;
    tasks.reserve(row.contours.size());
    for (const mrc::Contour& contour : row.contours) tasks.push_back({contour, {}, {}});
    return mrc::optimize_all(row.surface, tasks, row.options);
}

/// Sixteen contours of one mesh, out of each other's reach, on different numbers of threads.
void optimize_all(State& state) {
    static mrc_bench::Row row = mrc_bench::contours_in_a_row(16, 1000, 1);
    std::vector<mrc::Result> results;
    for (auto _ : state) results = all_results(row, static_cast<int>(state.range(0)));
    state.counters["same"] = std::ranges::equal(results, all_results(row, 1), same);
}

}  // namespace

BENCHMARK(optimize)
    ->ArgNames({"faces", "k"})
    ->ArgsProduct({{250, 500, 1000, 2500, 5000, 10000, 20000}, {0, 1, 2}})
    ->ArgsProduct({{250, 1000, 5000}, {4}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(optimize_in_mesh)->ArgName("triangles")->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(surface)->ArgName("triangles")->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(optimize_all)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
