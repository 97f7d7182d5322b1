// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/energy.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>

namespace mrc {
namespace {

double feature_curvature(const VertexCurvature& c, Feature feature) {
    return feature == Feature::ridge ? -c.kappa_max : c.kappa_min;
}

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

Energy::Energy(const Surface& surface, const CurvatureField& field, const Scales& scales, const Options& options)
    : surface_(surface),
      field_(field),
      scales_(scales),
      options_(options),
      negligible_(1e-4 / scales.h),
      least_cosine_(std::cos(std::min(options.max_turn + 1e-6, std::numbers::pi))) {}

Frame Energy::frame(const SurfacePoint& point) const {
    return point.is_vertex() ? vertex_frame(point.a) : interpolated_frame(point);
}

Frame Energy::vertex_frame(int vertex) const {
    const VertexCurvature& c = field_.at(vertex);
    Frame frame{c.normal, feature_direction(c, options_.feature), 0.0, c.umbilic};
    finish(frame, feature_curvature(c, options_.feature));
    return frame;
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
    const double kappa = mix(feature_curvature(a, options_.feature), feature_curvature(b, options_.feature));
    finish(frame, std::abs(kappa) < negligible_ ? 0.0 : kappa);
    return frame;
}

void Energy::finish(Frame& frame, double kappa) const {
    const double size = scales_.K * std::pow(std::abs(kappa) / scales_.K, options_.feature_exponent);
    frame.kappa = kappa < 0.0 ? -size : size;
}

ChordEnd Energy::chord_end(const Frame& frame, const Vec3& chord) {
    return {{chord.dot(frame.direction), chord.dot(frame.normal.cross(frame.direction))}, chord.norm()};
}

double Energy::numerator(const Frame& frame, const ChordEnd& e1, const ChordEnd& e2) const {
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

Measure measure(const Surface& surface, const Energy& energy, const Contour& contour) {
    Measure result;
    const std::size_t count = contour.points.size();
    const auto position = [&](std::size_t i) { return surface.position(contour.points[i % count]); };
    for (std::size_t i = 0; i < count; ++i) {
        const Frame frame = energy.frame(contour.points[i]);
        const ChordEnd in = Energy::chord_end(frame, position(i) - position(i + count - 1));
        const ChordEnd out = Energy::chord_end(frame, position(i + 1) - position(i));
        result.numerator += energy.numerator(frame, in, out);
        result.length += Energy::denominator(in, out);
    }
    if (!(result.length > 0.0)) throw InvalidInput("the contour has length 0: all its vertices lie at one point");
    result.ratio = result.numerator / result.length;
    result.objective = result.ratio;
    return result;
}

}  // namespace mrc
