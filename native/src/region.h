// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flow.h"

#include <span>
#include <unordered_map>
#include <vector>

namespace mrc {

/// A 1-form on the edges of some triangles, linear inside each (Whitney).
class EdgeForm {
  public:
    explicit EdgeForm(const Surface& surface) : surface_(&surface) {}

    double on(int halfedge) const;
    void add(int halfedge, double value);

    /// The integral along a segment of an edge or across a triangle.
    double along(const SurfacePoint& from, const SurfacePoint& to) const;
    double along(const Contour& contour) const;

  private:
    const Surface* surface_;
    std::unordered_map<int, double> values_;  // by the lower half-edge of each edge

    int lower(int halfedge) const {
        const int twin = surface_->twin(halfedge);
        return twin >= 0 && twin < halfedge ? twin : halfedge;
    }
};

/// The region term of 6.1.2 by discrete Stokes: a form whose circulation around each face of the band is the face's density times
/// its area, so that along a closed contour it gives, up to a constant, what the contour encloses on its left. The constant is a
/// multiple of the flow, which every contour of the band passes once.
///
/// `density`: of each surface face, per area. `reached`: what the integral along the patch's given contour is to be: the change
/// of the enclosed integral since the first given contour.
EdgeForm region_form(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow,
                     std::span<const double> density, double reached, const Beat& beat = {});

/// The change of the integral of a density that a contour encloses on its left, from one closed contour to another that can be
/// moved into it. What it passes holds no border of the mesh; on a mesh without one it does not hold the face farthest from both.
double enclosed_change(const Surface& surface, std::span<const double> density, const Contour& from, const Contour& to,
                       const Beat& beat = {});

}  // namespace mrc
