// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <functional>
#include <span>
#include <vector>

/// Surfaces whose lengths, angles and curvatures are known. Faces wind counterclockwise, seen from outside or from above.
namespace made {

using mrc::Vec3;

struct Mesh {
    std::vector<Vec3> points;
    std::vector<std::vector<int>> faces;

    mrc::Surface surface(const std::vector<int32_t>& hidden = {}) const;
    Mesh mapped(const std::function<Vec3(const Vec3&)>& map) const;
    /// Every face turned over: what was convex is concave.
    Mesh inside_out() const;
    /// Vertex v becomes vertex number[v].
    Mesh renumbered(std::span<const int> number) const;
    /// Both meshes, the other's vertices behind these.
    Mesh beside(const Mesh& other) const;
};

/// Unit squares in the plane z = 0: vertex j * (columns + 1) + i lies at (i, j, 0).
Mesh plate(int columns, int rows);
/// Quads around the z axis, open at both ends: vertex row * around + i, row by row upwards.
Mesh tube(int around, int rows, double radius = 1.0, double step = 0.25);
/// Quads around the z axis, from the (radius, height) of its rows, without caps.
Mesh turned(std::span<const std::pair<double, double>> profile, int around);
/// Quads around the z axis, rings of radius 3 and a tube of radius 1: vertex i * across + j, with j = 0 outermost.
Mesh torus(int around, int across, double ring = 3.0, double tube = 1.0);
/// Quads between two poles of triangles: the first and the last vertex.
Mesh ball(int around, int rings, double radius = 1.0);

/// All numbers below count, shuffled.
std::vector<int> shuffled(int count, unsigned seed = 1);
/// Round a tube, counterclockwise seen from above.
mrc::Contour ring(int around, int row);
mrc::Contour reversed(mrc::Contour contour);
mrc::Contour renumbered(mrc::Contour contour, std::span<const int> number);

}  // namespace made
