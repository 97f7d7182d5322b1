// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_contour.h"

#include "flow_levels.h"
#include "surface_point.h"

#include <algorithm>

namespace mrc {
namespace {

/// The polygons round a vertex or beside an edge.
std::vector<int> faces_at(const Surface& surface, const SurfacePoint& point) {
    std::vector<int> faces;
    for (const int h : surface.outgoing(point.a)) {
        if (point.is_vertex() || surface.to(h) == point.b) faces.push_back(surface.halfedge_face(h));
    }
    if (point.is_vertex()) return faces;
    for (const int h : surface.outgoing(point.b)) {
        if (surface.to(h) == point.a) faces.push_back(surface.halfedge_face(h));
    }
    return faces;
}

int face_of_segment(const Surface& surface, const SurfacePoint& p, const SurfacePoint& q) {
    if (const SharedEdge edge(p, q); edge.a >= 0) {
        const bool forward = edge.parameter(p) < edge.parameter(q);
        const int left = forward ? surface.find_halfedge(edge.a, edge.b) : surface.find_halfedge(edge.b, edge.a);
        if (left >= 0) return surface.halfedge_face(left);
    }
    const std::vector<int> candidates = faces_at(surface, q);
    for (const int face : faces_at(surface, p)) {
        if (std::ranges::find(candidates, face) != candidates.end()) return face;
    }
    return -1;
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
    const std::size_t count = contour.points.size();
    for (std::size_t i = 0; i + (contour.closed ? 0 : 1) < count; ++i) {
        faces.push_back(face_of_segment(surface, contour.points[i], contour.points[(i + 1) % count]));
    }
    return faces;
}

}  // namespace mrc
