// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ambient_graph.h"
#include "graph.h"

#include <vector>

namespace mrc {

/// What a contour graph is made from.
struct GraphInput {
    const Surface& surface;
    const Patch& patch;
    const Band& band;
    const Energy& energy;
    const Options& options;
    const Constraints& constraints;
    const Exclusion& exclusion;
    const AmbientGraph& ambient;
    const std::vector<SurfacePoint>& given;  ///< the given contour, with the graph's own points along edges
};

}  // namespace mrc
