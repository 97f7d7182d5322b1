// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_point.h"

#include <algorithm>

namespace mrc {

bool on_triangle(const Surface& surface, int triangle, const SurfacePoint& p) {
    const auto& v = surface.triangle(triangle);
    return std::ranges::find(v, p.a) != v.end() && std::ranges::find(v, p.b) != v.end();
}

Contour normalized(const Contour& contour) {
    Contour result = contour;
    for (SurfacePoint& p : result.points) {
        if (p.a == p.b || p.t == 0.0) p = vertex_point(p.a);
        if (p.t == 1.0) p = vertex_point(p.b);
    }
    return result;
}

int triangle_of_segment(const Surface& surface, const SurfacePoint& p, const SurfacePoint& q) {
    for (const int start : {p.a, p.b}) {
        for (const int h : surface.outgoing(start)) {
            if (on_triangle(surface, h / 3, p) && on_triangle(surface, h / 3, q)) return h / 3;
        }
    }
    return -1;
}

}  // namespace mrc
