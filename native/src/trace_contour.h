// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "graph.h"

#include <span>

namespace mrc {

/// The surface points of a path of the graph. A closed contour starts at the point next along the flow after the given
/// contour's first, so that it does not depend on where the graph was cut.
Contour trace_contour(const ContourGraph& graph, const Patch& patch, std::span<const int> nodes);

/// A polygon that holds each segment of a contour; of the two along an edge, the left one.
std::vector<int> segment_faces(const Surface& surface, const Contour& contour);

}  // namespace mrc
