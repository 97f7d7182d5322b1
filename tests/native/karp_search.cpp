// SPDX-License-Identifier: GPL-3.0-or-later
#include "karp_search.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace mrc_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One step of eq. A.3: from paths of l arcs to those of l + 1.
std::vector<double> lengthened(const mrc::WeightedGraph& graph, const std::vector<double>& last) {
    std::vector<double> next(graph.node_count(), infinity);
    for (int n = 0; n < graph.node_count(); ++n) {
        for (int a = graph.first_arc[n]; a < graph.first_arc[n + 1]; ++a)
            next[n] = std::min(next[n], last[graph.from[a]] + graph.f[a]);
    }
    return next;
}

}  // namespace

double karp_search(const mrc::WeightedGraph& graph, const mrc::Objective& objective) {
    double best = infinity;
    for (std::size_t i = 0; i < graph.sources.size(); ++i) {
        const mrc::Terminal& source = graph.sources[i];
        std::vector<double> least(graph.node_count(), infinity);
        least[source.node] = source.f;
        for (int arcs = 0; std::ranges::any_of(least, [](double f) { return f < infinity; }); ++arcs) {
            for (std::size_t j = 0; j < graph.destinations.size(); ++j) {
                const mrc::Terminal& end = graph.destinations[j];
                if ((graph.matched && i != j) || least[end.node] == infinity) continue;
                best = std::min(best, objective.value(least[end.node] + end.f, arcs + source.g + end.g));
            }
            least = lengthened(graph, least);
        }
    }
    return best;
}

}  // namespace mrc_test
