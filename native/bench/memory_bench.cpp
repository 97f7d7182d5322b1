// SPDX-License-Identifier: GPL-3.0-or-later
// The exact peak of heap memory during a call, counted by this program's own malloc, which all libraries in it use. It is a separate
// program so that counting does not slow down the other benchmarks.
#include "cases.h"

#include <benchmark/benchmark.h>

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>

extern "C" {
// The functions of glibc, under the names that it exports for programs with their own malloc.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}

namespace {

std::atomic<std::ptrdiff_t> live = 0, peak = 0;

void* counted(void* block) {
    const std::ptrdiff_t now = live += static_cast<std::ptrdiff_t>(malloc_usable_size(block));
    std::ptrdiff_t before = peak;
    while (now > before && !peak.compare_exchange_weak(before, now)) {
    }
    return block;
}

void forget(void* block) { live -= static_cast<std::ptrdiff_t>(malloc_usable_size(block)); }

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept { return counted(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) noexcept { return counted(__libc_calloc(count, size)); }
void* memalign(std::size_t alignment, std::size_t size) noexcept { return counted(__libc_memalign(alignment, size)); }
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }
int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
    *block = memalign(alignment, size);
    return *block ? 0 : ENOMEM;
}
void* realloc(void* block, std::size_t size) noexcept {
    const std::size_t old = malloc_usable_size(block);
    void* moved = __libc_realloc(block, size);
    if (moved || size == 0) live -= static_cast<std::ptrdiff_t>(old);
    return moved ? counted(moved) : nullptr;
}
void free(void* block) noexcept {
    forget(block);
    __libc_free(block);
}

}  // extern "C"

namespace {

/// Bytes at the peak of a call, beyond those allocated before. The second call is measured, since the first fills permanent caches.
void memory(benchmark::State& state) {
    const mrc_bench::Case c = mrc_bench::tube_case(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    mrc::optimize(c.surface, c.contour, c.options);
    mrc::Statistics statistics;
    const std::ptrdiff_t before = live;
    peak = before;
    for (auto _ : state) statistics = mrc::optimize(c.surface, c.contour, c.options).statistics;
    const auto bytes = static_cast<double>(peak - before);
    state.counters["faces"] = statistics.faces;
    state.counters["arcs"] = statistics.arcs;
    state.counters["bytes"] = bytes;
    state.counters["bytes_per_arc"] = bytes / statistics.arcs;
}

}  // namespace

BENCHMARK(memory)
    ->ArgNames({"faces", "k"})
    ->ArgsProduct({{1000, 5000, 20000}, {0, 1, 2}})
    ->Iterations(1)
    ->Repetitions(1)
    ->Unit(benchmark::kMillisecond);
