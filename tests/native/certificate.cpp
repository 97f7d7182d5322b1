// SPDX-License-Identifier: GPL-3.0-or-later
#include "certificate.h"

#include <cmath>
#include <limits>

namespace mrc_test {
namespace {

using mrc::Terminal;
using mrc::WeightedGraph;

constexpr double rounding = 1e-12;  // relative to the size of what was summed

struct Sums {
    double f, g;
    double size;  ///< sum of |f|

    Sums with(double more_f, double more_g) const { return {f + more_f, g + more_g, size + std::abs(more_f)}; }
};

bool same(const Sums& sums, double numerator, double length) {
    return std::abs(sums.f - numerator) <= rounding * sums.size && std::abs(sums.g - length) <= rounding * sums.g;
}

/// The sums of all walks over these nodes: more than one where parallel arcs leave a choice.
std::vector<Sums> walks(const WeightedGraph& graph, const std::vector<int>& nodes, const Sums& start) {
    std::vector<Sums> here{start};
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        std::vector<Sums> next;
        for (int a = graph.first_arc[nodes[i]]; a < graph.first_arc[nodes[i] + 1]; ++a) {
            if (graph.from[a] != nodes[i - 1]) continue;
            for (const Sums& sums : here) next.push_back(sums.with(graph.f[a], graph.g[a]));
        }
        here = std::move(next);
    }
    return here;
}

/// A sum of f - lambda g, with the sum of the absolute values that were added to it.
struct Reduced {
    double value = std::numeric_limits<double>::infinity();
    double size = 0.0;

    Reduced with(double f, double g, double lambda) const {
        return {value + (f - lambda * g), size + std::abs(f) + std::abs(lambda * g)};
    }
};

/// The least f - lambda g from each node to a destination.
std::vector<Reduced> relaxed_from(const WeightedGraph& graph, const Terminal& end, double lambda) {
    std::vector<Reduced> least(graph.node_count());
    least[end.node] = Reduced{0.0}.with(end.f, end.g, lambda);
    for (int n = end.node; n >= 0; --n) {
        for (int a = graph.first_arc[n]; a < graph.first_arc[n + 1]; ++a) {
            const Reduced through = least[n].with(graph.f[a], graph.g[a], lambda);
            if (through.value < least[graph.from[a]].value) least[graph.from[a]] = through;
        }
    }
    return least;
}

/// The first pair with a path of F - lambda L < 0, or, where no path is claimed to exist, with any path.
std::string better_pair(const WeightedGraph& graph, const mrc::RatioResult& result) {
    for (std::size_t j = 0; j < graph.destinations.size(); ++j) {
        const std::vector<Reduced> least = relaxed_from(graph, graph.destinations[j], result.objective);
        for (std::size_t i = 0; i < graph.sources.size(); ++i) {
            if (graph.matched && i != j) continue;
            const Terminal& source = graph.sources[i];
            const Reduced path = least[source.node].with(source.f, source.g, result.objective);
            if (!std::isfinite(path.value) || (result.found && path.value >= -rounding * path.size)) continue;
            return "source " + std::to_string(i) + " and destination " + std::to_string(j) + " have a better path";
        }
    }
    return "";
}

}  // namespace

bool is_path(const WeightedGraph& graph, const std::vector<int>& nodes, double numerator, double length) {
    if (nodes.empty()) return false;
    for (std::size_t i = 0; i < graph.sources.size(); ++i) {
        if (graph.sources[i].node != nodes.front()) continue;
        for (std::size_t j = 0; j < graph.destinations.size(); ++j) {
            const Terminal &source = graph.sources[i], &end = graph.destinations[j];
            if (end.node != nodes.back() || (graph.matched && i != j)) continue;
            const Sums start = Sums{0.0, 0.0, 0.0}.with(source.f, source.g).with(end.f, end.g);
            for (const Sums& sums : walks(graph, nodes, start)) {
                if (same(sums, numerator, length)) return true;
            }
        }
    }
    return false;
}

std::string objection(const WeightedGraph& graph, const mrc::RatioResult& result) {
    if (!result.found) return better_pair(graph, result);
    if (!is_path(graph, result.nodes, result.numerator, result.length)) return "the path is none of the graph with these sums";
    const auto differs = [](double a, double b) { return !(std::abs(a - b) <= rounding * std::abs(b)); };
    if (differs(result.objective, result.numerator / result.length)) return "the objective is not the path's";
    if (differs(result.lower_bound, result.objective)) return "the gap is open";
    return better_pair(graph, result);
}

}  // namespace mrc_test
