// SPDX-License-Identifier: GPL-3.0-or-later
#include "energy.h"

#include "attraction.h"
#include "elementary_functions.h"
#include "segments.h"
#include "surface_point.h"

#include <Eigen/Geometry>

#include <cmath>

namespace mrc {
namespace {

const Vec3& feature_direction(const VertexCurvature& c, Feature feature) {
    return feature == Feature::ridge ? c.direction_min : c.direction_max;
}

/// A symmetric matrix in a tangent plane: xx, xy, yy.
using Planar = Eigen::Vector3d;

/// p p^T, seen in a plane; an umbilic point has no p and gives the mean over all tangent directions.
Planar projector(const VertexCurvature& c, Feature feature, const Eigen::Matrix<double, 3, 2>& basis) {
    const Eigen::Vector2d p = basis.transpose() * (c.umbilic ? c.normal : feature_direction(c, feature));
    const Planar square(p.x() * p.x(), p.x() * p.y(), p.y() * p.y());
    return c.umbilic ? Planar(0.5 * (Planar(1.0, 0.0, 1.0) - square)) : square;
}

/// The unit eigenvector of the larger eigenvalue. Of its two formulas the one without cancellation is used.
Eigen::Vector2d main_axis(const Planar& m) {
    const double half = 0.5 * (m[0] - m[2]), size = std::sqrt(half * half + m[1] * m[1]);
    const Eigen::Vector2d axis = half > 0.0 ? Eigen::Vector2d(half + size, m[1]) : Eigen::Vector2d(m[1], size - half);
    return size > 0.0 ? Eigen::Vector2d(axis.normalized()) : Eigen::Vector2d(1.0, 0.0);
}

}  // namespace

Energy::Energy(const Surface& surface, const CurvatureField& field, const Scales& scales, const Options& options,
               const std::vector<Attractor>& attractors)
    : surface_(surface),
      field_(field),
      scales_(scales),
      options_(options),
      from_given_(surface, scales.given),
      negligible_(1e-4 / scales.h),
      least_cosine_(elementary::cos(std::min(options.max_turn + 1e-6, std::numbers::pi))) {
    if (!attractors.empty()) attraction_ = std::make_unique<Attraction>(surface, attractors);
}

Energy::~Energy() = default;

Frame Energy::frame(const SurfacePoint& point) const {
    return point.is_vertex() ? vertex_frame(point.a) : interpolated_frame(point);
}

Frame Energy::vertex_frame(int vertex) const {
    const VertexCurvature c = field_.at(vertex);
    Frame frame;
    frame.normal = c.normal;
    frame.direction = feature_direction(c, options_.feature);
    frame.umbilic = c.umbilic;
    finish(frame, feature(vertex), vertex_point(vertex));
    return frame;
}

/// Negative in a valley, cut off at the clamp.
double Energy::feature(int vertex) const {
    return std::max(feature_curvature(field_.at(vertex), options_.feature), -scales_.clamp);
}

Frame Energy::interpolated_frame(const SurfacePoint& point) const {
    const VertexCurvature a = field_.at(point.a), b = field_.at(point.b);
    const auto blend = [&](const auto& x, const auto& y) { return ((1.0 - point.t) * x + point.t * y).eval(); };
    const auto mix = [&](double x, double y) { return (1.0 - point.t) * x + point.t * y; };
    Frame frame;
    const Vec3 normal = blend(a.normal, b.normal);
    frame.normal = normal.norm() > 1e-12 ? Vec3(normal.normalized()) : a.normal;
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = frame.normal.unitOrthogonal();
    basis.col(1) = frame.normal.cross(basis.col(0));
    const Planar seen = blend(projector(a, options_.feature, basis), projector(b, options_.feature, basis));
    frame.direction = basis * main_axis(seen);
    const double difference = mix(a.kappa_max - a.kappa_min, b.kappa_max - b.kappa_min);
    frame.umbilic = difference < negligible_ || std::max(std::abs(seen[0] - seen[2]), 2.0 * std::abs(seen[1])) < 1e-9;
    const double kappa = mix(feature(point.a), feature(point.b));
    finish(frame, std::abs(kappa) < negligible_ ? 0.0 : kappa, point);
    return frame;
}

void Energy::finish(Frame& frame, double kappa, const SurfacePoint& point) const {
    frame.kappa = kappa;
    if (options_.feature_exponent != 1.0)
        frame.kappa = std::copysign(scales_.K * elementary::pow(std::abs(kappa) / scales_.K, options_.feature_exponent), kappa);
    frame.across = frame.normal.cross(frame.direction);
    if (options_.anchor > 0.0) {
        const double distance = from_given_.at(point) / (scales_.L0 / (2.0 * std::numbers::pi));
        frame.potential += options_.anchor * scales_.K * distance * distance;
    }
    if (attraction_) frame.potential -= scales_.K * attraction_->at(point);
}

double Energy::crease_cost(int halfedge) const {
    if (options_.crease == 0.0 || halfedge < 0 || surface_.diagonal(halfedge)) return plain_crease_cost();
    return plain_crease_cost() * std::min(3.0, elementary::exp(3.0 * elementary::sin(field_.dihedral(halfedge))));
}

double Energy::region_factor() const {
    return (options_.region_side == RegionSide::left ? 1.0 : -1.0) * options_.region_weight * scales_.K / scales_.L0;
}

double Energy::unit() const { return options_.denominator == Denominator::arcs ? scales_.K * scales_.L0 / scales_.n0 : scales_.K; }

Objective Energy::objective() const {
    if (options_.length_bias == 0.0) return {};
    const double length = options_.denominator == Denominator::arcs ? scales_.n0 : scales_.L0;
    return {unit(), options_.length_bias / length, options_.length_floor * length};
}

namespace {

/// The crease cost of the segment from p to q: that of the mesh edge it lies on, if any.
double segment_crease(const Surface& surface, const Energy& energy, const SurfacePoint& p, const SurfacePoint& q) {
    const auto edge = shared_edge(p, q);
    if (!edge || energy.plain_crease_cost() == 0.0) return energy.plain_crease_cost();
    return energy.crease_cost(surface.find_edge(edge->a, edge->b));
}

}  // namespace

Contour expressed(const Contour& contour, int steiner) {
    if (steiner == 0) return contour;
    Contour result{{}, contour.closed};
    for (const auto& [p, q] : segments(contour)) {
        result.points.push_back(p);
        const auto edge = shared_edge(p, q);
        if (!edge) continue;
        const double from = edge->parameter(p), to = edge->parameter(q);
        for (int s = 1; s <= steiner; ++s) {
            const double t = static_cast<double>(from < to ? s : steiner + 1 - s) / (steiner + 1);
            if (t > std::min(from, to) + 1e-9 && t < std::max(from, to) - 1e-9) result.points.push_back({edge->a, edge->b, t});
        }
    }
    if (!contour.closed) result.points.push_back(contour.points.back());
    return result;
}

Measure measure(const Surface& surface, const Energy& energy, const Contour& given, int steiner, double enclosed) {
    const Contour contour = expressed(given, steiner);
    Measure result;
    result.numerator = energy.region_factor() * enclosed;
    double bending = 0.0;
    for (int i = 0; const SurfacePoint& point : contour.points) {
        const Frame frame = energy.frame(point);
        // Open curves: half a chord at each end, with the end's own curvature.
        const auto end = [&](const SurfacePoint* from, const SurfacePoint* to) {
            if (!from || !to) return ChordEnd{};
            const double crease = segment_crease(surface, energy, *from, *to);
            return energy.chord_end(frame, surface.position(*to) - surface.position(*from), crease);
        };
        const ChordEnd in = end(neighbor(contour, i, -1), &point), out = end(&point, neighbor(contour, i, 1));
        const ArcWeights weights = energy.weights(frame);
        result.numerator += weights.numerator(in, out);
        result.length += weights.denominator(in, out);
        bending += weights.bending(in, out);
        ++i;
    }
    if (!(result.length > 0.0))
        throw InvalidInput(ErrorCode::no_length, "the contour has length 0: all its vertices lie at one point");
    result.ratio = result.numerator / result.length;
    const Objective objective = energy.objective();
    result.objective = objective.value(result.numerator, result.length);
    result.salience = 0.0 - bending / (energy.unit() * result.length);  // never -0, which reads oddly
    return result;
}

}  // namespace mrc
