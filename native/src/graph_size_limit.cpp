// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph_size_limit.h"

#include "number_text.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <unistd.h>
#endif

#include <cmath>
#include <fstream>
#include <string>

namespace mrc {
namespace {

double free_bytes() {
#ifdef _WIN32
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof(status);
    return GlobalMemoryStatusEx(&status) ? static_cast<double>(status.ullAvailPhys) : HUGE_VAL;
#else
    // What Linux can hand out, page cache included; elsewhere all that is built in.
    std::ifstream file("/proc/meminfo");
    for (std::string name; file >> name; file.ignore(1000, '\n')) {
        double kilobytes = 0.0;
        if (name == "MemAvailable:" && file >> kilobytes) return 1024.0 * kilobytes;
    }
    return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
#endif
}

}  // namespace

// A triangle has 3 k^2 + 3 k chords inside and k + 1 on each side, which two triangles share (3.2); each is a node once. Arcs a
// node were counted on real bands: about 2 for k = 0 and one more for each further k.
void check_graph_size(double triangles, int steiner, double (*free_bytes)()) {
    const double k = steiner;
    const double nodes = triangles * (3.0 * k * k + 4.5 * k + 1.5), arcs = nodes * (2.0 + 1.25 * k);
    const double bytes = 200.0 * nodes + 24.0 * arcs;
    constexpr double always_there = 1e8;
    if (bytes < always_there || (arcs < 2147483648.0 && bytes < free_bytes())) return;
    throw TooLarge("the graph would have about " + number_text(nodes, 3) + " nodes and " + number_text(arcs, 3) +
                   " arcs and need " + number_text(bytes / 1e9, 3) + " GB: lower refinement (now " + std::to_string(steiner) +
                   ") or width");
}

void check_graph_size(double triangles, int steiner) { check_graph_size(triangles, steiner, free_bytes); }

}  // namespace mrc
