// SPDX-License-Identifier: GPL-3.0-or-later
#include "brute_force.h"

namespace mrc_test {
namespace {

class Walk {
  public:
    Walk(const mrc::WeightedGraph& graph, const mrc::Objective& objective) : graph_(graph), objective_(objective) {}

    BestPath run() {
        for (destination_ = 0; destination_ < static_cast<int>(graph_.destinations.size()); ++destination_) {
            const mrc::Terminal& end = graph_.destinations[destination_];
            visit(end.node, end.f, end.g);
        }
        return best_;
    }

  private:
    const mrc::WeightedGraph& graph_;
    const mrc::Objective& objective_;
    int destination_ = 0;
    BestPath best_;

    void visit(int node, double f, double g) {
        for (int i = 0; i < static_cast<int>(graph_.sources.size()); ++i) {
            const mrc::Terminal& source = graph_.sources[i];
            if (source.node == node && (!graph_.matched || i == destination_)) finish(i, f + source.f, g + source.g);
        }
        for (int a = graph_.first_arc[node]; a < graph_.first_arc[node + 1]; ++a)
            visit(graph_.from[a], f + graph_.f[a], g + graph_.g[a]);
    }

    void finish(int source, double f, double g) {
        const double value = objective_.value(f, g);
        if (value < best_.objective) best_ = {value, f, g, source, destination_};
    }
};

}  // namespace

BestPath brute_force(const mrc::WeightedGraph& graph, const mrc::Objective& objective) { return Walk(graph, objective).run(); }

}  // namespace mrc_test
