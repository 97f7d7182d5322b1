// SPDX-License-Identifier: GPL-3.0-or-later
#include "local_scale.h"

#include "curvature_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrc {
namespace {

constexpr double quantile = 0.4;  // of the angles at a vertex; below one half, since a flat face on one side can be vast

/// Of the edges at a vertex that have a length; 0 where none has.
double mean_edge(const Surface& surface, int vertex) {
    double sum = 0.0;
    int count = 0;
    surface.for_each_real_edge(vertex, [&](int neighbor, int) {
        const double length = (surface.position(neighbor) - surface.position(vertex)).norm();
        sum += length;
        count += length > 0.0;
    });
    return count > 0 ? sum / count : 0.0;
}

/// The weighted median of a vertex's polygons, or where these have no area the mean length of its edges.
double own(const Surface& surface, int vertex) {
    std::vector<std::pair<double, double>> extents;  // each with its angle
    double whole = 0.0;
    for_each_face_at(surface, vertex, [&](int face) {
        const double angle = angle_at(surface, face, vertex), extent = extent_across(surface, face);
        if (!(extent > 0.0)) return;
        extents.emplace_back(extent, angle);
        whole += angle;
    });
    std::ranges::sort(extents);
    double sum = 0.0;
    for (const auto& [extent, angle] : extents) {
        sum += angle;
        if (sum >= quantile * whole * (1.0 - 1e-12)) return extent;  // rounding must not decide
    }
    return mean_edge(surface, vertex);
}

}  // namespace

double extent_across(const Surface& surface, int face) {
    const auto corners = surface.face(face);
    const double n = static_cast<double>(corners.size());
    Vec3 center = Vec3::Zero();
    for (const int v : corners) center += surface.position(v);
    center /= n;
    double trace = 0.0;
    for (const int v : corners) trace += (surface.position(v) - center).squaredNorm() / n;
    // The product of the two moments is that of a triangle or of a rectangle with this area.
    const double area = polygon_area_vector(surface, face).norm();
    const bool triangle = corners.size() == 3;
    const double product = std::min(area * area * (triangle ? 4.0 / 27.0 : 1.0 / 16.0), 0.25 * trace * trace);
    // The product over the root mean square of the moments: the smaller one but for a factor from 1 to sqrt 2, and smooth where
    // they are equal, so that rounding does no more than elsewhere.
    const double squares = trace * trace - 2.0 * product;
    return squares > 0.0 ? std::sqrt((triangle ? 6.0 : 4.0) * product / std::sqrt(squares)) : 0.0;
}

double LocalScale::at(int vertex, int passes) {
    Pass& pass = passes_[passes];
    const int number = pass.numbers.insert(vertex);
    if (number == static_cast<int>(pass.scales.size())) {
        pass.scales.push_back(-1.0);
        const double scale = passes == 0 ? own(*surface_, vertex) : mean(vertex, passes - 1);
        pass.scales[number] = scale;
    }
    return pass.scales[number];
}

/// Of a vertex and its neighbors; those farther away than their distance for less.
double LocalScale::mean(int vertex, int passes) {
    const double here = at(vertex, passes);
    double sum = here, weights = here > 0.0 ? 1.0 : 0.0;
    surface_->for_each_real_edge(vertex, [&](int neighbor, int) {
        const double there = at(neighbor, passes), length = (surface_->position(neighbor) - surface_->position(vertex)).norm();
        if (!(there > 0.0)) return;
        const double near = here > 0.0 ? here / std::max(here, length) : 1.0;
        sum += near * near * there;
        weights += near * near;
    });
    return weights > 0.0 ? sum / weights : 0.0;
}

}  // namespace mrc
