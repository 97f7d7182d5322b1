// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/options.h>
#include <mrc/surface.h>

#include <vector>

namespace mrc {

/// Principal curvatures at a vertex (3.4). Positive where the surface is convex; the unit is one over the mesh's unit of length.
///
/// They depend on the surface alone, and not on how a flat or straight part of it is cut up. Eq. 3.4 is averaged over a disk whose
/// radius goes by h, the local scale of the surface at the vertex: how wide the polygons there are across, 0.84 of the edges of a
/// regular grid, the short side of long rectangles and of the long triangles of CAD meshes.
struct VertexCurvature {
    double kappa_min = 0.0, kappa_max = 0.0;  ///< exactly 0 where smaller than 1e-4 / h in magnitude
    Vec3 direction_min = Vec3::Zero();        ///< unit, tangent; along a ridge it runs along the crest
    Vec3 direction_max = Vec3::Zero();        ///< unit, tangent; along a concave crease it runs along the crease
    Vec3 normal = Vec3::Zero();               ///< polygon normals weighted by corner angle, unit
    bool umbilic = true;                      ///< the curvatures differ by less than 1e-4 / h: the directions mean nothing
};

/// The curvatures at all vertices.
/// `progress` is called every few milliseconds, with 0 until all is done; where it cancels, the result is empty.
/// @throws InvalidInput for options out of range and where every edge has length 0.
std::vector<VertexCurvature> curvature(const Surface& surface, const Options& options = {}, const Progress& progress = {});

}  // namespace mrc
