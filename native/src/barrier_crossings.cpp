// SPDX-License-Identifier: GPL-3.0-or-later
#include "barrier_crossings.h"

#include "element_names.h"
#include "segments.h"
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

/// Where in a vertex's fan the next point of a contour lies: on half-edge i at i, in the triangle after it at i + 0.5.
double place_in_fan(const Surface& surface, const std::vector<int>& fan, const SurfacePoint& next) {
    for (std::size_t i = 0; i < fan.size(); ++i) {
        if (directed_edge(surface, fan[i]).holds(next)) return static_cast<double>(i);
    }
    for (std::size_t i = 0; i < fan.size(); ++i) {
        if (on_triangle(surface, fan[i] / 3, next)) return static_cast<double>(i) + 0.5;
    }
    return -1.0;
}

/// A contour crosses the barriers where, at a point or along a run of points on them, some leave to its left and some to its
/// right.
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

    /// True where the segment after point i lies on a barrier.
    bool along(int i) const {
        const SurfacePoint* next = neighbor(contour_, i, 1);
        const auto edge = next ? shared_edge(contour_.points[i], *next) : std::nullopt;
        return edge && is_barrier(edge->a, edge->b);
    }

    /// The first point of a run, so that no run of a closed contour is split between its last point and its first.
    int first_of_a_run() const {
        const int count = static_cast<int>(contour_.points.size());
        for (int i = 0; contour_.closed && i < count; ++i) {
            if (!along(i)) return (i + 1) % count;
        }
        return 0;
    }

    Sides sides_at(int i) const {
        const SurfacePoint *last = neighbor(contour_, i, -1), *next = neighbor(contour_, i, 1);
        if (!last || !next) return {};
        const SurfacePoint& here = contour_.points[i];
        if (here.is_vertex()) return sides_at_vertex(here.a, *last, *next);
        return is_barrier(here.a, here.b) ? sides_inside_edge(here, *last, *next) : Sides();
    }

    /// Counterclockwise from the next point lie the barriers on the left, then the last point, then the barriers on the right.
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

    /// At a point inside a barrier its two halves leave, except those that the contour runs along.
    Sides sides_inside_edge(const SurfacePoint& here, const SurfacePoint& last, const SurfacePoint& next) const {
        const DirectedEdge edge{here.a, here.b};
        const auto ahead = [&](const SurfacePoint& p) { return edge.holds(p) && edge.parameter(p) > here.t; };
        const auto behind = [&](const SurfacePoint& p) { return edge.holds(p) && edge.parameter(p) < here.t; };
        Sides sides;
        for (const bool half : {true, false}) {  // towards b, towards a
            if (half ? ahead(last) || ahead(next) : behind(last) || behind(next)) continue;
            on_left(here, last, next, half) ? sides.left = true : sides.right = true;
        }
        return sides;
    }

    /// The direction of another point, seen from a point inside edge ab, counted in quarter turns to the left: 0 along the edge
    /// towards b, 1 in the triangle on its left, 2 along it towards a, 3 in the triangle on its right.
    int quarter(const SurfacePoint& here, const SurfacePoint& p) const {
        const DirectedEdge edge{here.a, here.b};
        if (edge.holds(p)) return edge.parameter(p) > here.t ? 0 : 2;
        const int h = surface_.find_edge(edge.a, edge.b, EdgeKind::any);
        const bool triangle_on_left = surface_.from(h) == edge.a;
        return on_triangle(surface_, h / 3, p) == triangle_on_left ? 1 : 3;
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
