// SPDX-License-Identifier: GPL-3.0-or-later
#include "exclude_segments.h"

#include "segments.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace mrc {
namespace {

std::vector<char> closed_points(const Patch& patch, const Exclusion& exclusion, const AmbientGraph& ambient) {
    std::vector<char> closed(ambient.point_count(), 0);
    for (std::size_t v = 0; v < patch.vertex.size(); ++v) {
        if (ambient.point_of_vertex[v] >= 0) closed[ambient.point_of_vertex[v]] = exclusion.closed_vertex[v];
    }
    for (std::size_t e = 0; e < exclusion.closed_edge.size(); ++e) {
        const int first = ambient.first_point_of_edge[e];
        for (int i = 0; first >= 0 && i < ambient.steiner; ++i) closed[first + i] = exclusion.closed_edge[e];
    }
    return closed;
}

/// The surface's edges that no chord may cross or run along.
std::set<int> walls(const Surface& surface, const Patch& patch, const Exclusion& exclusion) {
    std::set<int> edges;
    for (int e = 0; e < static_cast<int>(exclusion.wall.size()); ++e) {
        // Both ends of an edge between two bands may be points that the given contours share: neither runs along it.
        if (exclusion.wall[e] || exclusion.closed_edge[e]) edges.insert(surface.edge(patch.edge_halfedge(e)));
    }
    return edges;
}

/// The segments of the contour's own places; its points are opened.
std::set<std::pair<int, int>> own_segments(const Patch& patch, const Exclusion& exclusion, const AmbientGraph& ambient,
                                           std::vector<char>& closed) {
    std::set<std::pair<int, int>> found;
    for (const Contour& own : exclusion.own) {
        std::vector<int> points;
        points.reserve(own.points.size());
        for (const SurfacePoint& p : own.points) points.push_back(ambient.point_at(patch, p));
        for (const int p : points) {
            if (p >= 0) closed[p] = 0;
        }
        for (const auto& [a, b] : segments(points, own.closed)) found.insert(std::minmax(a, b));
    }
    return found;
}

}  // namespace

void exclude_segments(const Surface& surface, const Patch& patch, const Exclusion& exclusion, AmbientGraph& ambient) {
    if (exclusion.closed_vertex.empty()) return;
    std::vector<char> closed = closed_points(patch, exclusion, ambient);
    const auto own = own_segments(patch, exclusion, ambient, closed);
    const std::set<int> wall = walls(surface, patch, exclusion);
    for (Segment& s : ambient.segments) {
        const bool crossed = s.halfedge >= 0 && wall.contains(surface.edge(s.halfedge));
        if ((closed[s.a] || closed[s.b] || crossed) && !own.contains(std::minmax(s.a, s.b))) s.walkable = false;
    }
}

}  // namespace mrc
