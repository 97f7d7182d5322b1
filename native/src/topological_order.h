// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "directed_segments.h"
#include "graph.h"

#include <vector>

namespace mrc {

/// The numbers of the chords in topological order: by the flow's level at the tail, and last what crosses the cut, by rank.
/// Among those that leave one level, level chords come first, each kind by rank in its own direction.
std::vector<int> topological_order(const std::vector<GraphPoint>& points, const std::vector<DirectedSegment>& directed,
                                   const Beat& beat);

}  // namespace mrc
