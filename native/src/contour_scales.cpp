// SPDX-License-Identifier: GPL-3.0-or-later
#include "contour_scales.h"

#include "distances.h"
#include "energy.h"
#include "segments.h"

#include <algorithm>
#include <cmath>

namespace mrc {
namespace {

constexpr int near_rings = 4;
constexpr double near_extent = 7.0;  // in h
constexpr double most_area = 3.0;    // of a vertex, in the square of its h: long triangles do not count as wide ones

std::vector<int> contour_ends(const Contour& contour) {
    std::vector<int> vertices;
    for (const SurfacePoint& p : contour.points) {
        vertices.push_back(p.a);
        if (!p.is_vertex()) vertices.push_back(p.b);
    }
    return vertices;
}

/// Of the local scale along the contour; linear inside an edge, so that points put on its edges do not change it.
double mean_scale(const Surface& surface, const CurvatureField& field, const Contour& contour, double length) {
    const auto at = [&](const SurfacePoint& p) {
        return p.is_vertex() ? field.scale(p.a) : (1.0 - p.t) * field.scale(p.a) + p.t * field.scale(p.b);
    };
    double sum = 0.0;
    for (const auto& [p, q] : segments(contour)) sum += 0.5 * (at(p) + at(q)) * (surface.position(q) - surface.position(p)).norm();
    return sum / length;
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

Scales contour_scales(const Surface& surface, const CurvatureField& field, const Contour& contour, const Options& options,
                      const Beat& beat) {
    const double length = contour_length(surface, contour);
    if (!(length > 0.0)) throw InvalidInput(ErrorCode::no_length, "the contour has length 0: all its vertices lie at one point");
    const double h = mean_scale(surface, field, contour, length);
    std::vector<int> near = vertices_within(surface, contour_ends(contour), near_rings);
    const DistanceField distance(surface, contour);
    std::erase_if(near, [&](int v) { return !distance.reaches(v, near_extent * h); });
    field.prepare(near, beat);
    double weighted = 0.0, area = 0.0;
    std::vector<double> features;
    for (const int v : near) {
        const double scale = field.scale(v);
        const double weight = std::min(vertex_area(surface, v), most_area * scale * scale),
                     kappa = feature_curvature(field.at(v), options.feature);
        weighted += weight * std::abs(kappa);
        area += weight;
        if (kappa < 0.0) features.push_back(-kappa);
    }
    Scales scales;
    scales.h = h;
    scales.L0 = length;
    scales.K = std::max(area > 0.0 ? weighted / area : 0.0, 0.01 / scales.L0);  // so that flat bands work
    if (options.feature_clamp && !features.empty()) scales.clamp = quantile(features, *options.feature_clamp);
    scales.kappa_0 = options.kappa0_factor * scales.K;
    scales.n0 = static_cast<int>(expressed(contour, options.refinement).points.size()) - (contour.closed ? 0 : 1);
    scales.given = contour;
    return scales;
}

}  // namespace mrc
