// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/options.h>
#include <mrc/surface.h>

#include <memory>
#include <span>

namespace mrc {

/// Principal curvatures at a vertex. Positive where the surface is convex; the unit is one over the mesh's unit of length.
struct VertexCurvature {
    double kappa_min = 0.0, kappa_max = 0.0;  ///< exactly 0 where below 1e-4 / h in size
    Vec3 direction_min = Vec3::Zero();        ///< unit, tangent; along a ridge it runs along the crest
    Vec3 direction_max = Vec3::Zero();        ///< unit, tangent; along a concave crease it runs along the crease
    Vec3 normal = Vec3::Zero();               ///< polygon normals weighted by corner angle, unit
    bool umbilic = true;                      ///< the curvatures differ by less than 1e-4 / h: the directions mean nothing
};

/// The curvature tensor of the surface (3.4), evaluated where it is asked for and remembered.
///
/// It depends on the surface and on h alone. Eq. 3.4 is averaged over the part of a ball of radius `curvature_radius` h that hangs
/// together with the vertex along the surface, then smoothed with a Gaussian of sigma `curvature_smoothing` h in the distance
/// along the surface. Hidden faces count. The surface must outlive the field.
class CurvatureField {
  public:
    /// `h`: the mean edge length, above 0.
    CurvatureField(const Surface& surface, double h, const Options& options);
    ~CurvatureField();
    CurvatureField(CurvatureField&&) noexcept;

    /// Evaluates it at many vertices at once, which is faster than one by one.
    void prepare(std::span<const int> vertices, const Beat& beat = {}) const;
    VertexCurvature at(int vertex) const;

    /// The signed dihedral angle of a half-edge's edge in radians: positive convex, negative concave, 0 on borders. Faces folded
    /// flat onto each other count as concave, since rounding alone would decide.
    double dihedral(int halfedge) const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// The polygon's area vector (Newell): normal times area, whatever its triangulation.
Vec3 polygon_area_vector(const Surface& surface, int face);

/// Polygon normals weighted by corner angle, unit; the z axis where they cancel.
Vec3 vertex_normal(const Surface& surface, int vertex);

/// Equal shares of the areas of the polygons at a vertex.
double vertex_area(const Surface& surface, int vertex);

}  // namespace mrc
