// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "beat.h"
#include "objective.h"

#include <optional>
#include <vector>

namespace mrc {

/// A node where paths may start or end, with weights of its own that count once.
struct Terminal {
    int node = -1;
    double f = 0.0, g = 0.0;
};

/// An acyclic graph whose arcs carry (f, g), in topological order: every arc enters a later node. The solver knows nothing else.
struct WeightedGraph {
    std::vector<int> first_arc;  ///< arcs into node n: first_arc[n] up to first_arc[n + 1]
    std::vector<int> from;       ///< the node that each arc leaves
    std::vector<double> f, g;    ///< of each arc; g > 0
    std::vector<Terminal> sources, destinations;
    bool matched = true;  ///< true: source i goes with destination i alone; false: any with any

    int node_count() const { return static_cast<int>(first_arc.size()) - 1; }
    int arc_count() const { return static_cast<int>(from.size()); }
};

struct RatioOptions {
    Objective objective;
    /// A path like this is expected: it sets where the search begins, and nothing else.
    std::optional<Terminal> guess = {};
    /// The search for paths above the lower hull gives up after so many labels, and reports the gap that is left; where lengths
    /// are counts it never needs to (A.3).
    int most_labels = 1'000'000;
    Beat beat = {};  ///< called at every pass and every few labels
};

struct RatioResult {
    bool found = false;      ///< false: no destination can be reached from its source
    std::vector<int> nodes;  ///< of the best path, from source to destination
    double numerator = 0.0, length = 0.0;
    double objective = 0.0;
    double lower_bound = 0.0;  ///< no path has a lower objective
    int passes = 0;            ///< relaxations of the graph
    int steps = 0;             ///< times that the best path was replaced
    int labels = 0;            ///< partial paths met above the lower hull; 0 for the plain ratio
};

/// The path of least objective over all source and destination pairs, exactly.
///
/// Dinkelbach's descent on lambda with one incumbent for all sources, and branch and bound over the set of sources: one
/// relaxation from a set of sources at once bounds every pair of the set from below. A pair whose bound is not below the
/// threshold at the current lambda is out for good, since the best only improves. Potentials at the sources tighten the bounds of
/// what is left; a set that they do not decide is split. With a bias the optimum of a pair may lie above its lower hull: then the
/// partial paths whose bounds beat the best are searched one by one.
RatioResult minimum_ratio(const WeightedGraph& graph, const RatioOptions& options = {});

}  // namespace mrc
