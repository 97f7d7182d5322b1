// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <functional>
#include <span>
#include <vector>

namespace mrc {

using Vec3 = Eigen::Vector3d;

inline constexpr int no_element = -1;  ///< instead of an id: there is none

/// The point (1 - t) a + t b of the mesh edge ab; a vertex v is (v, v, 0).
struct SurfacePoint {
    int a = no_element;
    int b = no_element;
    double t = 0.0;

    bool is_vertex() const { return a == b; }
    bool operator==(const SurfacePoint&) const = default;
};

inline SurfacePoint vertex_point(int vertex) { return {vertex, vertex, 0.0}; }

/// A closed loop or an open curve on the surface. A closed contour does not repeat its first point.
struct Contour {
    std::vector<SurfacePoint> points;
    bool closed = true;

    bool operator==(const Contour&) const = default;
};

Contour vertex_contour(std::span<const int> vertices, bool closed = true);

/// Called often, on the caller's thread, with the fraction done, which rises from 0 to 1. False cancels; an exception cancels and
/// reaches the caller.
using Progress = std::function<bool(double)>;

}  // namespace mrc
