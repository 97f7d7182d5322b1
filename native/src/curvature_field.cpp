// SPDX-License-Identifier: GPL-3.0-or-later
#include "curvature_field.h"

#include "disk_tensor.h"
#include "elementary_functions.h"
#include "index_map.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace mrc {
namespace {

/// Angle of a polygon at its corner i, in radians.
double corner_angle(const Surface& surface, std::span<const int> face, std::size_t i) {
    const std::size_t n = face.size();
    const Vec3 u = surface.position(face[(i + 1) % n]) - surface.position(face[i]);
    const Vec3 v = surface.position(face[(i + n - 1) % n]) - surface.position(face[i]);
    return elementary::atan2(u.cross(v).norm(), u.dot(v));
}

/// Calls visit(face) once for each polygon at a vertex, in ascending order.
template <class Visit>
void for_each_face_at(const Surface& surface, int vertex, Visit&& visit) {
    int last = -1;
    for (const int h : surface.outgoing(vertex)) {
        if (surface.halfedge_face(h) != last) visit(last = surface.halfedge_face(h));
    }
}

/// The polygon's unit normal times its angle at the vertex.
Vec3 weighted_normal(const Surface& surface, int face, int vertex) {
    const auto corners = surface.face(face);
    const auto i = static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
    const Vec3 area = polygon_area_vector(surface, face);
    const double size = area.norm();
    return size > 0.0 ? Vec3((corner_angle(surface, corners, i) / size) * area) : Vec3(Vec3::Zero());
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

/// The real edges around the vertices met so far, numbered as they are met.
class NearGraph {
  public:
    struct Link {
        int to;
        double length;
    };

    explicit NearGraph(const Surface& surface) : surface_(surface) {}

    int number(int vertex) {
        const int n = numbers_.insert(vertex);
        if (n == size()) {
            vertices_.push_back(vertex);
            first_link_.push_back(-1);
        }
        return n;
    }
    int vertex(int number) const { return vertices_[number]; }
    int size() const { return static_cast<int>(vertices_.size()); }

    /// Reads the edges around a vertex; until then it has no links.
    void expand(int n) {
        if (first_link_[n] >= 0) return;
        const int begin = static_cast<int>(links_.size());
        const Vec3& here = surface_.position(vertices_[n]);
        surface_.for_each_real_edge(vertices_[n], [&](int neighbor, int) {
            links_.push_back({number(neighbor), (surface_.position(neighbor) - here).norm()});
        });
        links_.push_back({-1, 0.0});
        first_link_[n] = begin;
    }

    /// Ends with a link to -1.
    const Link* links(int n) const { return links_.data() + first_link_[n]; }

  private:
    const Surface& surface_;
    IndexMap numbers_;
    std::vector<int> vertices_, first_link_;
    std::vector<Link> links_;
};

/// Searches for short distances, one after the other in the same memory.
class NearSearch {
  public:
    /// The vertices within `limit` of the start, which is nearest to itself. The distances are corrected until none falls any
    /// more, which over so few edges of like lengths takes less time than a heap. `expand` is called for a vertex before its
    /// links are read.
    template <class Expand>
    std::span<const int> run(const NearGraph& graph, std::span<const int> starts, double limit, Expand&& expand) {
        ++search_;
        near_.clear();
        queue_.clear();
        make_room(graph);
        for (const int start : starts) reach(start, 0.0);
        for (std::size_t i = 0; i < queue_.size(); ++i) {
            const int n = queue_[i];
            nodes_[n].queued = false;
            expand(n);
            make_room(graph);
            const double here = nodes_[n].distance;
            for (const NearGraph::Link* link = graph.links(n); link->to >= 0; ++link) {
                if (here + link->length <= limit) reach(link->to, here + link->length);
            }
        }
        return near_;
    }
    double distance(int n) const { return nodes_[n].distance; }

  private:
    struct Node {
        double distance = 0.0;
        int search = 0;  // that the distance belongs to
        bool queued = false;
    };
    std::vector<Node> nodes_;
    int search_ = 0;
    std::vector<int> near_, queue_;  // all vertices met, and those whose neighbors are to be reached

    void make_room(const NearGraph& graph) {
        if (static_cast<int>(nodes_.size()) < graph.size()) nodes_.resize(2 * graph.size());
    }

    void reach(int n, double distance) {
        Node& node = nodes_[n];
        if (node.search != search_) {
            near_.push_back(n);
        } else if (distance >= node.distance) {
            return;
        }
        if (node.search != search_ || !node.queued) queue_.push_back(n);
        node = {distance, search_, true};
    }
};

}  // namespace

class CurvatureField::Impl {
  public:
    Impl(const Surface& surface, double h, const Options& options)
        : surface_(surface),
          radius_(options.curvature_radius * h),
          sigma_(options.curvature_smoothing * h),
          limit_(3.0 * sigma_ * (1.0 + 1e-9)),  // on grids neighbors lie at just 3 sigma: rounding must not decide
          negligible_(1e-4 / h),
          near_(surface),
          disks_(surface, radius_) {}

    VertexCurvature at(int vertex) {
        const int n = near_.number(vertex);
        if (n >= static_cast<int>(place_.size()) || place_[n] < 0) prepare(std::span(&vertex, 1), {});
        return curvatures_[place_[n]];
    }

    /// In three steps, of which the first finds all that the others read: the vertices nearby, their tensors, and the curvatures.
    void prepare(std::span<const int> vertices, const Beat& beat) {
        const std::vector<int> fresh = without_curvature(vertices);
        if (fresh.empty()) return;
        make_tensors(fresh, beat);
        for (std::size_t i = 0; i < fresh.size(); ++i) {
            if (beat && i % 64 == 0) beat();
            curvatures_.push_back(principal(smoothed(fresh[i]), vertex_normal(surface_, near_.vertex(fresh[i]))));
            place_[fresh[i]] = static_cast<int>(curvatures_.size()) - 1;
        }
    }

    double dihedral(int halfedge) { return disks_.dihedral(halfedge); }

  private:
    static constexpr std::size_t many = 200;

    const Surface& surface_;
    double radius_, sigma_, limit_, negligible_;
    NearGraph near_;
    NearSearch search_;
    DiskTensors disks_;
    std::vector<VertexCurvature> curvatures_;
    // Of each vertex by its number in near_:
    std::vector<int> place_;  // in curvatures_, or -1
    std::vector<Symmetric> tensors_;
    std::vector<char> has_tensor_;

    std::vector<int> without_curvature(std::span<const int> vertices) {
        std::vector<int> fresh;
        fresh.reserve(vertices.size());
        for (const int v : vertices) {
            const int n = near_.number(v);
            if (n >= static_cast<int>(place_.size())) place_.resize(2 * n + 1, -1);
            if (place_[n] < 0) fresh.push_back(n);
        }
        return fresh;
    }

    void make_tensors(const std::vector<int>& fresh, const Beat& beat) {
        const auto nearby = search_.run(near_, fresh, limit_, [&, met = 0](int n) mutable {
            if (beat && ++met % 1024 == 0) beat();
            near_.expand(n);
        });
        tensors_.resize(near_.size());
        has_tensor_.resize(near_.size(), 0);
        std::vector<int> missing;
        std::ranges::copy_if(nearby, std::back_inserter(missing), [&](int n) { return !has_tensor_[n]; });
        if (missing.size() > many) disks_.reserve(static_cast<int>(missing.size()));
        for (std::size_t i = 0; i < missing.size(); ++i) {
            if (beat && i % 64 == 0) beat();
            tensors_[missing[i]] = disks_.at(near_.vertex(missing[i]));
            has_tensor_[missing[i]] = 1;
        }
        // What the disks of so many vertices have cached takes more memory than it would save time from now on.
        if (missing.size() > many) disks_ = DiskTensors(surface_, radius_);
    }

    /// The tensors around a vertex, averaged term by term (Alliez et al. 2003).
    Symmetric smoothed(int n) {
        if (!std::isnormal(sigma_ * sigma_)) return tensors_[n];  // no smoothing, or over no length
        Symmetric sum = Symmetric::Zero();
        double weights = 0.0;
        for (const int other : search_.run(near_, std::span(&n, 1), limit_, [](int) {})) {
            const double d = search_.distance(other), weight = elementary::exp(-d * d / (2.0 * sigma_ * sigma_));
            sum += weight * tensors_[other];
            weights += weight;
        }
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

void CurvatureField::prepare(std::span<const int> vertices, const Beat& beat) const { impl_->prepare(vertices, beat); }
VertexCurvature CurvatureField::at(int vertex) const { return impl_->at(vertex); }
double CurvatureField::dihedral(int halfedge) const { return impl_->dihedral(halfedge); }

}  // namespace mrc
