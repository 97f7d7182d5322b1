// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/curvature.h>

#include "index_map.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

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

namespace {

/// The real edges round the vertices met so far, numbered as they are met, for many short searches for distances.
class NearGraph {
  public:
    explicit NearGraph(const Surface& surface) : surface_(surface) {}

    int number(int vertex) {
        const int n = numbers_.insert(vertex);
        if (n == static_cast<int>(vertices_.size())) {
            vertices_.push_back(vertex);
            first_link_.push_back(-1);
            distance_.push_back(0.0);
            met_in_.push_back(0);
        }
        return n;
    }
    int vertex(int number) const { return vertices_[number]; }

    /// Calls visit(number, distance) for the vertices within `limit` of one, from near to far.
    template <class Visit>
    void for_each_within(int start, double limit, Visit&& visit) {
        ++search_;
        heap_.clear();
        reach(start, 0.0);
        while (!heap_.empty()) {
            std::ranges::pop_heap(heap_, std::greater<>());
            const auto [distance, n] = heap_.back();
            heap_.pop_back();
            if (distance > distance_[n]) continue;
            visit(n, distance);
            for (const Link* link = links(n); link->to >= 0; ++link) {
                if (distance + link->length <= limit) reach(link->to, distance + link->length);
            }
        }
    }

  private:
    struct Link {
        int to;
        double length;
    };
    const Surface& surface_;
    IndexMap numbers_;
    std::vector<int> vertices_, first_link_;
    std::vector<Link> links_;  // of each vertex, once it is searched, closed by one that leads nowhere
    std::vector<double> distance_;
    std::vector<int> met_in_;  // the search that distance_ belongs to
    int search_ = 0;
    std::vector<std::pair<double, int>> heap_;

    void reach(int n, double distance) {
        if (met_in_[n] == search_ && distance >= distance_[n]) return;
        met_in_[n] = search_;
        distance_[n] = distance;
        heap_.emplace_back(distance, n);
        std::ranges::push_heap(heap_, std::greater<>());
    }

    const Link* links(int n) {
        if (first_link_[n] < 0) {
            const int begin = static_cast<int>(links_.size());
            const Vec3& here = surface_.position(vertices_[n]);
            surface_.for_each_real_edge(vertices_[n], [&](int neighbour, int) {
                links_.push_back({number(neighbour), (surface_.position(neighbour) - here).norm()});
            });
            links_.push_back({-1, 0.0});
            first_link_[n] = begin;
        }
        return links_.data() + first_link_[n];
    }
};

}  // namespace

class CurvatureField::Impl {
  public:
    Impl(const Surface& surface, double h, const Options& options)
        : surface_(surface),
          radius_(options.curvature_radius * h),
          sigma_(options.curvature_smoothing * h),
          negligible_(1e-4 / h),
          near_(surface) {}

    const VertexCurvature& at(int vertex) {
        const int n = asked_.insert(vertex);
        if (n == static_cast<int>(curvatures_.size())) curvatures_.push_back(principal(smoothed(vertex), vertex_normal(vertex)));
        return curvatures_[n];
    }

    double dihedral(int halfedge) {
        const int twin = surface_.twin(halfedge);
        if (twin < 0) return 0.0;
        const int n = edges_.insert(surface_.edge(halfedge));
        if (n == static_cast<int>(angles_.size())) angles_.push_back(dihedral_angle(halfedge, twin));
        return angles_[n];
    }

  private:
    const Surface& surface_;
    double radius_, sigma_, negligible_;
    NearGraph near_;
    IndexMap asked_, edges_, triangles_;
    std::deque<VertexCurvature> curvatures_;  // a deque, so that references stay
    std::vector<double> angles_;              // of edges
    std::vector<Vec3> normals_;               // of triangles
    std::vector<Mat3> tensors_;               // by number in near_
    std::vector<char> has_tensor_;
    std::vector<int> disk_, crossed_;  // scratch of one disk

    double dihedral_angle(int halfedge, int twin) {
        const Vec3 n1 = triangle_normal(halfedge / 3), n2 = triangle_normal(twin / 3);
        if (n1.isZero(0.0) || n2.isZero(0.0)) return 0.0;
        const Vec3 along = (surface_.position(surface_.to(halfedge)) - surface_.position(surface_.from(halfedge))).normalized();
        const double angle = std::atan2(along.dot(n1.cross(n2)), n1.dot(n2));
        return angle > std::numbers::pi - 1e-6 ? -angle : angle;
    }

    /// Unit; of a triangle without area, its polygon's; zero where that has none either.
    Vec3 triangle_normal(int triangle) {
        const int n = triangles_.insert(triangle);
        if (n < static_cast<int>(normals_.size())) return normals_[n];
        const auto& v = surface_.triangle(triangle);
        const Vec3 p = surface_.position(v[1]) - surface_.position(v[0]), q = surface_.position(v[2]) - surface_.position(v[0]);
        Vec3 area = p.cross(q);
        const double size = std::max({p.squaredNorm(), q.squaredNorm(), (p - q).squaredNorm()});
        if (area.norm() <= 1e-12 * size) area = polygon_area_vector(surface_, surface_.triangle_face(triangle));
        normals_.push_back(area.norm() <= 1e-12 * size ? Vec3(Vec3::Zero()) : Vec3(area.normalized()));
        return normals_.back();
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

    /// The tensor of a vertex by its number in near_.
    const Mat3& tensor(int n) {
        if (n >= static_cast<int>(tensors_.size())) {
            tensors_.resize(2 * n + 1);
            has_tensor_.resize(2 * n + 1, 0);
        }
        if (!has_tensor_[n]) {
            tensors_[n] = disk_tensor(near_.vertex(n));
            has_tensor_[n] = 1;
        }
        return tensors_[n];
    }

    /// Eq. 3.4 at a vertex: F = 1 / |B| sum beta(e) |e in B| e e^T.
    Mat3 disk_tensor(int vertex) {
        const Vec3& centre = surface_.position(vertex);
        collect_disk(vertex);
        double area = 0.0;
        Mat3 sum = Mat3::Zero();
        for (const int t : disk_) {
            const auto& v = surface_.triangle(t);
            area += area_in_ball(surface_.position(v[0]) - centre, surface_.position(v[1]) - centre,
                                 surface_.position(v[2]) - centre, radius_);
        }
        for (const int h : crossed_) {
            const Vec3 a = surface_.position(surface_.from(h)) - centre, b = surface_.position(surface_.to(h)) - centre;
            const Vec3 unit = (b - a).normalized();
            sum += (dihedral(h) * length_in_ball(a, b, radius_)) * (unit * unit.transpose());
        }
        if (area > 0.0) sum /= area;
        return sum;
    }

    /// The triangles of the disk B, and a half-edge of each inner edge that it crosses: what hangs together with the vertex
    /// inside the ball, so that the other side of a thin plate stays out.
    void collect_disk(int vertex) {
        disk_.clear();
        crossed_.clear();
        const Vec3& centre = surface_.position(vertex);
        const auto add = [&](int triangle) {
            if (std::ranges::find(disk_, triangle) == disk_.end()) disk_.push_back(triangle);
        };
        for (const int h : surface_.outgoing(vertex)) add(h / 3);
        for (std::size_t i = 0; i < disk_.size(); ++i) {
            for (int h = 3 * disk_[i]; h < 3 * disk_[i] + 3; ++h) {
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
        const int start = near_.number(vertex);
        if (sigma_ == 0.0) return tensor(start);
        Mat3 sum = Mat3::Zero();
        double weights = 0.0;
        // On grids neighbours lie at just 3 sigma: rounding must not decide.
        near_.for_each_within(start, 3.0 * sigma_ * (1.0 + 1e-9), [&](int n, double d) {
            const double weight = std::exp(-d * d / (2.0 * sigma_ * sigma_));
            sum += weight * tensor(n);
            weights += weight;
        });
        return sum / weights;
    }

    /// Eigenvalues in the tangent plane. The eigenvector along a crease belongs to the curvature across it: the two are swapped.
    VertexCurvature principal(const Mat3& tensor, const Vec3& normal) const {
        Eigen::Matrix<double, 3, 2> basis;
        basis.col(0) = normal.unitOrthogonal();
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
