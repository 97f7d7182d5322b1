// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "directed_segments.h"
#include "graph.h"
#include "required_elements.h"

#include <vector>

namespace mrc {

/// What the arcs need to know of a chord besides its ends.
struct ChordSite {
    int halfedge;    ///< of the surface, that the chord lies on, or -1
    int triangle;    ///< of the patch, that it lies inside, or -1
    int given = -1;  ///< its place in the given contour, where that runs along it
    Climb climb = Climb::along;
};

/// The chords of a graph in topological order with all that decides which of them join.
struct Chords {
    const std::vector<GraphPoint>& points;
    const std::vector<Chord>& chords;
    const std::vector<ChordSite>& sites;
    int crossing;     ///< the last so many cross the level
    int given_count;  ///< points of the given contour
    const RequiredElements& required_elements;
};

/// The line graph of 3.1: chords are its nodes, and an arc joins each to those that start where it ends, weighed by eq. 3.1 and
/// 3.2. Chords that cross the level come twice, first as sources and last as destinations.
WeightedGraph make_line_graph(const Surface& surface, const Chords& chords, const Energy& energy, const EdgeForm* region,
                              const Beat& beat);

}  // namespace mrc
