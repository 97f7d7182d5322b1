// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/energy.h>

#include "guide.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>

namespace mrc {
namespace {

const Vec3& feature_direction(const VertexCurvature& c, Feature feature) {
    return feature == Feature::ridge ? c.direction_min : c.direction_max;
}

/// p p^T; an umbilic point has no p and gives the mean over all tangent directions.
Eigen::Matrix3d projector(const VertexCurvature& c, Feature feature) {
    if (c.umbilic) return 0.5 * (Eigen::Matrix3d::Identity() - c.normal * c.normal.transpose());
    const Vec3& p = feature_direction(c, feature);
    return p * p.transpose();
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
      least_cosine_(std::cos(std::min(options.max_turn + 1e-6, std::numbers::pi))) {
    for (const Attractor& a : attractors) {
        pulls_.push_back({a, DistanceField(surface, vertex_contour(std::span(&a.vertex, 1), false))});
    }
}

Frame Energy::frame(const SurfacePoint& point) const {
    return point.is_vertex() ? vertex_frame(point.a) : interpolated_frame(point);
}

Frame Energy::vertex_frame(int vertex) const {
    const VertexCurvature& c = field_.at(vertex);
    Frame frame{c.normal, feature_direction(c, options_.feature), 0.0, c.umbilic, 0.0};
    finish(frame, feature(vertex), vertex_point(vertex));
    return frame;
}

/// Negative in a valley, cut off at the clamp.
double Energy::feature(int vertex) const {
    const VertexCurvature& c = field_.at(vertex);
    return std::max(options_.feature == Feature::ridge ? -c.kappa_max : c.kappa_min, -scales_.clamp);
}

Frame Energy::interpolated_frame(const SurfacePoint& point) const {
    const VertexCurvature &a = field_.at(point.a), &b = field_.at(point.b);
    const auto blend = [&](const auto& x, const auto& y) { return ((1.0 - point.t) * x + point.t * y).eval(); };
    const auto mix = [&](double x, double y) { return (1.0 - point.t) * x + point.t * y; };
    Frame frame;
    const Vec3 normal = blend(a.normal, b.normal);
    frame.normal = normal.norm() > 1e-12 ? Vec3(normal.normalized()) : a.normal;
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = frame.normal.unitOrthogonal();
    basis.col(1) = frame.normal.cross(basis.col(0));
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
    solver.computeDirect(basis.transpose() * blend(projector(a, options_.feature), projector(b, options_.feature)) * basis);
    frame.direction = (basis * solver.eigenvectors().col(1)).normalized();
    const double difference = mix(a.kappa_max - a.kappa_min, b.kappa_max - b.kappa_min);
    frame.umbilic = difference < negligible_ || solver.eigenvalues()[1] - solver.eigenvalues()[0] < 1e-9;
    const double kappa = mix(feature(point.a), feature(point.b));
    finish(frame, std::abs(kappa) < negligible_ ? 0.0 : kappa, point);
    return frame;
}

void Energy::finish(Frame& frame, double kappa, const SurfacePoint& point) const {
    const double size = scales_.K * std::pow(std::abs(kappa) / scales_.K, options_.feature_exponent);
    frame.kappa = kappa < 0.0 ? -size : size;
    if (options_.anchor > 0.0) {
        const double distance = from_given_.at(point) / (scales_.L0 / (2.0 * std::numbers::pi));
        frame.potential += options_.anchor * scales_.K * distance * distance;
    }
    frame.potential -= scales_.K * attraction(point);
}

/// Sum of strength w(d) over the attractors (4.5), w = exp(-d^2 / (2 sigma^2)) up to the radius.
double Energy::attraction(const SurfacePoint& point) const {
    double sum = 0.0;
    for (const auto& [attractor, distance] : pulls_) {
        const double d = distance.at(point);
        if (d > attractor.radius) continue;
        const double sigma = attractor.sigma.value_or(0.5 * attractor.radius);
        sum += attractor.strength * std::exp(-d * d / (2.0 * sigma * sigma));
    }
    return sum;
}

double Energy::crease_cost(int halfedge) const {
    if (surface_.diagonal(halfedge)) return plain_crease_cost();
    return plain_crease_cost() * std::min(3.0, std::exp(3.0 * std::sin(field_.dihedral(halfedge))));
}

ChordEnd Energy::chord_end(const Frame& frame, const Vec3& chord, double crease) {
    return {{chord.dot(frame.direction), chord.dot(frame.normal.cross(frame.direction))}, chord.norm(), crease};
}

double Energy::numerator(const Frame& frame, const ChordEnd& e1, const ChordEnd& e2) const {
    return bending(frame, e1, e2) + 0.5 * (e1.length * (frame.potential + e1.crease) + e2.length * (frame.potential + e2.crease));
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

double Energy::bending(const Frame& frame, const ChordEnd& e1, const ChordEnd& e2) const {
    // Without a direction the contour's own is taken: that of e1' + e2'.
    Eigen::Vector2d p(1.0, 0.0);
    if (frame.umbilic) {
        const Eigen::Vector2d sum = e1.tangent + e2.tangent;
        p = sum.norm() > 0.0 ? Eigen::Vector2d(sum.normalized()) : Eigen::Vector2d(0.0, 0.0);
    }
    const auto cosine = [&](const ChordEnd& e) {
        const double projected = e.tangent.norm();
        if (projected == 0.0) return 0.0;
        const double c = e.tangent.dot(p) / projected;
        if (options_.direction_exponent == 1.0) return c;
        return std::copysign(std::pow(std::abs(c), options_.direction_exponent), c);
    };
    const double along = std::abs(e1.length * cosine(e1) + e2.length * cosine(e2));  // A
    if (frame.kappa < 0.0) return 0.5 * frame.kappa * along;
    return 0.5 * scales_.kappa_0 * (e1.length + e2.length - along);
}

bool Energy::turns_too_much(const ChordEnd& e1, const ChordEnd& e2) const {
    return e1.tangent.dot(e2.tangent) < least_cosine_ * e1.tangent.norm() * e2.tangent.norm();
}

namespace {

/// The crease cost of the segment from p to q: that of the mesh edge it lies on, if any.
double segment_crease(const Surface& surface, const Energy& energy, const SurfacePoint& p, const SurfacePoint& q) {
    const SharedEdge edge(p, q);
    if (edge.a < 0 || energy.plain_crease_cost() == 0.0) return energy.plain_crease_cost();
    const int forward = surface.find_halfedge(edge.a, edge.b), backward = surface.find_halfedge(edge.b, edge.a);
    return forward < 0 && backward < 0 ? energy.plain_crease_cost() : energy.crease_cost(forward >= 0 ? forward : backward);
}

}  // namespace

Contour expressed(const Contour& contour, int steiner) {
    if (steiner == 0) return contour;
    Contour result{{}, contour.closed};
    const std::size_t count = contour.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        const SurfacePoint &p = contour.points[i], &q = contour.points[(i + 1) % count];
        result.points.push_back(p);
        const SharedEdge edge(p, q);
        if (edge.a < 0 || (!contour.closed && i + 1 == count)) continue;
        const double from = edge.parameter(p), to = edge.parameter(q);
        for (int s = 1; s <= steiner; ++s) {
            const double t = static_cast<double>(from < to ? s : steiner + 1 - s) / (steiner + 1);
            if (t > std::min(from, to) + 1e-9 && t < std::max(from, to) - 1e-9) result.points.push_back({edge.a, edge.b, t});
        }
    }
    return result;
}

Measure measure(const Surface& surface, const Energy& energy, const Contour& given, int steiner, double enclosed) {
    const Contour contour = expressed(given, steiner);
    Measure result;
    result.numerator = energy.region_factor() * enclosed;
    double bending = 0.0;
    const std::size_t count = contour.points.size();
    const auto position = [&](std::size_t i) { return surface.position(contour.points[i % count]); };
    for (std::size_t i = 0; i < count; ++i) {
        const Frame frame = energy.frame(contour.points[i]);
        const auto end = [&](std::size_t from, std::size_t to) {
            const double crease = segment_crease(surface, energy, contour.points[from % count], contour.points[to % count]);
            return Energy::chord_end(frame, position(to) - position(from), crease);
        };
        // Open curves: half a chord at each end, with the end's own curvature.
        const bool first = !contour.closed && i == 0, last = !contour.closed && i + 1 == count;
        const ChordEnd in = first ? ChordEnd{} : end(i + count - 1, i + count), out = last ? ChordEnd{} : end(i, i + 1);
        result.numerator += energy.numerator(frame, in, out);
        result.length += energy.denominator(in, out);
        bending += energy.bending(frame, in, out);
    }
    if (!(result.length > 0.0)) throw InvalidInput("the contour has length 0: all its vertices lie at one point");
    result.ratio = result.numerator / result.length;
    const Objective objective = energy.objective();
    result.objective = objective.value(result.numerator, result.length);
    result.salience = 0.0 - bending / (energy.unit() * result.length);  // never -0, which reads oddly
    return result;
}

}  // namespace mrc
