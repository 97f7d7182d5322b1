// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "incumbent.h"
#include "ratio.h"

#include <vector>

namespace mrc {

/// What one relaxation of the graph gives: for every node, the path of least f - lambda g from any of a set of sources.
struct Pass {
    double lambda = 0.0;
    std::vector<double> value;  ///< of each node: the least f - lambda g, with the potential of its source
    std::vector<int> last_arc;  ///< of each node: the last arc of that path; -1 at a source
    std::vector<int> origin;    ///< of each node: the source of that path

    /// The least F - lambda L of all paths that end as `rest` does, from its node on.
    double bound(const Terminal& rest) const { return value[rest.node] + (rest.f - lambda * rest.g); }
};

/// Bellman's relaxation [9], which is linear in topological order, with a potential for each pair of source and destination.
///
/// What goes from one pair's source to another pair's destination bounds both, though neither may go there. A potential, added at
/// a pair's source and taken off at its destination, leaves the pair's own paths as they are and moves those between pairs.
class Relaxation {
  public:
    Relaxation(const WeightedGraph& graph, const Beat& beat);

    /// One pass from a set of sources.
    void run(const std::vector<int>& sources, double lambda);

    const Pass& last() const { return pass_; }
    Pass take_last() { return std::move(pass_); }
    int passes() const { return passes_; }

    /// What a pass says of F - lambda L of all paths of a pair: none is lower. Infinite where none arrives.
    double bound(const Pass& pass, int destination) const {
        return pass.bound(graph_.destinations[destination]) - potential(destination);
    }
    /// Whether the last pass's path to a destination starts where it should: then its bound is a path of the pair.
    bool own(int destination) const;
    /// The last pass's path to a destination.
    Path path_to(int destination) const;

    double potential(int destination) const { return graph_.matched ? potential_[destination] : 0.0; }
    void clear_potential(int source) { potential_[source] = 0.0; }
    /// Lowers the potentials of the pairs that the last pass bounds below a threshold; false where there are none.
    bool lower_potentials(const std::vector<int>& pairs, double threshold);

  private:
    const WeightedGraph& graph_;
    const Beat& beat_;
    std::vector<int> start_;         // of each node: the best source there of the set at work, or -1
    std::vector<double> potential_;  // of each pair
    Pass pass_;
    int passes_ = 0;
};

}  // namespace mrc
