// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_obstacles.h"

#include <algorithm>

namespace mrc {
namespace {

/// A diagonal that joins the same vertices as another edge would be one edge with it in the patch's mesh.
bool has_shared_diagonal(const Surface& surface, int face) {
    const int begin = 3 * surface.first_triangle(face), end = 3 * surface.first_triangle(face + 1);
    for (int h = begin; h < end; ++h) {
        if (!surface.diagonal(h)) continue;
        const auto same = [&](int other) { return surface.to(other) == surface.to(h); };
        if (std::ranges::count_if(surface.outgoing(surface.from(h)), same) > 1) return true;
        if (surface.real_edge(surface.from(h), surface.to(h))) return true;
    }
    return false;
}

}  // namespace

bool usable_face(const Surface& surface, int face) {
    if (surface.hidden(face)) return false;
    const auto vertices = surface.face(face);
    if (!std::ranges::all_of(vertices, [&](int v) { return surface.regular(v); })) return false;
    return vertices.size() == 3 || !has_shared_diagonal(surface, face);
}

std::optional<Obstacle> obstacle(const Surface& surface, int halfedge) {
    if (halfedge == Surface::border) return Obstacle{ErrorCode::on_border, "on the border of the mesh", {}};
    if (halfedge == Surface::irregular)
        return Obstacle{ErrorCode::non_manifold, "on an edge of more than two faces, or of two whose normals disagree", {}};
    const int face = surface.halfedge_face(halfedge);
    if (surface.hidden(face))
        return Obstacle{ErrorCode::hidden_face, "beside the hidden face " + std::to_string(face), Element::face(face)};
    for (const int v : surface.face(face)) {
        if (surface.regular(v)) continue;
        return Obstacle{ErrorCode::non_manifold,
                        "beside vertex " + std::to_string(v) + ", which is non-manifold or has faces whose normals disagree",
                        Element::vertex(v)};
    }
    if (usable_face(surface, face)) return std::nullopt;
    return Obstacle{ErrorCode::non_manifold,
                    "beside face " + std::to_string(face) + ", two opposite corners of which another edge or face also joins",
                    Element::face(face)};
}

std::optional<Obstacle> obstacle(const Surface& surface, int a, int b) {
    const int halfedge = surface.find_edge(a, b), twin = surface.twin(halfedge);
    if (twin < 0) return obstacle(surface, twin);
    const std::optional<Obstacle> left = obstacle(surface, halfedge), right = obstacle(surface, twin);
    return left && right ? left : std::nullopt;
}

}  // namespace mrc
