// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "band.h"
#include "flow.h"
#include "graph.h"
#include "patch.h"

#include <mrc/constraints.h>
#include <mrc/options.h>
#include <mrc/scales.h>

namespace mrc {

/// All that one search of this width and refinement builds, for display and for tests.
struct SearchSpace {
    Patch patch;
    Band band;
    Flow flow;
    ContourGraph graph;
};
/// Where `progress` cancels, it is empty.
/// @throws what `optimize` does.
SearchSpace search_space(const Surface& surface, const Contour& contour, const Options& options = {},
                         const Constraints& constraints = {}, const std::optional<Scales>& scales = std::nullopt,
                         const Progress& progress = {});

}  // namespace mrc
