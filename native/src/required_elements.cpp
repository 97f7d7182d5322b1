// SPDX-License-Identifier: GPL-3.0-or-later
#include "required_elements.h"

#include "surface_point.h"

namespace mrc {

bool has_required_elements(const Contour& contour, const Constraints& constraints) {
    const std::size_t count = contour.points.size();
    const auto passes = [&](int v) { return std::ranges::find(contour.points, vertex_point(v)) != contour.points.end(); };
    const auto runs_along = [&](const std::array<int, 2>& ends) {
        const DirectedEdge edge{ends[0], ends[1]};
        // From one end to the other without leaving the edge.
        for (std::size_t i = 0; i < count; ++i) {
            if (!contour.points[i].is_vertex() || !edge.holds(contour.points[i])) continue;
            for (std::size_t j = i + 1; j < i + count && (contour.closed || j < count); ++j) {
                const SurfacePoint& p = contour.points[j % count];
                if (!edge.holds(p)) break;
                if (p.is_vertex()) return true;
            }
        }
        return false;
    };
    return std::ranges::all_of(constraints.required_vertices, passes) &&
           std::ranges::all_of(constraints.required_edges, runs_along);
}

}  // namespace mrc
