// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

namespace mrc {

/// The same contour with t = 0 and t = 1 written as vertices.
Contour normalized(const Contour& contour);

/// The edge that holds both points, from a to b; a < 0: there is none.
struct SharedEdge {
    int a = -1, b = -1;

    SharedEdge(const SurfacePoint& p, const SurfacePoint& q) {
        const int first = p.a, second = p.is_vertex() ? (q.is_vertex() || q.a != first ? q.a : q.b) : p.b;
        const auto holds = [&](const SurfacePoint& x) {
            return (x.a == first || x.a == second) && (x.b == first || x.b == second);
        };
        if (first == second || !holds(p) || !holds(q)) return;
        a = first;
        b = second;
    }
    double parameter(const SurfacePoint& p) const {
        if (p.is_vertex()) return p.a == a ? 0.0 : 1.0;
        return p.a == a ? p.t : 1.0 - p.t;
    }
};

/// A triangle that holds the segment from p to q on its border or inside, or -1.
int triangle_of_segment(const Surface& surface, const SurfacePoint& p, const SurfacePoint& q);

}  // namespace mrc
