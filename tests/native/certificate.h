// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.h"

#include <string>
#include <vector>

namespace mrc_test {

/// True where some walk along the graph's arcs visits these nodes from a source to its destination and has these sums.
bool is_path(const mrc::WeightedGraph& graph, const std::vector<int>& nodes, double numerator, double length);

/// Checks a result of the plain ratio without the solver: that its path is one of the graph with the sums and the ratio it names, that
/// the gap is closed, and, with one relaxation for every destination at lambda = its objective, that no pair has a path with
/// F - lambda L < 0, that is one of less ratio.
/// @return what speaks against the result as the optimum of this graph; empty: nothing.
std::string objection(const mrc::WeightedGraph& graph, const mrc::RatioResult& result);

}  // namespace mrc_test
