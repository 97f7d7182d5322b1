// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "index_map.h"
#include "plane.h"

#include <mrc/surface.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mrc {

/// A symmetric matrix as xx, yy, zz, xy, xz, yz.
using Symmetric = Eigen::Matrix<double, 6, 1>;

inline Eigen::Matrix3d full(const Symmetric& s) {
    Eigen::Matrix3d matrix;
    matrix << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return matrix;
}

/// The curvature tensor of eq. 3.4 at single vertices: F = 1 / |B| sum beta(e) |e in B| e e^T, with B the disk about the vertex.
///
/// The disk is the part of a ball that is connected to the vertex along the surface, so that the other side of a thin plate stays
/// out. A soft disk weighs edges and area with 1 - d^2 / radius^2, d being the distance from the vertex. What depends on an edge or a
/// triangle alone is kept, since the disks of neighbors overlap.
class DiskTensors {
  public:
    explicit DiskTensors(const Surface& surface) : surface_(&surface) {}

    /// Reserves what the disks of so many vertices need in most meshes.
    void reserve(int vertices);
    Symmetric at(int vertex, double radius, bool soft);
    /// The signed angle between the normals at a half-edge's edge, in radians, negative where concave; 0 at borders.
    double dihedral(int halfedge) { return edges_[edge_number(halfedge)].angle; }

  private:
    struct Edge {
        Vec3 start, vector;               // from its start to its end
        double length2, inverse_length2;  // 0 where it has no length
        double angle;
        Symmetric bending;  // angle times length times e e^T
    };
    struct Triangle {
        int id;
        Vec3 origin, x, y, normal;  // its own frame, in its first corner
        Vec2 second, third;         // the other corners in it
        double doubled_area;
        std::array<int, 3> edges, neighbors;  // numbers; a neighbor not yet met is `unknown`
        std::array<bool, 3> forward;          // whether the side runs along with its edge
    };
    /// The part of an edge inside the current ball, as fractions of the edge; empty where enter = leave.
    struct Span {
        int disk = 0;
        double enter = 0.0, leave = 0.0;
    };
    static constexpr int unknown = -2, none = -1;

    const Surface* surface_;
    double radius2_ = 0.0;  // of the current disk
    bool soft_ = false;
    IndexMap edge_numbers_, triangle_numbers_;
    std::vector<Edge> edges_;
    std::vector<Span> spans_;  // of edges_
    std::vector<Triangle> triangles_;
    std::vector<int> met_;   // of triangles_: the last disk that it was met in
    std::vector<int> disk_;  // the triangles of the current disk
    int disk_count_ = 0;

    int edge_number(int halfedge);
    int triangle_number(int triangle);
    int neighbor(int number, int side);
    double angle_at(int halfedge) const;
    void meet(int number);
    bool cut(int edge, const Vec3& center, Symmetric& sum);
    double area_inside(const Triangle& triangle, const Vec3& center) const;
    double whole_area(const Triangle& triangle, const Vec3& center) const;
};

}  // namespace mrc
