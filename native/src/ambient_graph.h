// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flow_levels.h"

#include "flow.h"

#include <unordered_map>
#include <vector>

namespace mrc {

/// The ambient graph of a band, regular (3.1) or refined (3.2): points, and the undirected segments between them.
struct AmbientGraph {
    int steiner = 0;                   ///< k, the Steiner points of an edge
    std::vector<SurfacePoint> places;  ///< of each point: the band's vertices, then the Steiner points
    std::vector<double> ranks;         ///< signed distance from the given contour, positive on its left
    std::vector<double> values;        ///< of the flow; where it is level, made equal
    std::vector<Segment> segments;
    std::vector<int> point_of_vertex;      ///< of each patch vertex, -1 outside the band
    std::vector<int> first_point_of_edge;  ///< of each patch edge: its Steiner points follow each other; -1: none
    std::unordered_map<int, int> local;    ///< patch vertex of each surface vertex of the band

    int point_count() const { return static_cast<int>(places.size()); }
    /// The point at a place on the surface, or -1.
    int point_at(const Patch& patch, const SurfacePoint& place) const;
};

AmbientGraph make_ambient_graph(const Patch& patch, const Band& band, const Flow& flow, int steiner);

}  // namespace mrc
