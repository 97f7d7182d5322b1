// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_contour.h"

#include "flow_levels.h"
#include "segments.h"
#include "surface_point.h"

#include <algorithm>

namespace mrc {
namespace {

int face_of_segment(const Surface& surface, const SurfacePoint& p, const SurfacePoint& q) {
    if (const auto edge = shared_edge(p, q)) {
        const bool forward = edge->parameter(p) < edge->parameter(q);
        const int left = forward ? surface.find_halfedge(edge->a, edge->b) : surface.find_halfedge(edge->b, edge->a);
        if (left >= 0) return surface.halfedge_face(left);
    }
    const int triangle = triangle_of_segment(surface, p, q);
    return triangle < 0 ? -1 : surface.triangle_face(triangle);
}

}  // namespace

Contour trace_contour(const ContourGraph& graph, const Patch& patch, std::span<const int> nodes) {
    std::vector<int> points;
    if (!patch.closed) {
        Contour open{{graph.points[graph.chords[graph.chord_of(nodes.front())].tail].place}, false};
        for (const int node : nodes) open.points.push_back(graph.points[graph.chords[graph.chord_of(node)].head].place);
        return open;
    }
    // The last node of a closed path is the first again.
    for (const int node : nodes.first(nodes.size() - 1)) points.push_back(graph.chords[graph.chord_of(node)].head);
    const SurfacePoint first = vertex_point(patch.vertex[patch.contour[0]]);
    const double start = std::ranges::find(graph.points, first, &GraphPoint::place)->level;
    const auto behind = [&](int p) { return above(graph.points[p].level, start); };
    std::ranges::rotate(points, std::ranges::min_element(points, {}, behind));
    Contour contour;
    for (const int p : points) contour.points.push_back(graph.points[p].place);
    return contour;
}

std::vector<int> segment_faces(const Surface& surface, const Contour& contour) {
    std::vector<int> faces;
    for (const auto& [p, q] : segments(contour)) faces.push_back(face_of_segment(surface, p, q));
    return faces;
}

}  // namespace mrc
