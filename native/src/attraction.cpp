// SPDX-License-Identifier: GPL-3.0-or-later
#include "attraction.h"

#include "elementary_functions.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace mrc {
namespace {

constexpr double slack = 1.0 + 1e-9;  // rounding: a sum of lengths may fall a little short of the straight distance

std::vector<Eigen::AlignedBox3d> reaches(const Surface& surface, std::span<const Attractor> attractors) {
    std::vector<Eigen::AlignedBox3d> boxes;
    boxes.reserve(attractors.size());
    for (const Attractor& a : attractors) {
        const Vec3 &center = surface.position(a.vertex), reach = Vec3::Constant(slack * a.radius);
        boxes.emplace_back(center - reach, center + reach);
    }
    return boxes;
}

}  // namespace

Attraction::Attraction(const Surface& surface, std::span<const Attractor> attractors)
    : surface_(surface), attractors_(attractors.begin(), attractors.end()), reaches_(reaches(surface, attractors)) {
    std::vector<int> all(attractors.size());
    std::iota(all.begin(), all.end(), 0);
    tree_.init(all.begin(), all.end(), reaches_.begin(), reaches_.end());
}

double Attraction::at(const SurfacePoint& point) const {
    double sum = 0.0;
    if (point.is_vertex()) {
        for (const int attractor : around(point.a)) sum += felt(attractor, point);
        return sum;
    }
    // An attractor that reaches a point inside an edge reaches one of its ends.
    std::vector<int> either;
    std::ranges::set_union(around(point.a), around(point.b), std::back_inserter(either));
    for (const int attractor : either) sum += felt(attractor, point);
    return sum;
}

double Attraction::felt(int attractor, const SurfacePoint& point) const {
    const Attractor& a = attractors_[attractor];
    const DistanceField& distance = field(attractor);
    const bool near = distance.reaches(point.a, a.radius) || (!point.is_vertex() && distance.reaches(point.b, a.radius));
    if (!near) return 0.0;
    const double d = distance.at(point);
    if (d > a.radius) return 0.0;
    const double sigma = a.sigma.value_or(0.5 * a.radius);
    return a.strength * elementary::exp(-d * d / (2.0 * sigma * sigma));
}

const std::vector<int>& Attraction::around(int vertex) const {
    const auto [entry, fresh] = around_.try_emplace(vertex);
    if (!fresh) return entry->second;
    struct Query {
        Vec3 place;
        const std::vector<Box>& reaches;
        std::vector<int>& found;
        bool intersectVolume(const Box& box) const { return box.contains(place); }
        bool intersectObject(int attractor) const {
            if (reaches[attractor].contains(place)) found.push_back(attractor);
            return false;
        }
    } query{surface_.position(vertex), reaches_, entry->second};
    Eigen::BVIntersect(tree_, query);
    std::ranges::sort(entry->second);  // one order of adding up, whatever the tree
    return entry->second;
}

const DistanceField& Attraction::field(int attractor) const {
    const auto known = fields_.find(attractor);
    if (known != fields_.end()) return known->second;
    const Contour place = vertex_contour(std::span(&attractors_[attractor].vertex, 1), false);
    return fields_.emplace(attractor, DistanceField(surface_, place)).first->second;
}

}  // namespace mrc
