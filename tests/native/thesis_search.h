// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.h"

namespace mrc_test {

struct LinearSearch {
    double ratio = 0.0;
    std::vector<int> nodes;
    int pairs = 0;      ///< minimum ratio path problems solved
    int max_steps = 0;  ///< most linear search steps of one problem
    int passes = 0;     ///< relaxations of the graph
    bool found = false;
};

/// The thesis's own search (4.2.4, 4.2.5): for every source and its destination one minimum ratio path problem, each by a linear
/// search on lambda, each step of which is one relaxation of the whole graph. Slow and simple: the independent check.
LinearSearch thesis_search(const mrc::WeightedGraph& graph);

/// The same with one lambda shared by all pairs, but without bounds.
LinearSearch shared_lambda_search(const mrc::WeightedGraph& graph);

}  // namespace mrc_test
