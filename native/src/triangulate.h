// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/types.h>

#include <array>
#include <span>
#include <vector>

namespace mrc {

/// Cuts polygons into triangles, given as triples of corner numbers with the polygon's winding. Only the corners' positions count,
/// so that equal polygons are cut alike wherever they lie in a mesh. One object serves many polygons and reuses its memory.
class Triangulator {
  public:
    /// The n - 2 triangles of a polygon of n corners; valid until the next call. Of a triangle, no corner need be given.
    ///
    /// Quads are cut along the diagonal inside them (in the plane of Newell's normal), convex ones along the shorter, and at a tie
    /// at the first corner. Larger polygons are cut by clipping ears; where a polygon, or what is left of one, has no ear because
    /// it is degenerate, it becomes a fan.
    std::span<const std::array<int, 3>> operator()(std::span<const Vec3> corners);

  private:
    std::vector<std::array<int, 3>> triangles_;
    std::vector<Eigen::Vector2d> flat_;  ///< the corners in the plane
    std::vector<int> next_, previous_;   ///< the ring of the corners not yet clipped
    std::vector<int> blunt_;             ///< corners of the ring that are not convex: only these can lie in an ear

    void clip_ears(const Vec3& normal, std::span<const Vec3> corners);
    bool convex(int corner) const;
    bool ear(int corner) const;
    void clip(int corner);
    void fan(int corner, int count);
};

}  // namespace mrc
