// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.h"

namespace mrc_test {

/// Karp's dynamic program for the minimum mean path with length (appendix A, eq. A.3): the least sum of f over the paths of exactly
/// l arcs, for every l and every node, from one source after the other. All g must be 1. It takes O(n m) for each source, and is
/// the independent check of the search by counts.
/// @return the least objective over all source and destination pairs; infinity where there is no path.
double karp_search(const mrc::WeightedGraph& graph, const mrc::Objective& objective);

}  // namespace mrc_test
