// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
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
    bool matched = true;         ///< true: source i goes with destination i alone; false: any with any

    int node_count() const { return static_cast<int>(first_arc.size()) - 1; }
    int arc_count() const { return static_cast<int>(from.size()); }
};

struct RatioOptions {
    /// Only paths below this ratio are of interest; infinity: any.
    double below = std::numeric_limits<double>::infinity();
};

struct RatioResult {
    bool found = false;         ///< a path below `below` exists
    std::vector<int> nodes;     ///< of the best path, from source to destination
    double numerator = 0.0, length = 0.0, ratio = 0.0;
    double lower_bound = 0.0;   ///< no path of the graph has a lower ratio (where found is false: than `below`)
    int passes = 0;             ///< relaxations of the graph
    int steps = 0;              ///< times that lambda fell
};

/// The path of least sum f / sum g over all source and destination pairs (eq. 4.3), exactly.
///
/// Dinkelbach's descent on lambda with one lambda for all sources, and branch and bound over the set of sources: one relaxation
/// from a set of sources at once bounds every pair of the set from below. A pair whose bound is not negative at the current lambda
/// is out for good, since lambda only falls; what is left is split.
RatioResult minimum_ratio(const WeightedGraph& graph, const RatioOptions& options = {});

}  // namespace mrc
