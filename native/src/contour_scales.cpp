// SPDX-License-Identifier: GPL-3.0-or-later
#include "contour_scales.h"

#include "distances.h"
#include "energy.h"
#include "segments.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace mrc {
namespace {

constexpr int near_rings = 4;

std::vector<int> contour_ends(const Contour& contour) {
    std::vector<int> vertices;
    for (const SurfacePoint& p : contour.points) {
        vertices.push_back(p.a);
        if (!p.is_vertex()) vertices.push_back(p.b);
    }
    return vertices;
}

/// The ceil(q n)-th smallest of n values.
double quantile(std::vector<double>& values, double q) {
    const auto place = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size()) - 1e-12));
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(place, 1, values.size()) - 1);
    std::ranges::nth_element(values, nth);
    return *nth;
}

}  // namespace

double contour_length(const Surface& surface, const Contour& contour) {
    double length = 0.0;
    for (const auto& [p, q] : segments(contour)) length += (surface.position(q) - surface.position(p)).norm();
    return length;
}

double mean_edge_length(const Surface& surface, const Contour& contour) {
    const std::vector<int> near = vertices_within(surface, contour_ends(contour), near_rings);
    const std::unordered_set<int> inside(near.begin(), near.end());
    std::vector<std::pair<int, double>> lengths;  // by edge, so that each counts once
    for (const int v : near) {
        surface.for_each_real_edge(v, [&](int neighbor, int edge) {
            if (inside.contains(neighbor)) lengths.emplace_back(edge, (surface.position(neighbor) - surface.position(v)).norm());
        });
    }
    std::ranges::sort(lengths);
    lengths.erase(std::ranges::unique(lengths, {}, &std::pair<int, double>::first).begin(), lengths.end());
    double sum = 0.0;
    for (const auto& [edge, length] : lengths) sum += length;
    if (!(sum > 0.0))
        throw InvalidInput(ErrorCode::no_length, "every edge near the contour has length 0: there is nothing to measure");
    return sum / static_cast<double>(lengths.size());
}

Scales contour_scales(const Surface& surface, const CurvatureField& field, double h, const Contour& contour, const Options& options,
                      const Beat& beat) {
    double weighted = 0.0, area = 0.0;
    std::vector<double> features;
    const std::vector<int> near = vertices_within(surface, contour_ends(contour), near_rings);
    field.prepare(near, beat);
    for (const int v : near) {
        const double weight = vertex_area(surface, v), kappa = feature_curvature(field.at(v), options.feature);
        weighted += weight * std::abs(kappa);
        area += weight;
        if (kappa < 0.0) features.push_back(-kappa);
    }
    Scales scales;
    scales.h = h;
    scales.L0 = contour_length(surface, contour);
    if (!(scales.L0 > 0.0)) throw InvalidInput(ErrorCode::no_length, "the contour has length 0: all its vertices lie at one point");
    scales.K = std::max(area > 0.0 ? weighted / area : 0.0, 0.01 / scales.L0);  // so that flat bands work
    if (options.feature_clamp && !features.empty()) scales.clamp = quantile(features, *options.feature_clamp);
    scales.kappa_0 = options.kappa0_factor * scales.K;
    scales.n0 = static_cast<int>(expressed(contour, options.refinement).points.size()) - (contour.closed ? 0 : 1);
    scales.given = contour;
    return scales;
}

}  // namespace mrc
