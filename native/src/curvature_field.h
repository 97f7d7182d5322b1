// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "beat.h"

#include <mrc/curvature.h>
#include <mrc/options.h>
#include <mrc/surface.h>

#include <memory>
#include <span>

namespace mrc {

/// The curvature tensor of the surface (3.4), evaluated on demand and cached.
///
/// It depends on the surface alone. Eq. 3.4 is averaged over the part of a ball that is connected to the vertex along the surface,
/// whose radius goes by the local scale h there; edges and area are cut exactly at the ball, so that it does not matter how a flat
/// or straight part is cut up. With `curvature_smoothing` the ball is as large as the disk B smoothed with a Gaussian, and its middle
/// counts for more. Hidden faces count. The surface must outlive the field.
class CurvatureField {
  public:
    CurvatureField(const Surface& surface, const Options& options);
    ~CurvatureField();
    CurvatureField(CurvatureField&&) noexcept;

    /// Evaluates it at many vertices at once, which is faster than one by one.
    void prepare(std::span<const int> vertices, const Beat& beat = {}) const;
    VertexCurvature at(int vertex) const;
    /// The local scale h of the surface there.
    double scale(int vertex) const;

    /// The signed dihedral angle of a half-edge's edge in radians: positive convex, negative concave, 0 on borders. Faces folded
    /// flat onto each other count as concave, since rounding alone would decide.
    double dihedral(int halfedge) const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Negative in what contours follow: in a valley, or on a ridge.
inline double feature_curvature(const VertexCurvature& c, Feature feature) {
    return feature == Feature::ridge ? -c.kappa_max : c.kappa_min;
}

/// Calls visit(face) once for each polygon at a vertex, in ascending order.
template <class Visit>
void for_each_face_at(const Surface& surface, int vertex, Visit&& visit) {
    int last = -1;
    for (const int h : surface.outgoing(vertex)) {
        if (surface.halfedge_face(h) != last) visit(last = surface.halfedge_face(h));
    }
}

/// The angle of a polygon at one of its vertices, in radians.
double angle_at(const Surface& surface, int face, int vertex);

/// The polygon's area vector (Newell): normal times area, whatever its triangulation.
Vec3 polygon_area_vector(const Surface& surface, int face);

/// Polygon normals weighted by corner angle, unit; the z axis where they cancel.
Vec3 vertex_normal(const Surface& surface, int vertex);

/// Of each polygon of n vertices at a vertex, 1 / n of the area.
double vertex_area(const Surface& surface, int vertex);

}  // namespace mrc
