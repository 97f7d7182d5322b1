// SPDX-License-Identifier: GPL-3.0-or-later
#include "snapped_contour.h"

#include "segments.h"
#include "surface_point.h"

#include <algorithm>
#include <unordered_set>

namespace mrc {
namespace {

enum class Snap { nearest, left, right };

/// Where the contour leaves a triangle through the edge ab: true where a lies on its left.
bool first_end_is_left(const Surface& surface, int triangle, const SurfacePoint& p) {
    for (int h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        // The triangle is on the left of its half-edges; leaving through one, its end is on the left.
        if (surface.from(h) == p.a && surface.to(h) == p.b) return false;
        if (surface.from(h) == p.b && surface.to(h) == p.a) return true;
    }
    return true;
}

/// The end of its edge that a point moves to. `neighbor` is the point before it or, where `is_next`, the one after it.
int snapped(const Surface& surface, const SurfacePoint& p, const SurfacePoint& neighbor, bool is_next, Snap snap) {
    if (p.is_vertex()) return p.a;
    if (snap == Snap::nearest) return p.t <= 0.5 ? p.a : p.b;
    // Entering a triangle through an edge, left and right change places.
    const bool left = first_end_is_left(surface, triangle_of_segment(surface, neighbor, p), p) != is_next;
    return left == (snap == Snap::left) ? p.a : p.b;
}

int first_snapped(const Surface& surface, const Contour& contour, Snap snap) {
    const auto& points = contour.points;
    return contour.closed ? snapped(surface, points.front(), points.back(), false, snap)
                          : snapped(surface, points.front(), points[1], true, snap);
}

/// The shorter path around the polygon from a to b, both of which it holds; without a, with b.
void append_path(const Surface& surface, int face, int a, int b, std::vector<int>& chain) {
    const auto corners = surface.face(face);
    const auto n = static_cast<std::ptrdiff_t>(corners.size());
    const auto place = [&](int v) { return std::ranges::find(corners, v) - corners.begin(); };
    const std::ptrdiff_t start = place(a), ahead = (place(b) - start + n) % n;
    const auto walk = [&](std::ptrdiff_t steps, std::ptrdiff_t direction) {
        std::vector<int> path;
        for (std::ptrdiff_t i = 1; i <= steps; ++i) path.push_back(corners[(start + direction * i + n * i) % n]);
        return path;
    };
    const auto length = [&](const std::vector<int>& path) {
        double sum = 0.0;
        int last = a;
        for (const int v : path) {
            sum += (surface.position(v) - surface.position(last)).norm();
            last = v;
        }
        return sum;
    };
    const std::vector<int> forward = walk(ahead, 1), backward = walk(n - ahead, -1);
    const auto& path = length(forward) <= length(backward) ? forward : backward;
    chain.insert(chain.end(), path.begin(), path.end());
}

/// Removes steps there and back, which enclose nothing.
std::vector<int> without_spurs(const std::vector<int>& chain, bool closed) {
    std::vector<int> kept;
    for (const int v : chain) {
        if (!kept.empty() && kept.back() == v) continue;
        if (kept.size() >= 2 && kept[kept.size() - 2] == v) {
            kept.pop_back();
            continue;
        }
        kept.push_back(v);
    }
    while (closed && kept.size() > 2) {
        if (kept.front() != kept.back() && kept[1] == kept.back()) {
            kept.erase(kept.begin());
        } else if (kept.front() == kept.back() || kept[kept.size() - 2] == kept.front()) {
            kept.pop_back();
        } else {
            break;
        }
    }
    return kept;
}

std::vector<int> snapped_chain(const Surface& surface, const Contour& contour, Snap snap) {
    std::vector<int> chain{first_snapped(surface, contour, snap)};
    for (const auto& [p, q] : segments(contour)) {
        const int a = chain.back(), b = snapped(surface, q, p, false, snap);
        if (a == b) continue;
        if (surface.real_edge(a, b)) {
            chain.push_back(b);
        } else {
            append_path(surface, surface.triangle_face(triangle_of_segment(surface, p, q)), a, b, chain);
        }
    }
    if (contour.closed && chain.size() > 1 && chain.front() == chain.back()) chain.pop_back();
    return without_spurs(chain, contour.closed);
}

}  // namespace

std::vector<int> snapped_contour(const Surface& surface, const Contour& contour) {
    for (const Snap snap : {Snap::nearest, Snap::left, Snap::right}) {
        std::vector<int> chain = snapped_chain(surface, contour, snap);
        const std::unordered_set<int> distinct(chain.begin(), chain.end());
        if (distinct.size() == chain.size() && chain.size() >= (contour.closed ? 3U : 2U)) return chain;
    }
    return {};
}

}  // namespace mrc
