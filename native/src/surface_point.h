// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <optional>

namespace mrc {

/// The same contour with t = 0 and t = 1 written as vertices.
Contour normalized(const Contour& contour);

/// An edge or a diagonal, in the direction from a to b.
struct DirectedEdge {
    int a, b;

    /// True for the ends of the edge and the points between them.
    bool holds(const SurfacePoint& p) const { return (p.a == a || p.a == b) && (p.b == a || p.b == b); }
    /// Where a point of the edge lies on it: from 0 at a to 1 at b.
    double parameter(const SurfacePoint& p) const {
        if (p.is_vertex()) return p.a == a ? 0.0 : 1.0;
        return p.a == a ? p.t : 1.0 - p.t;
    }
};

inline DirectedEdge directed_edge(const Surface& surface, int halfedge) { return {surface.from(halfedge), surface.to(halfedge)}; }

/// The edge that holds both points. Two vertices always have one, whether or not the surface has it.
inline std::optional<DirectedEdge> shared_edge(const SurfacePoint& p, const SurfacePoint& q) {
    const int second = p.is_vertex() ? (q.is_vertex() || q.a != p.a ? q.a : q.b) : p.b;
    const DirectedEdge edge{p.a, second};
    if (edge.a == edge.b || !edge.holds(p) || !edge.holds(q)) return std::nullopt;
    return edge;
}

/// True where a point is a corner of a triangle or lies on one of its sides.
bool on_triangle(const Surface& surface, int triangle, const SurfacePoint& p);

/// A triangle that holds the segment from p to q on its border or inside, or -1.
int triangle_of_segment(const Surface& surface, const SurfacePoint& p, const SurfacePoint& q);

}  // namespace mrc
