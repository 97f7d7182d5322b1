// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <queue>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace mrc {

/// Dijkstra's search over the real edges, diagonals unseen: calls visit(vertex, distance) for each vertex in the order of
/// distance, then of vertex, until it returns false.
template <class Visit>
void settle_outwards(const Surface& surface, std::span<const int> seeds, Visit&& visit) {
    using Entry = std::pair<double, int>;
    std::unordered_map<int, double> best;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const int seed : seeds) {
        if (best.emplace(seed, 0.0).second) queue.emplace(0.0, seed);
    }
    while (!queue.empty()) {
        const auto [distance, vertex] = queue.top();
        queue.pop();
        if (distance > best.at(vertex)) continue;
        if (!visit(vertex, distance)) return;
        surface.for_each_real_edge(vertex, [&](int neighbour, int) {
            const double reached = distance + (surface.position(neighbour) - surface.position(vertex)).norm();
            const auto [entry, fresh] = best.emplace(neighbour, reached);
            if (!fresh && reached >= entry->second) return;
            entry->second = reached;
            queue.emplace(reached, neighbour);
        });
    }
}

/// Distances along the surface from a contour, found as far out as they are asked for: shortest paths over real edges, diagonals
/// unseen. Where the contour crosses an edge it starts them at the edge's ends, with the way along the edge.
class DistanceField {
  public:
    /// The surface must outlive the field.
    DistanceField(const Surface& surface, const Contour& contour);

    /// Infinity where no edges lead there.
    double at(int vertex) const;
    /// Linear inside an edge.
    double at(const SurfacePoint& point) const {
        return (1.0 - point.t) * at(point.a) + (point.is_vertex() ? 0.0 : point.t * at(point.b));
    }

  private:
    using Entry = std::pair<double, int>;
    const Surface& surface_;
    mutable std::unordered_map<int, double> best_;
    mutable std::unordered_set<int> settled_;
    mutable std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;

    void reach(int vertex, double distance) const;
    bool settle_next() const;
};

/// Distances along the surface from vertices, up to `limit`: (vertex, distance) in the order of distance, then of vertex.
std::vector<std::pair<int, double>> distances_from(const Surface& surface, std::span<const int> vertices, double limit);

/// The vertices at most `rings` real edges away, the given ones first, from near to far; nothing stops them.
std::vector<int> vertices_within(const Surface& surface, std::span<const int> vertices, int rings);

}  // namespace mrc
