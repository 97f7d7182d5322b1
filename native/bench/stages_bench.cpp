// SPDX-License-Identifier: GPL-3.0-or-later
// Every stage of the way, the whole call, and what it costs beside a large mesh, from arrays and on two threads.
#include "cases.h"

#include <mrc/contour.h>
#include <mrc/curvature.h>
#include <mrc/optimize.h>

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using benchmark::State;

mrc_bench::Case case_of(const State& state) {
    return mrc_bench::tube_case(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
}

/// The whole call, with the seconds that its stages report as counters, in microseconds.
void optimize(State& state) {
    const mrc_bench::Case c = case_of(state);
    mrc::Result result;
    for (auto _ : state) {
        result = mrc::optimize(c.surface, c.contour, c.options);
        benchmark::DoNotOptimize(result.ratio);
    }
    for (const auto& [stage, seconds] : result.statistics.seconds) state.counters[stage] = 1e6 * seconds;
    state.counters["band"] = 1e6 * result.statistics.seconds.at("band");
    state.counters["faces"] = result.statistics.faces;
    state.counters["arcs"] = result.statistics.arcs;
}

/// The same band of 1,000 faces in meshes of different sizes; the surface is built before.
void optimize_beside(State& state) {
    const mrc_bench::Case c = mrc_bench::tube_case(1000, 0, static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(mrc::optimize(c.surface, c.contour, c.options).ratio);
    state.counters["triangles"] = c.surface.triangle_count();
}

void surface(State& state) {
    const mrc_bench::Arrays arrays = mrc_bench::torus_arrays(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(mrc::Surface(arrays.view()).edge_count());
    state.counters["triangles"] = static_cast<double>(arrays.triangles.size() / 3);
}

/// Sixteen contours of one mesh, out of each other's reach, on so many threads.
void optimize_all(State& state) {
    mrc_bench::Row row = mrc_bench::contours_in_a_row(16, 1000, 1);
    row.options.threads = static_cast<int>(state.range(0));
    std::vector<mrc::Task> tasks;
    for (const mrc::Contour& contour : row.contours) tasks.push_back({contour, {}, {}});
    for (auto _ : state) benchmark::DoNotOptimize(mrc::optimize_all(row.surface, tasks, row.options));
}

}  // namespace

BENCHMARK(optimize)
    ->ArgNames({"faces", "k"})
    ->ArgsProduct({{250, 500, 1000, 2500, 5000, 10000, 20000}, {0, 1, 2}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(optimize_beside)->ArgName("triangles")->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(surface)->ArgName("triangles")->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(optimize_all)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
