// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/curvature.h>

#include "disk.h"
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
            queued_.push_back(0);
        }
        return n;
    }
    int vertex(int number) const { return vertices_[number]; }

    /// Calls visit(number, distance) for the vertices within `limit` of one. The distances are corrected until none falls any more,
    /// which over so few edges of like lengths takes less time than a heap.
    template <class Visit>
    void for_each_within(int start, double limit, Visit&& visit) {
        ++search_;
        near_.clear();
        queue_.clear();
        reach(start, 0.0);
        for (std::size_t i = 0; i < queue_.size(); ++i) {
            const int n = queue_[i];
            queued_[n] = 0;
            const double here = distance_[n];
            for (const Link* link = links(n); link->to >= 0; ++link) {
                if (here + link->length <= limit) reach(link->to, here + link->length);
            }
        }
        for (const int n : near_) visit(n, distance_[n]);
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
    std::vector<int> near_, queue_;  // of the search under way: all vertices met, and those whose neighbours are to be reached
    std::vector<char> queued_;

    void reach(int n, double distance) {
        if (met_in_[n] != search_) {
            near_.push_back(n);
        } else if (distance >= distance_[n]) {
            return;
        }
        met_in_[n] = search_;
        distance_[n] = distance;
        if (!queued_[n]) queue_.push_back(n);
        queued_[n] = 1;
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
          sigma_(options.curvature_smoothing * h),
          negligible_(1e-4 / h),
          near_(surface),
          disks_(surface, options.curvature_radius * h) {}

    const VertexCurvature& at(int vertex) {
        const int n = asked_.insert(vertex);
        if (n == static_cast<int>(curvatures_.size())) curvatures_.push_back(principal(smoothed(vertex), vertex_normal(vertex)));
        return curvatures_[n];
    }

    double dihedral(int halfedge) { return disks_.dihedral(halfedge); }

  private:
    const Surface& surface_;
    double sigma_, negligible_;
    NearGraph near_;
    DiskTensors disks_;
    IndexMap asked_;
    std::deque<VertexCurvature> curvatures_;  // a deque, so that references stay
    std::vector<Symmetric> tensors_;          // by number in near_
    std::vector<char> has_tensor_;

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
    const Symmetric& tensor(int n) {
        if (n >= static_cast<int>(tensors_.size())) {
            tensors_.resize(2 * n + 1);
            has_tensor_.resize(2 * n + 1, 0);
        }
        if (!has_tensor_[n]) {
            tensors_[n] = disks_.at(near_.vertex(n));
            has_tensor_[n] = 1;
        }
        return tensors_[n];
    }

    /// The tensors round a vertex, averaged term by term (Alliez et al. 2003).
    Symmetric smoothed(int vertex) {
        const int start = near_.number(vertex);
        if (sigma_ == 0.0) return tensor(start);
        Symmetric sum = Symmetric::Zero();
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
    VertexCurvature principal(const Symmetric& tensor, const Vec3& normal) const {
        Eigen::Matrix<double, 3, 2> basis;
        basis.col(0) = normal.unitOrthogonal();
        basis.col(1) = normal.cross(basis.col(0));
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
        solver.computeDirect(basis.transpose() * full(tensor) * basis);
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
