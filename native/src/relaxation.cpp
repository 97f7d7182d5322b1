// SPDX-License-Identifier: GPL-3.0-or-later
#include "relaxation.h"

#include <algorithm>
#include <limits>

namespace mrc {
namespace {

/// The best path to node n: along one of its arcs or, with value `best`, from the source `start`. The solver spends most of its
/// time here, so the compiler must be able to inline it.
void relax_node(const WeightedGraph& graph, int n, double best, int start, Pass& pass) {
    int arc = -1;
    for (int a = graph.first_arc[n]; a < graph.first_arc[n + 1]; ++a) {
        const double reached = pass.value[graph.from[a]] + (graph.f[a] - pass.lambda * graph.g[a]);
        if (reached < best) {
            best = reached;
            arc = a;
        }
    }
    pass.value[n] = best;
    pass.last_arc[n] = arc;
    pass.origin[n] = arc >= 0 ? pass.origin[graph.from[arc]] : start;
}

}  // namespace

Relaxation::Relaxation(const WeightedGraph& graph, const Beat& beat)
    : graph_(graph), beat_(beat), start_(graph.node_count(), -1), potential_(graph.sources.size(), 0.0) {}

void Relaxation::run(const std::vector<int>& sources, double lambda) {
    ++passes_;
    if (beat_) beat_();
    pass_.lambda = lambda;
    pass_.value.resize(graph_.node_count());
    pass_.last_arc.resize(graph_.node_count());
    pass_.origin.resize(graph_.node_count());
    const auto value = [&](int i) { return graph_.sources[i].f - lambda * graph_.sources[i].g + potential_[i]; };
    for (const int i : sources) {
        int& start = start_[graph_.sources[i].node];
        if (start < 0 || value(i) < value(start)) start = i;
    }
    for (int n = 0; n < graph_.node_count(); ++n) {
        const int start = start_[n];
        relax_node(graph_, n, start >= 0 ? value(start) : std::numeric_limits<double>::infinity(), start, pass_);
    }
    for (const int i : sources) start_[graph_.sources[i].node] = -1;
}

bool Relaxation::own(int destination) const {
    return !graph_.matched || pass_.origin[graph_.destinations[destination].node] == destination;
}

Path Relaxation::path_to(int destination) const {
    const Terminal& end = graph_.destinations[destination];
    Path path{{end.node}, end.f, end.g};
    for (int a = pass_.last_arc[end.node]; a >= 0; a = pass_.last_arc[path.nodes.back()]) {
        path.f += graph_.f[a];
        path.g += graph_.g[a];
        path.nodes.push_back(graph_.from[a]);
    }
    const Terminal& source = graph_.sources[pass_.origin[end.node]];
    path.f += source.f;
    path.g += source.g;
    std::ranges::reverse(path.nodes);
    return path;
}

/// Potentials under which no path at all undercuts the threshold are shortest distances where each lap costs the threshold less:
/// a source starts where the last lap left its destination. They exist where no closed walk of several laps is too cheap; such a
/// walk crosses itself, and laps that exchange their ends where they cross are contours of their own.
bool Relaxation::lower_potentials(const std::vector<int>& pairs, double threshold) {
    bool lowered = false;
    for (const int i : pairs) {
        const double change = bound(pass_, i) - threshold;
        if (change >= 0.0) continue;
        potential_[i] += change;
        lowered = true;
    }
    return lowered;
}

}  // namespace mrc
