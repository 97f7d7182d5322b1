// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.h"

#include <limits>

namespace mrc_test {

struct BestPath {
    double objective = std::numeric_limits<double>::infinity();  ///< infinity: there is no path
    double numerator = 0.0, length = 0.0;
    int source = -1, destination = -1;
};

/// The path of least objective, by walking every path backwards from its destination.
BestPath brute_force(const mrc::WeightedGraph& graph, const mrc::Objective& objective = {});

}  // namespace mrc_test
