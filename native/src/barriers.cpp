// SPDX-License-Identifier: GPL-3.0-or-later
#include "barriers.h"

#include "element_names.h"
#include "surface_point.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mrc {
namespace {

/// The half-edges that leave a vertex, turning left; at a border from the border on.
std::vector<int> fan_of(const Surface& surface, int vertex) {
    const int first = surface.outgoing(vertex).front();
    int start = first;
    while (surface.twin(start) >= 0 && Surface::next(surface.twin(start)) != first) start = Surface::next(surface.twin(start));
    std::vector<int> fan{start};
    for (int h = surface.twin(Surface::previous(start)); h >= 0 && h != start; h = surface.twin(Surface::previous(h)))
        fan.push_back(h);
    return fan;
}

/// Where in a vertex's fan the way to the next point of a contour lies: half-edges by their place, triangles between them.
double place_in_fan(const Surface& surface, const std::vector<int>& fan, const SurfacePoint& next) {
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const int here = surface.from(fan[i]), there = surface.to(fan[i]);
        const auto on_edge = [&](int v) { return v == here || v == there; };
        if (on_edge(next.a) && on_edge(next.b)) return static_cast<double>(i);
    }
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const auto& corners = surface.triangle(fan[i] / 3);
        if (std::ranges::count(corners, next.a) + std::ranges::count(corners, next.b) == 2) return static_cast<double>(i) + 0.5;
    }
    return -1.0;
}

/// A contour crosses the barriers where, from a point or a run of points along them, some go off to its left and some to its right.
class BarrierCheck {
  public:
    BarrierCheck(const Surface& surface, const Contour& contour, const Constraints& constraints)
        : surface_(surface), contour_(contour) {
        for (const auto& [a, b] : constraints.barriers) barriers_.insert({std::min(a, b), std::max(a, b)});
    }

    void run() const {
        const int count = static_cast<int>(contour_.points.size());
        const int start = first_of_a_run();
        Sides sides;
        for (int step = 0; step < count; ++step) {
            const int i = (start + step) % count;
            const Sides here = sides_at(i);
            sides.left |= here.left;
            sides.right |= here.right;
            if (sides.left && sides.right) {
                throw InvalidInput(
                    ErrorCode::crosses_barrier,
                    "the contour crosses a barrier at " + name(contour_.points[i]) + ": drop the barrier or move the contour",
                    {element_of(contour_.points[i])});
            }
            if (!along(i)) sides = {};
        }
    }

  private:
    struct Sides {
        bool left = false, right = false;
    };
    const Surface& surface_;
    const Contour& contour_;
    std::set<std::pair<int, int>> barriers_;

    static std::string name(const SurfacePoint& p) {
        return p.is_vertex() ? "vertex " + std::to_string(p.a) : "edge " + edge_name(p.a, p.b);
    }
    bool is_barrier(int a, int b) const { return barriers_.contains({std::min(a, b), std::max(a, b)}); }

    /// The neighbor of point i, `step` points on; null beyond the ends of an open curve.
    const SurfacePoint* neighbor(int i, int step) const {
        const int count = static_cast<int>(contour_.points.size()), j = i + step;
        if (!contour_.closed && (j < 0 || j >= count)) return nullptr;
        return &contour_.points[(j + count) % count];
    }

    /// True where the segment behind point i lies on a barrier.
    bool along(int i) const {
        const SurfacePoint* next = neighbor(i, 1);
        if (!next) return false;
        const SharedEdge edge(contour_.points[i], *next);
        return edge.a >= 0 && is_barrier(edge.a, edge.b);
    }

    /// Where a closed contour's runs do not go on from its last point to its first.
    int first_of_a_run() const {
        const int count = static_cast<int>(contour_.points.size());
        for (int i = 0; contour_.closed && i < count; ++i) {
            if (!along(i)) return (i + 1) % count;
        }
        return 0;
    }

    Sides sides_at(int i) const {
        const SurfacePoint *last = neighbor(i, -1), *next = neighbor(i, 1);
        if (!last || !next) return {};
        const SurfacePoint& here = contour_.points[i];
        if (here.is_vertex()) return sides_at_vertex(here.a, *last, *next);
        return is_barrier(here.a, here.b) ? sides_inside_edge(here, *last, *next) : Sides();
    }

    /// Turning left from the way on, one meets what is on the left, then the way back, then what is on the right.
    Sides sides_at_vertex(int vertex, const SurfacePoint& last, const SurfacePoint& next) const {
        const std::vector<int> fan = fan_of(surface_, vertex);
        const double from = place_in_fan(surface_, fan, next), until = place_in_fan(surface_, fan, last);
        Sides sides;
        for (std::size_t i = 0; from >= 0.0 && until >= 0.0 && i < fan.size(); ++i) {
            const auto place = static_cast<double>(i);
            if (surface_.diagonal(fan[i]) || place == from || place == until || !is_barrier(vertex, surface_.to(fan[i]))) continue;
            (from < until ? from < place && place < until : from < place || place < until) ? sides.left = true : sides.right = true;
        }
        return sides;
    }

    /// At a point inside a barrier its two halves go off, but for those that the contour runs along.
    Sides sides_inside_edge(const SurfacePoint& here, const SurfacePoint& last, const SurfacePoint& next) const {
        const auto ahead = [&](const SurfacePoint& p) { return on_edge(here, p) && share(here, p) > here.t; };
        const auto behind = [&](const SurfacePoint& p) { return on_edge(here, p) && share(here, p) < here.t; };
        Sides sides;
        for (const bool half : {true, false}) {  // the one towards b, and that towards a
            if (half ? ahead(last) || ahead(next) : behind(last) || behind(next)) continue;
            on_left(here, last, next, half) ? sides.left = true : sides.right = true;
        }
        return sides;
    }

    static bool on_edge(const SurfacePoint& edge, const SurfacePoint& p) {
        return (p.a == edge.a || p.a == edge.b) && (p.b == edge.a || p.b == edge.b);
    }
    static double share(const SurfacePoint& edge, const SurfacePoint& p) {
        if (p.is_vertex()) return p.a == edge.a ? 0.0 : 1.0;
        return p.a == edge.a ? p.t : 1.0 - p.t;
    }

    /// Where the halves of the edge and the ways to other points lie round a point inside it, turning left from the half towards b:
    /// 0 and 2 for the halves, 1 and 3 for the triangles on the left and on the right of the edge from a to b.
    int quarter(const SurfacePoint& here, const SurfacePoint& p) const {
        if (on_edge(here, p)) return share(here, p) > here.t ? 0 : 2;
        for (const int h : surface_.outgoing(here.a)) {
            if (surface_.to(h) == here.b) return in_triangle(h / 3, p) ? 1 : 3;
        }
        for (const int h : surface_.outgoing(here.b)) {
            if (surface_.to(h) == here.a) return in_triangle(h / 3, p) ? 3 : 1;
        }
        return 1;
    }
    bool in_triangle(int triangle, const SurfacePoint& p) const {
        const auto& corners = surface_.triangle(triangle);
        return std::ranges::find(corners, p.a) != corners.end() && std::ranges::find(corners, p.b) != corners.end();
    }

    bool on_left(const SurfacePoint& here, const SurfacePoint& last, const SurfacePoint& next, bool towards_b) const {
        const int from = quarter(here, next), turned = ((towards_b ? 0 : 2) - from + 4) % 4,
                  until = (quarter(here, last) - from + 4) % 4;
        return turned < until;
    }
};

}  // namespace

void check_barriers(const Surface& surface, const Contour& contour, const Constraints& constraints) {
    if (!constraints.barriers.empty()) BarrierCheck(surface, contour, constraints).run();
}

}  // namespace mrc
