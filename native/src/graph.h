// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "energy.h"
#include "exclusion.h"
#include "flow.h"
#include "ratio.h"
#include "region.h"

#include <array>
#include <span>
#include <vector>

namespace mrc {

/// A point of the graph: a vertex of the patch, or one of its edges' Steiner points.
struct GraphPoint {
    SurfacePoint place;  ///< on the surface
    double level = 0.0;  ///< its flow value above the cut, in [0, 1)
    double rank = 0.0;   ///< signed distance along the surface from the given contour, positive on its left
};

/// A directed segment between two points of a triangle's border, which the flow runs along: a node of the graph.
struct Chord {
    int tail = -1, head = -1;  ///< points
    double increment = 0.0;    ///< of the flow, 0 for a level chord
};

/// The acyclic graph of 4.2.3 over the regular (3.1) or the refined (3.2) ambient graph of a band.
///
/// Any level of the flow is a cut: a closed contour crosses it exactly once. Chords that cross it appear twice, as source and as
/// destination.
struct ContourGraph {
    std::vector<GraphPoint> points;
    std::vector<Chord> chords;  ///< in topological order, the crossing ones last
    int crossing = 0;           ///< how many chords cross the level: the size of the cut
    double level = 0.0;         ///< the flow's value at the cut
    WeightedGraph search;       ///< sources first, then the chords from 0 on

    int chord_of(int node) const { return node < crossing ? static_cast<int>(chords.size()) - crossing + node : node - crossing; }
};

/// `region`: the form of the region term, if there is one.
/// `steiner`: k, the Steiner points put on each edge; 0: contours keep to mesh edges.
ContourGraph make_graph(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow, const Energy& energy,
                        const Options& options, const Constraints& constraints, int steiner, const EdgeForm* region = nullptr,
                        const Exclusion& exclusion = {}, const Beat& beat = {});

}  // namespace mrc
