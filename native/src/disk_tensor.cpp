// SPDX-License-Identifier: GPL-3.0-or-later
#include "disk_tensor.h"

#include "curvature_field.h"
#include "elementary_functions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrc {
namespace {

/// The angle from p on to q, turning left, from 0 to 2 pi.
double turn(const Vec2& p, const Vec2& q) {
    const double angle = elementary::atan2(cross(p, q), p.dot(q));
    return angle >= 0.0 ? angle : angle > -1e-9 ? 0.0 : angle + 2.0 * std::numbers::pi;
}

/// A square that underflows is zero: what has it has no length, and its reciprocal may not be finite.
double normal_or_zero(double square) { return std::isnormal(square) ? square : 0.0; }

/// Unit; of a triangle without area, its polygon's; zero where that has none either.
Vec3 triangle_normal(const Surface& surface, int triangle) {
    const auto& v = surface.triangle(triangle);
    const Vec3 p = surface.position(v[1]) - surface.position(v[0]), q = surface.position(v[2]) - surface.position(v[0]);
    Vec3 area = p.cross(q);
    const double size = std::max({p.squaredNorm(), q.squaredNorm(), (p - q).squaredNorm()});
    if (area.norm() <= 1e-12 * size) area = polygon_area_vector(surface, surface.triangle_face(triangle));
    return area.norm() <= 1e-12 * size ? Vec3(Vec3::Zero()) : Vec3(area.normalized());
}

}  // namespace

void DiskTensors::reserve(int vertices) {
    const int triangles = 3 * vertices, edges = 5 * vertices;
    triangle_numbers_.reserve(triangles);
    triangles_.reserve(triangles);
    met_.reserve(triangles);
    edge_numbers_.reserve(edges);
    edges_.reserve(edges);
    spans_.reserve(edges);
}

Symmetric DiskTensors::at(int vertex, double radius, bool soft) {
    const Vec3& center = surface_->position(vertex);
    radius2_ = radius * radius;
    soft_ = soft;
    ++disk_count_;
    disk_.clear();
    for (const int h : surface_->outgoing(vertex)) meet(triangle_number(h / 3));
    double area = 0.0;
    Symmetric sum = Symmetric::Zero();
    for (std::size_t i = 0; i < disk_.size(); ++i) {
        bool whole = true;
        for (int side = 0; side < 3; ++side) {
            const int edge = triangles_[disk_[i]].edges[side];
            const bool met = cut(edge, center, sum);
            whole &= met && spans_[edge].enter == 0.0 && spans_[edge].leave == 1.0;
            if (!met) continue;
            if (const int next = neighbor(disk_[i], side); next != none) meet(next);
        }
        area += whole ? whole_area(triangles_[disk_[i]], center) : area_inside(triangles_[disk_[i]], center);
    }
    if (area > 0.0) sum /= area;
    return sum;
}

void DiskTensors::meet(int number) {
    if (met_[number] == disk_count_) return;
    met_[number] = disk_count_;
    disk_.push_back(number);
}

/// Intersects the edge with the ball. The first time in a disk, it adds the bending of the part inside. False where none is.
bool DiskTensors::cut(int edge, const Vec3& center, Symmetric& sum) {
    Span& span = spans_[edge];
    if (span.disk == disk_count_) return span.leave > span.enter;
    const Edge& e = edges_[edge];
    span = {disk_count_, 0.0, 0.0};
    const Vec3 start = e.start - center;
    const double along = start.dot(e.vector), start2 = start.squaredNorm();
    if (start2 <= radius2_ && start2 + 2.0 * along + e.length2 <= radius2_ && e.length2 > 0.0) {  // most edges lie wholly inside
        span.leave = 1.0;
        sum += (soft_ ? 1.0 - (start2 + along + e.length2 / 3.0) / radius2_ : 1.0) * e.bending;
        return true;
    }
    const double middle = -along * e.inverse_length2;
    const double half2 = (radius2_ - (start + middle * e.vector).squaredNorm()) * e.inverse_length2;
    if (half2 <= 0.0) return false;
    const double half = std::sqrt(half2);
    span.enter = std::clamp(middle - half, 0.0, 1.0);
    span.leave = std::clamp(middle + half, 0.0, 1.0);
    if (span.leave <= span.enter) return false;
    const double a = span.enter, b = span.leave;
    const double mean2 = start2 + along * (a + b) + e.length2 * (a * a + a * b + b * b) / 3.0;  // of the distance squared
    sum += (b - a) * (soft_ ? 1.0 - mean2 / radius2_ : 1.0) * e.bending;
    return true;
}

/// Of a triangle wholly inside.
double DiskTensors::whole_area(const Triangle& t, const Vec3& center) const {
    if (!soft_) return 0.5 * t.doubled_area;
    const auto& v = surface_->triangle(t.id);
    const Vec3 a = surface_->position(v[0]) - center, b = surface_->position(v[1]) - center, c = surface_->position(v[2]) - center;
    const double mean2 = (a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + a.dot(b) + b.dot(c) + c.dot(a)) / 6.0;
    return 0.5 * t.doubled_area * (1.0 - mean2 / radius2_);
}

/// The area of the triangle inside the ball, by Green's theorem: straight pieces of its sides, and arcs of the circle in its plane
/// that join them, all turning left around the area. Soft, with rho the distance from the foot of the center in the plane and z its
/// height, it is the integral of (R^2 - z^2 - rho^2) / R^2.
double DiskTensors::area_inside(const Triangle& t, const Vec3& center) const {
    if (t.doubled_area == 0.0) return 0.0;
    const Vec3 away = center - t.origin;
    const double height = away.dot(t.normal);
    const double radius2 = radius2_ - height * height;
    if (radius2 <= 0.0) return 0.0;
    const Vec2 foot(away.dot(t.x), away.dot(t.y));
    const std::array<Vec2, 3> corners{-foot, t.second - foot, t.third - foot};
    const auto outside = [&](const Vec2& p) { return p.squaredNorm() > radius2; };
    if (std::ranges::none_of(corners, outside)) return whole_area(t, center);
    // Twice what lies between the foot and a straight piece or an arc.
    const auto line = [&](const Vec2& p, const Vec2& q) {
        if (!soft_) return cross(p, q);
        return cross(p, q) * (radius2 - (p.squaredNorm() + p.dot(q) + q.squaredNorm()) / 6.0) / radius2_;
    };
    const auto arc = [&](double angle) { return radius2 * angle * (soft_ ? 0.5 * radius2 / radius2_ : 1.0); };
    struct Piece {
        Vec2 from, to;
        bool starts_inside, ends_inside;
    };
    std::array<Piece, 3> pieces;
    int count = 0;
    double doubled = 0.0;
    bool foot_inside = true;
    for (int side = 0; side < 3; ++side) {
        const Vec2 &a = corners[side], vector = corners[(side + 1) % 3] - a;
        foot_inside &= cross(a, vector) >= 0.0;
        const Span& span = spans_[t.edges[side]];
        if (span.leave <= span.enter) continue;
        const double enter = t.forward[side] ? span.enter : 1.0 - span.leave,
                     leave = t.forward[side] ? span.leave : 1.0 - span.enter;
        pieces[count] = {a + enter * vector, a + leave * vector, enter == 0.0, leave == 1.0};
        doubled += line(pieces[count].from, pieces[count].to);
        ++count;
    }
    if (count == 0) return foot_inside ? 0.5 * arc(2.0 * std::numbers::pi) : 0.0;
    if (count == 1) {
        // One side alone cuts the circle: more than half of it is inside, or less; nothing where a corner just touches it.
        const double cut_off = std::abs(elementary::atan2(cross(pieces[0].from, pieces[0].to), pieces[0].from.dot(pieces[0].to)));
        return 0.5 * (doubled + arc(foot_inside ? 2.0 * std::numbers::pi - cut_off : cut_off));
    }
    for (int i = 0; i < count; ++i) {
        const Piece &last = pieces[i], &next = pieces[(i + 1) % count];
        if (!last.ends_inside || !next.starts_inside) doubled += arc(turn(last.to, next.from));
    }
    return std::max(0.0, 0.5 * doubled);
}

int DiskTensors::triangle_number(int triangle) {
    const int number = triangle_numbers_.insert(triangle);
    if (number < static_cast<int>(triangles_.size())) return number;
    const auto& v = surface_->triangle(triangle);
    const Vec3 &a = surface_->position(v[0]), p = surface_->position(v[1]) - a, q = surface_->position(v[2]) - a;
    const Vec3 area = p.cross(q);
    Triangle t{};
    t.id = triangle;
    t.origin = a;
    t.doubled_area = std::sqrt(normal_or_zero(area.squaredNorm()));
    if (t.doubled_area > 0.0) {
        t.normal = area / t.doubled_area;
        t.x = p.normalized();
        t.y = t.normal.cross(t.x);
        t.second = {p.norm(), 0.0};
        t.third = {q.dot(t.x), q.dot(t.y)};
    }
    t.neighbors.fill(unknown);
    triangles_.push_back(t);
    met_.push_back(0);
    for (int side = 0; side < 3; ++side) {
        const int edge = edge_number(3 * triangle + side);
        triangles_[number].edges[side] = edge;
        triangles_[number].forward[side] = edges_[edge].start == surface_->position(surface_->from(3 * triangle + side));
    }
    return number;
}

int DiskTensors::neighbor(int number, int side) {
    if (triangles_[number].neighbors[side] == unknown) {
        const int twin = surface_->twin(3 * triangles_[number].id + side);
        const int next = twin < 0 ? none : triangle_number(twin / 3);
        triangles_[number].neighbors[side] = next;
    }
    return triangles_[number].neighbors[side];
}

int DiskTensors::edge_number(int halfedge) {
    const int number = edge_numbers_.insert(surface_->edge(halfedge));
    if (number < static_cast<int>(edges_.size())) return number;
    // The same direction whatever half-edge is asked for, so that a vertex always has the same curvature to the last bit.
    const int from = surface_->from(halfedge), to = surface_->to(halfedge);
    const Vec3 start = surface_->position(std::min(from, to)), vector = surface_->position(std::max(from, to)) - start;
    const double length2 = normal_or_zero(vector.squaredNorm()), length = std::sqrt(length2);
    edges_.push_back({start, vector, length2, length2 > 0.0 ? 1.0 / length2 : 0.0, 0.0, Symmetric::Zero()});
    spans_.emplace_back();
    const int twin = surface_->twin(halfedge);
    const double angle = angle_at(twin >= 0 ? std::min(halfedge, twin) : halfedge);
    if (length > 0.0) {
        const Vec3 e = vector / length;
        const double weight = angle * length;
        edges_[number].bending << weight * e.x() * e.x(), weight * e.y() * e.y(), weight * e.z() * e.z(), weight * e.x() * e.y(),
            weight * e.x() * e.z(), weight * e.y() * e.z();
    }
    edges_[number].angle = angle;
    return number;
}

/// A fold flat on itself has no sign under rounding: it counts as concave.
double DiskTensors::angle_at(int halfedge) const {
    const int twin = surface_->twin(halfedge);
    if (twin < 0) return 0.0;
    const Vec3 n1 = triangle_normal(*surface_, halfedge / 3), n2 = triangle_normal(*surface_, twin / 3);
    if (n1.isZero(0.0) || n2.isZero(0.0)) return 0.0;
    const Vec3 along = (surface_->position(surface_->to(halfedge)) - surface_->position(surface_->from(halfedge))).normalized();
    const double angle = elementary::atan2(along.dot(n1.cross(n2)), n1.dot(n2));
    return angle > std::numbers::pi - 1e-6 ? -angle : angle;
}

}  // namespace mrc
