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

/// Distances along the surface from a contour, computed only as far out as they are asked for: shortest paths over real edges,
/// without diagonals. Where the contour crosses an edge it starts them at the edge's ends, with the distance along the edge.
class DistanceField {
  public:
    /// The surface must outlive the field.
    DistanceField(const Surface& surface, const Contour& contour);

    /// Infinity where no edges lead there.
    double at(int vertex) const;
    /// True where the distance is at most this; the search goes no farther.
    bool reaches(int vertex, double distance) const;
    /// The index of the contour's point where the shortest path starts, or -1 where no edges lead there.
    int nearest(int vertex) const;
    /// Linear inside an edge.
    double at(const SurfacePoint& point) const {
        return (1.0 - point.t) * at(point.a) + (point.is_vertex() ? 0.0 : point.t * at(point.b));
    }

  private:
    using Entry = std::pair<double, int>;
    struct Path {
        double length;
        int point;  // where it starts
    };
    const Surface& surface_;
    mutable std::unordered_map<int, Path> best_;
    mutable std::unordered_set<int> settled_;
    mutable std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;

    void reach(int vertex, Path path) const;
    bool settle_next() const;
    bool settle(int vertex) const;
};

/// The vertices at most `rings` real edges away, the given ones first, from near to far; nothing stops them.
std::vector<int> vertices_within(const Surface& surface, std::span<const int> vertices, int rings);

/// How many real edges lead from one contour to the farthest point of another; of a point inside an edge, to its nearer end.
int rings_between(const Surface& surface, const Contour& from, const Contour& to);

}  // namespace mrc
