// SPDX-License-Identifier: GPL-3.0-or-later
#include "curvature_field.h"

#include "disk_tensor.h"
#include "elementary_functions.h"
#include "index_map.h"
#include "local_scale.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace mrc {
namespace {

/// The polygon's unit normal times its angle at the vertex.
Vec3 weighted_normal(const Surface& surface, int face, int vertex) {
    const Vec3 area = polygon_area_vector(surface, face);
    const double size = area.norm();
    return size > 0.0 ? Vec3((angle_at(surface, face, vertex) / size) * area) : Vec3(Vec3::Zero());
}

}  // namespace

double angle_at(const Surface& surface, int face, int vertex) {
    const auto corners = surface.face(face);
    const auto i = static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
    const std::size_t n = corners.size();
    const Vec3 u = surface.position(corners[(i + 1) % n]) - surface.position(vertex);
    const Vec3 v = surface.position(corners[(i + n - 1) % n]) - surface.position(vertex);
    return elementary::atan2(u.cross(v).norm(), u.dot(v));
}

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
    for_each_face_at(surface, vertex, [&](int face) {
        area += polygon_area_vector(surface, face).norm() / static_cast<double>(surface.face(face).size());
    });
    return area;
}

Vec3 vertex_normal(const Surface& surface, int vertex) {
    Vec3 sum = Vec3::Zero();
    for_each_face_at(surface, vertex, [&](int face) { sum += weighted_normal(surface, face, vertex); });
    return sum.norm() > 1e-12 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
}

namespace {

/// Of the soft disk with the second moment of the disk B, convolved with a Gaussian of sigma `curvature_smoothing`: along each axis
/// that of a disk is radius^2 / 4, that of the soft disk radius^2 / 6.
double soft_radius(const Options& options) {
    const double radius = options.curvature_radius, sigma = options.curvature_smoothing;
    return std::sqrt(6.0 * (0.25 * radius * radius + sigma * sigma));
}

}  // namespace

class CurvatureField::Impl {
  public:
    Impl(const Surface& surface, const Options& options)
        : surface_(surface),
          soft_(options.curvature_smoothing > 0.0),
          radius_(soft_ ? soft_radius(options) : options.curvature_radius),
          scale_(surface),
          disks_(surface) {}

    VertexCurvature at(int vertex) {
        if (const int number = numbers_.find(vertex); number >= 0) return curvatures_[number];
        prepare(std::span(&vertex, 1), {});
        return curvatures_[numbers_.find(vertex)];
    }

    void prepare(std::span<const int> vertices, const Beat& beat) {
        if (vertices.size() > many) disks_.reserve(static_cast<int>(vertices.size()));
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            if (beat && i % 64 == 0) beat();
            if (numbers_.find(vertices[i]) >= 0) continue;
            curvatures_.push_back(evaluate(vertices[i]));
            numbers_.insert(vertices[i]);
        }
        // What the disks of so many vertices have cached takes more memory than it would save time from now on.
        if (vertices.size() > many) disks_ = DiskTensors(surface_);
    }

    double scale(int vertex) { return scale_.at(vertex); }
    double dihedral(int halfedge) { return disks_.dihedral(halfedge); }

  private:
    static constexpr std::size_t many = 200;

    const Surface& surface_;
    bool soft_;
    double radius_;  // in h
    LocalScale scale_;
    DiskTensors disks_;
    IndexMap numbers_;  // of the vertices in curvatures_
    std::vector<VertexCurvature> curvatures_;

    VertexCurvature evaluate(int vertex) {
        const double h = scale_.at(vertex);
        const Symmetric tensor = h > 0.0 ? disks_.at(vertex, radius_ * h, soft_) : Symmetric(Symmetric::Zero());
        return principal(tensor, vertex_normal(surface_, vertex), h > 0.0 ? 1e-4 / h : 0.0);
    }

    /// Eigenvalues in the tangent plane. The eigenvector along a crease belongs to the curvature across it: the two are swapped.
    static VertexCurvature principal(const Symmetric& tensor, const Vec3& normal, double negligible) {
        Eigen::Matrix<double, 3, 2> basis;
        basis.col(0) = normal.unitOrthogonal();
        basis.col(1) = normal.cross(basis.col(0));
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
        solver.computeDirect(basis.transpose() * full(tensor) * basis);
        const auto& values = solver.eigenvalues();
        VertexCurvature result;
        result.normal = normal;
        result.umbilic = values[1] - values[0] < negligible;
        result.kappa_min = std::abs(values[0]) < negligible ? 0.0 : values[0];
        result.kappa_max = std::abs(values[1]) < negligible ? 0.0 : values[1];
        result.direction_max = (basis * solver.eigenvectors().col(0)).normalized();
        result.direction_min = normal.cross(result.direction_max);
        return result;
    }
};

CurvatureField::CurvatureField(const Surface& surface, const Options& options) : impl_(std::make_unique<Impl>(surface, options)) {}
CurvatureField::~CurvatureField() = default;
CurvatureField::CurvatureField(CurvatureField&&) noexcept = default;

void CurvatureField::prepare(std::span<const int> vertices, const Beat& beat) const { impl_->prepare(vertices, beat); }
VertexCurvature CurvatureField::at(int vertex) const { return impl_->at(vertex); }
double CurvatureField::scale(int vertex) const { return impl_->scale(vertex); }
double CurvatureField::dihedral(int halfedge) const { return impl_->dihedral(halfedge); }

}  // namespace mrc
