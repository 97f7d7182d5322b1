// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/constraints.h>
#include "distances.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <span>
#include <unordered_map>
#include <vector>

namespace mrc {

/// The potential of the attractors (4.5). Whole painted regions may be attractors: a point asks only those nearby, and distances
/// from each are computed only up to its radius.
class Attraction {
  public:
    /// The surface must outlive it.
    Attraction(const Surface& surface, std::span<const Attractor> attractors);

    /// Sum of strength w(d) over the attractors, w = exp(-d^2 / (2 sigma^2)) up to the radius.
    double at(const SurfacePoint& point) const;

  private:
    using Box = Eigen::AlignedBox3d;
    const Surface& surface_;
    std::vector<Attractor> attractors_;
    std::vector<Box> reaches_;  // boxes around their radii
    Eigen::KdBVH<double, 3, int> tree_;
    mutable std::unordered_map<int, std::vector<int>> around_;  // of a vertex: the attractors near it, ascending
    mutable std::unordered_map<int, DistanceField> fields_;     // of an attractor

    const std::vector<int>& around(int vertex) const;
    double felt(int attractor, const SurfacePoint& point) const;
    const DistanceField& field(int attractor) const;
};

}  // namespace mrc
