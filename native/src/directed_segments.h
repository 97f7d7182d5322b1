// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ambient_graph.h"
#include "graph.h"

#include <cstdint>
#include <vector>

namespace mrc {

enum class Climb : std::uint8_t { rising = 1, falling = 2, along = 3 };  // level chords by rank, and those that the flow runs along

inline int sign(Climb climb) { return climb == Climb::rising ? 1 : climb == Climb::falling ? -1 : 0; }

/// A segment of the ambient graph in the direction of the flow: a chord before the chords are sorted.
struct DirectedSegment {
    int tail, head;
    double increment;
    int segment;
    bool crosses;  ///< the level, at most once
    Climb climb;
};

/// Each walkable segment becomes the chord that the flow runs along; a level one becomes two, by rank; of equal rank, none.
/// `level`: the flow's value at the cut; `points` have their levels above it.
std::vector<DirectedSegment> direct_segments(const Surface& surface, const AmbientGraph& ambient,
                                             const std::vector<GraphPoint>& points, bool closed, double level);

}  // namespace mrc
