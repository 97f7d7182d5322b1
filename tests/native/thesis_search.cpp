// SPDX-License-Identifier: GPL-3.0-or-later
#include "thesis_search.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace mrc_test {
namespace {

struct Path {
    std::vector<int> nodes;
    double f = 0.0, g = 0.0;
    double ratio() const { return f / g; }
};

/// The shortest path between two nodes in the weights f - lambda g (Bellman and Ford; one sweep, since the graph is acyclic).
std::optional<Path> shortest_path(const mrc::WeightedGraph& graph, const mrc::Terminal& s, const mrc::Terminal& t, double lambda) {
    std::vector<double> distance(graph.node_count(), std::numeric_limits<double>::infinity());
    std::vector<int> through(graph.node_count(), -1);
    distance[s.node] = 0.0;
    for (int n = 0; n < graph.node_count(); ++n) {
        for (int a = graph.first_arc[n]; a < graph.first_arc[n + 1]; ++a) {
            const double d = distance[graph.from[a]] + graph.f[a] - lambda * graph.g[a];
            if (n != s.node && d < distance[n]) {
                distance[n] = d;
                through[n] = a;
            }
        }
    }
    if (distance[t.node] == std::numeric_limits<double>::infinity()) return std::nullopt;
    Path path{{t.node}, s.f + t.f, s.g + t.g};
    while (path.nodes.back() != s.node) {
        const int a = through[path.nodes.back()];
        path.f += graph.f[a];
        path.g += graph.g[a];
        path.nodes.push_back(graph.from[a]);
    }
    std::ranges::reverse(path.nodes);
    return path;
}

/// Linear search: from a path's ratio to that of the shortest path there, until it stays.
void solve_pair(const mrc::WeightedGraph& graph, const mrc::Terminal& s, const mrc::Terminal& t, bool share, LinearSearch& best) {
    ++best.pairs;
    std::optional<Path> found;
    double lambda = share && best.found ? best.ratio : 0.0;
    for (int steps = 1;; ++steps) {
        const auto path = shortest_path(graph, s, t, lambda);
        ++best.passes;
        best.max_steps = std::max(best.max_steps, steps);
        if (!path) return;
        const bool first = !found && !(share && best.found);
        if (!first && !(path->ratio() < lambda)) break;
        found = path;
        lambda = path->ratio();
    }
    if (found && (!best.found || found->ratio() < best.ratio)) {
        best.found = true;
        best.ratio = found->ratio();
        best.nodes = found->nodes;
    }
}

LinearSearch search(const mrc::WeightedGraph& graph, bool share) {
    LinearSearch best;
    for (std::size_t i = 0; i < graph.sources.size(); ++i) {
        for (std::size_t j = 0; j < graph.destinations.size(); ++j) {
            if (graph.matched && i != j) continue;
            solve_pair(graph, graph.sources[i], graph.destinations[j], share, best);
        }
    }
    return best;
}

}  // namespace

LinearSearch thesis_search(const mrc::WeightedGraph& graph) { return search(graph, false); }
LinearSearch shared_lambda_search(const mrc::WeightedGraph& graph) { return search(graph, true); }

}  // namespace mrc_test
