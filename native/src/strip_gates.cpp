// SPDX-License-Identifier: GPL-3.0-or-later
#include "strip_gates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace mrc {
namespace {

using Point = PatchMesh::Point;

constexpr double same_length = 1.0 - 1e-9;  // two lengths whose ratio is nearer to 1 differ by rounding only

/// Looks for closest points between two neighboring strips.
class ClosestPoints {
  public:
    ClosestPoints(const Patch& patch, const Band& band, const OpenedBand& opened)
        : patch_(patch), mesh_(patch.mesh), band_(band), opened_(opened) {}

    /// Visits the vertices k of one strip with the points of the other where a gate leads.
    template <class Visit>
    void pair_up(const IndexedStrip& from, const IndexedStrip& to, Visit&& visit) const {
        const Strip &strip = from.strip, &other = to.strip;
        for (int k = 0; k < strip.size(); ++k) {
            const int v = strip.vertices[k];
            if (from.index[v] != off_strip && to.index[v] != off_strip) continue;
            const auto [first, last] = opposite_stretch(v, strip.lap[k], to);
            if (first > last) continue;
            const Foot foot = closest(point(v), other, first, last);
            if (const auto vertex = opposite_vertex(strip, k, other, foot)) {
                visit(k, *vertex);
            } else if (closest(position(other, foot), strip, k, k).place() == k) {
                visit(k, foot);
            }
        }
    }

  private:
    const Patch& patch_;
    const PatchMesh& mesh_;
    const Band& band_;
    const OpenedBand& opened_;

    const Point& point(int vertex) const { return mesh_.point(PatchMesh::VertexHandle(vertex)); }

    /// The vertex nearest to the foot of vertex k, where the two are opposite each other: where both feet together miss their
    /// vertices by less than half an edge. The kinks of two curves of edges push the feet off the vertices, to either side where
    /// the curves are regular; without this, rounding would choose the side.
    std::optional<Foot> opposite_vertex(const Strip& strip, int k, const Strip& other, const Foot& foot) const {
        const Foot vertex{foot.k + (foot.t < 0.5 ? 0 : 1), 0.0, 0.0};
        const Point there = position(other, vertex);
        const double missed = std::abs(foot.place() - vertex.k) + std::abs(closest(there, strip, k, k).place() - k);
        if (missed >= 0.5 - 1e-9) return std::nullopt;
        return Foot{vertex.k, 0.0, (there - point(strip.vertices[k])).norm()};
    }

    Point position(const Strip& strip, const Foot& foot) const {
        return point(strip.vertex(foot.k)) * (1.0 - foot.t) + point(strip.vertex(foot.k + 1)) * foot.t;
    }

    /// The stretch of the other strip that a vertex shares polygons with: where the search for its closest point begins. Empty in
    /// a corner where the polygons see nothing of the other strip: no narrows there.
    std::pair<int, int> opposite_stretch(int vertex, int lap, const IndexedStrip& other) const {
        std::pair<int, int> stretch{std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
        for (const auto h : mesh_.voh_range(PatchMesh::VertexHandle(vertex))) {
            if (!h.face().is_valid() || !band_.face[h.face().idx()]) continue;
            const int polygon = patch_.polygon[h.face().idx()];
            for (int f = patch_.first_face[polygon]; f < patch_.first_face[polygon + 1]; ++f) {
                for (const auto corner : mesh_.fh_range(PatchMesh::FaceHandle(f))) {
                    const int k = other.index[corner.from().idx()];
                    if (k == off_strip) continue;
                    const int there = k + (lap + opened_.behind[corner.idx()] - opened_.behind[h.idx()]) * other.strip.size();
                    stretch = {std::min(stretch.first, there), std::max(stretch.second, there)};
                }
            }
        }
        return stretch;
    }

    /// The point of a strip closest to x, on a stretch of it or near by. What is closer than a point of the stretch at distance d
    /// is at most 2 d from it; going no further along the strip keeps the search from jumping over folds.
    Foot closest(const Point& x, const Strip& strip, int first, int last) const {
        Foot best{first, 0.0, (x - point(strip.vertex(first))).norm()};
        const auto try_edge = [&](int k) {
            const Point a = point(strip.vertex(k)), side = point(strip.vertex(k + 1)) - a;
            const double square = side.sqrnorm();
            const double t = square > 0.0 ? std::clamp(((x - a) | side) / square, 0.0, 1.0) : 0.0;
            const double distance = (x - a - side * t).norm();
            if (distance < same_length * best.distance) best = {k, t, distance};
        };
        for (int k = first; k < last; ++k) try_edge(k);
        const double reach = 2.0 * best.distance;
        const int end = strip.closed ? first + strip.size() : strip.size() - 1, begin = strip.closed ? last - strip.size() : 0;
        for (int k = last; k < end && strip.arc_at(k) - strip.arc_at(last) < reach; ++k) try_edge(k);
        for (int k = first - 1; k >= begin && strip.arc_at(first) - strip.arc_at(k + 1) < reach; --k) try_edge(k);
        return best;
    }
};

}  // namespace

std::vector<Gate> find_gates(const Patch& patch, const Band& band, const OpenedBand& opened, const IndexedStrip& known,
                             const IndexedStrip& next) {
    const ClosestPoints points(patch, band, opened);
    std::vector<Gate> gates;
    points.pair_up(known, next, [&](int k, const Foot& foot) {
        gates.push_back({foot.arc(next.strip), known.strip.flow_at(k), foot.distance});
    });
    points.pair_up(next, known, [&](int k, const Foot& foot) {
        gates.push_back({next.strip.arc_at(k), foot.flow(known.strip), foot.distance});
    });
    return gates;
}

}  // namespace mrc
