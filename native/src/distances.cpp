// SPDX-License-Identifier: GPL-3.0-or-later
#include "distances.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace mrc {

DistanceField::DistanceField(const Surface& surface, const Contour& contour) : surface_(surface) {
    for (int i = 0; const SurfacePoint& p : contour.points) {
        const double length = (surface.position(p.b) - surface.position(p.a)).norm();
        reach(p.a, {p.t * length, i});
        if (!p.is_vertex()) reach(p.b, {(1.0 - p.t) * length, i});
        ++i;
    }
}

void DistanceField::reach(int vertex, Path path) const {
    const auto [entry, fresh] = best_.emplace(vertex, path);
    if (!fresh && path.length >= entry->second.length) return;
    entry->second = path;
    queue_.emplace(path.length, vertex);
}

bool DistanceField::settle_next() const {
    while (!queue_.empty()) {
        const double distance = queue_.top().first;
        const int vertex = queue_.top().second;
        queue_.pop();
        if (!settled_.insert(vertex).second) continue;
        const int point = best_.at(vertex).point;
        surface_.for_each_real_edge(vertex, [&](int neighbor, int) {
            reach(neighbor, {distance + (surface_.position(neighbor) - surface_.position(vertex)).norm(), point});
        });
        return true;
    }
    return false;
}

bool DistanceField::settle(int vertex) const {
    while (!settled_.contains(vertex)) {
        if (!settle_next()) return false;
    }
    return true;
}

double DistanceField::at(int vertex) const {
    return settle(vertex) ? best_.at(vertex).length : std::numeric_limits<double>::infinity();
}

bool DistanceField::reaches(int vertex, double distance) const {
    while (!settled_.contains(vertex)) {
        if (queue_.empty() || queue_.top().first > distance || !settle_next()) return false;
    }
    return best_.at(vertex).length <= distance;
}

int DistanceField::nearest(int vertex) const { return settle(vertex) ? best_.at(vertex).point : -1; }

std::vector<int> vertices_within(const Surface& surface, std::span<const int> vertices, int rings) {
    std::vector<int> found;
    std::unordered_set<int> seen;
    for (const int v : vertices) {
        if (seen.insert(v).second) found.push_back(v);
    }
    for (std::size_t begin = 0; rings > 0; --rings) {
        const std::size_t end = found.size();
        for (; begin < end; ++begin) {
            surface.for_each_real_edge(found[begin], [&](int neighbor, int) {
                if (seen.insert(neighbor).second) found.push_back(neighbor);
            });
        }
    }
    return found;
}

int rings_between(const Surface& surface, const Contour& from, const Contour& to) {
    std::unordered_set<int> seen;
    std::vector<int> front;
    const auto enter = [&](int vertex) {
        if (seen.insert(vertex).second) front.push_back(vertex);
    };
    for (const SurfacePoint& p : from.points) {
        enter(p.a);
        enter(p.b);
    }
    const auto reached = [&](const SurfacePoint& p) { return seen.contains(p.a) || seen.contains(p.b); };
    for (int rings = 0;; ++rings) {
        if (front.empty() || std::ranges::all_of(to.points, reached)) return rings;
        for (const int v : std::exchange(front, {})) surface.for_each_real_edge(v, [&](int neighbor, int) { enter(neighbor); });
    }
}

}  // namespace mrc
