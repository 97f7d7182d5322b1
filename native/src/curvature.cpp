// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/curvature.h>

#include <mrc/distances.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace mrc {
namespace {

using Mat3 = Eigen::Matrix3d;

/// Signed area of the part of the triangle (0, a, b) inside the circle of radius r about 0, in the plane.
double sector_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double r) {
    const Eigen::Vector2d d = b - a;
    const auto cross = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); };
    const auto wedge = [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
        return 0.5 * r * r * std::atan2(cross(p, q), p.dot(q));
    };
    const double length2 = d.squaredNorm();
    if (length2 == 0.0) return 0.0;
    const double middle = -a.dot(d) / length2;
    const double half2 = (r * r - (a + middle * d).squaredNorm()) / length2;
    if (half2 <= 0.0) return wedge(a, b);
    const double half = std::sqrt(half2);
    const double enter = std::clamp(middle - half, 0.0, 1.0), leave = std::clamp(middle + half, 0.0, 1.0);
    if (leave <= enter) return wedge(a, b);
    const Eigen::Vector2d p = a + enter * d, q = a + leave * d;
    return (enter > 0.0 ? wedge(a, p) : 0.0) + 0.5 * cross(p, q) + (leave < 1.0 ? wedge(q, b) : 0.0);
}

/// Area of a triangle inside the ball of radius r about 0.
double area_in_ball(const Vec3& a, const Vec3& b, const Vec3& c, double r) {
    const Vec3 cross = (b - a).cross(c - a);
    const double doubled = cross.norm();
    if (doubled == 0.0) return 0.0;
    if (std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}) <= r * r) return 0.5 * doubled;
    const Vec3 normal = cross / doubled;
    const double height = a.dot(normal);
    const double rest = r * r - height * height;
    if (rest <= 0.0) return 0.0;
    const Vec3 x = (b - a).normalized(), y = normal.cross(x);
    const auto flat = [&](const Vec3& p) { return Eigen::Vector2d(p.dot(x), p.dot(y)); };
    const Eigen::Vector2d p = flat(a), q = flat(b), s = flat(c);
    const double radius = std::sqrt(rest);
    return std::max(0.0, sector_area(p, q, radius) + sector_area(q, s, radius) + sector_area(s, p, radius));
}

/// Length of the segment ab inside the ball of radius r about 0.
double length_in_ball(const Vec3& a, const Vec3& b, double r) {
    const Vec3 d = b - a;
    const double length2 = d.squaredNorm();
    if (length2 == 0.0) return 0.0;
    const double middle = -a.dot(d) / length2;
    const double half2 = (r * r - (a + middle * d).squaredNorm()) / length2;
    if (half2 <= 0.0) return 0.0;
    const double half = std::sqrt(half2);
    return std::sqrt(length2) * std::max(0.0, std::min(1.0, middle + half) - std::max(0.0, middle - half));
}

/// Angle of a polygon at its corner i, in radians.
double corner_angle(const Surface& surface, std::span<const int> face, std::size_t i) {
    const std::size_t n = face.size();
    const Vec3 u = surface.position(face[(i + 1) % n]) - surface.position(face[i]);
    const Vec3 v = surface.position(face[(i + n - 1) % n]) - surface.position(face[i]);
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Calls visit(face) once for each polygon at a vertex, in ascending order.
template <class Visit>
void for_each_face(const Surface& surface, int vertex, Visit&& visit) {
    int last = -1;
    for (const int h : surface.outgoing(vertex)) {
        if (surface.halfedge_face(h) != last) visit(last = surface.halfedge_face(h));
    }
}

Vec3 any_tangent(const Vec3& normal) { return normal.unitOrthogonal(); }

}  // namespace

Vec3 polygon_area_vector(const Surface& surface, int face) {
    const auto vertices = surface.face(face);
    const Vec3& origin = surface.position(vertices[0]);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
        sum += (surface.position(vertices[i]) - origin).cross(surface.position(vertices[i + 1]) - origin);
    }
    return 0.5 * sum;
}

double vertex_area(const Surface& surface, int vertex) {
    double area = 0.0;
    for_each_face(surface, vertex, [&](int face) {
        area += polygon_area_vector(surface, face).norm() / static_cast<double>(surface.face(face).size());
    });
    return area;
}

class CurvatureField::Impl {
  public:
    Impl(const Surface& surface, double h, const Options& options)
        : surface_(surface),
          radius_(options.curvature_radius * h),
          sigma_(options.curvature_smoothing * h),
          negligible_(1e-4 / h) {}

    const VertexCurvature& at(int vertex) {
        const auto found = curvatures_.find(vertex);
        if (found != curvatures_.end()) return found->second;
        return curvatures_.emplace(vertex, principal(smoothed(vertex), vertex_normal(vertex))).first->second;
    }

    double dihedral(int halfedge) {
        const int twin = surface_.twin(halfedge);
        if (twin < 0) return 0.0;
        const Vec3 n1 = triangle_normal(halfedge / 3), n2 = triangle_normal(twin / 3);
        if (n1.isZero() || n2.isZero()) return 0.0;
        const Vec3 along = (surface_.position(surface_.to(halfedge)) - surface_.position(surface_.from(halfedge))).normalized();
        const double angle = std::atan2(along.dot(n1.cross(n2)), n1.dot(n2));
        return angle > std::numbers::pi - 1e-6 ? -angle : angle;
    }

  private:
    const Surface& surface_;
    double radius_, sigma_, negligible_;
    std::unordered_map<int, VertexCurvature> curvatures_;
    std::unordered_map<int, Mat3> tensors_;
    std::unordered_map<int, Vec3> normals_;
    // scratch of one disk
    std::vector<int> triangles_;
    std::vector<int> crossed_;

    /// Unit; of a triangle without area, its polygon's; zero where that has none either.
    Vec3 triangle_normal(int triangle) {
        const auto found = normals_.find(triangle);
        if (found != normals_.end()) return found->second;
        const auto& v = surface_.triangle(triangle);
        const Vec3 p = surface_.position(v[1]) - surface_.position(v[0]), q = surface_.position(v[2]) - surface_.position(v[0]);
        Vec3 area = p.cross(q);
        const double size = std::max({p.squaredNorm(), q.squaredNorm(), (p - q).squaredNorm()});
        if (area.norm() <= 1e-12 * size) area = polygon_area_vector(surface_, surface_.triangle_face(triangle));
        const Vec3 normal = area.norm() <= 1e-12 * size ? Vec3(Vec3::Zero()) : Vec3(area.normalized());
        return normals_.emplace(triangle, normal).first->second;
    }

    Vec3 vertex_normal(int vertex) const {
        Vec3 sum = Vec3::Zero();
        for_each_face(surface_, vertex, [&](int face) {
            const auto corners = surface_.face(face);
            const auto i = static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
            const Vec3 area = polygon_area_vector(surface_, face);
            if (area.norm() > 0.0) sum += corner_angle(surface_, corners, i) * area.normalized();
        });
        return sum.norm() > 1e-12 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
    }

    /// Eq. 3.4 at a vertex: F = 1 / |B| sum beta(e) |e in B| e e^T.
    const Mat3& tensor(int vertex) {
        const auto found = tensors_.find(vertex);
        if (found != tensors_.end()) return found->second;
        const Vec3& centre = surface_.position(vertex);
        collect_disk(vertex);
        double area = 0.0;
        Mat3 sum = Mat3::Zero();
        for (const int t : triangles_) {
            const auto& v = surface_.triangle(t);
            area += area_in_ball(surface_.position(v[0]) - centre, surface_.position(v[1]) - centre, surface_.position(v[2]) - centre,
                                 radius_);
        }
        for (const int h : crossed_) {
            const Vec3 a = surface_.position(surface_.from(h)) - centre, b = surface_.position(surface_.to(h)) - centre;
            const Vec3 unit = (b - a).normalized();
            sum += dihedral(h) * length_in_ball(a, b, radius_) * unit * unit.transpose();
        }
        if (area > 0.0) sum /= area;
        return tensors_.emplace(vertex, sum).first->second;
    }

    /// The triangles of the disk B, and a half-edge of each inner edge that it crosses: what hangs together with the vertex
    /// inside the ball, so that the other side of a thin plate stays out.
    void collect_disk(int vertex) {
        triangles_.clear();
        crossed_.clear();
        const Vec3& centre = surface_.position(vertex);
        const auto add = [&](int triangle) {
            if (std::ranges::find(triangles_, triangle) == triangles_.end()) triangles_.push_back(triangle);
        };
        for (const int h : surface_.outgoing(vertex)) add(h / 3);
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            for (int h = 3 * triangles_[i]; h < 3 * triangles_[i] + 3; ++h) {
                const int twin = surface_.twin(h);
                if (twin < 0) continue;
                const Vec3 a = surface_.position(surface_.from(h)) - centre, b = surface_.position(surface_.to(h)) - centre;
                if (length_in_ball(a, b, radius_) == 0.0) continue;
                if (std::ranges::find(crossed_, twin) == crossed_.end()) crossed_.push_back(h);
                add(twin / 3);
            }
        }
    }

    /// The tensors round a vertex, averaged term by term (Alliez et al. 2003).
    Mat3 smoothed(int vertex) {
        if (sigma_ == 0.0) return tensor(vertex);
        Mat3 sum = Mat3::Zero();
        double weights = 0.0;
        for (const auto& [neighbour, d] : distances_from(surface_, std::span(&vertex, 1), 3.0 * sigma_)) {
            const double weight = std::exp(-d * d / (2.0 * sigma_ * sigma_));
            sum += weight * tensor(neighbour);
            weights += weight;
        }
        return sum / weights;
    }

    /// Eigenvalues in the tangent plane. The eigenvector along a crease belongs to the curvature across it: the two are swapped.
    VertexCurvature principal(const Mat3& tensor, const Vec3& normal) const {
        Eigen::Matrix<double, 3, 2> basis;
        basis.col(0) = any_tangent(normal);
        basis.col(1) = normal.cross(basis.col(0));
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
        solver.computeDirect(basis.transpose() * tensor * basis);
        const auto& values = solver.eigenvalues();
        VertexCurvature result;
        result.normal = normal;
        result.umbilic = values[1] - values[0] < negligible_;
        result.kappa_min = std::abs(values[0]) < negligible_ ? 0.0 : values[0];
        result.kappa_max = std::abs(values[1]) < negligible_ ? 0.0 : values[1];
        result.direction_max = (basis * solver.eigenvectors().col(0)).normalized();
        result.direction_min = normal.cross(result.direction_max);
        return result;
    }
};

CurvatureField::CurvatureField(const Surface& surface, double h, const Options& options)
    : impl_(std::make_unique<Impl>(surface, h, options)) {}
CurvatureField::~CurvatureField() = default;
CurvatureField::CurvatureField(CurvatureField&&) noexcept = default;

const VertexCurvature& CurvatureField::at(int vertex) const { return impl_->at(vertex); }
double CurvatureField::dihedral(int halfedge) const { return impl_->dihedral(halfedge); }

}  // namespace mrc
