// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "index_map.h"

#include <mrc/surface.h>

#include <array>
#include <vector>

namespace mrc {

/// The local scale h of the surface at its vertices: how finely the surface is cut up there, evaluated on demand and kept.
///
/// A polygon counts with its extent across, not along: triangles that reach far along a flat or cylindrical face, as CAD exports
/// them, count as fine as short ones. The polygons at a vertex count by their angles there, and their weighted median, not mean,
/// is taken, so that a needle, a duplicate or one vast face does not decide. A vertex takes the mean of its neighbors' and its
/// own. On regular grids it is 0.84 of the length of their edges.
class LocalScale {
  public:
    explicit LocalScale(const Surface& surface) : surface_(&surface) {}

    /// Above 0, or 0 where nothing nearby has a length.
    double at(int vertex) { return at(vertex, all_passes); }

  private:
    static constexpr int all_passes = 2;
    struct Pass {
        IndexMap numbers;
        std::vector<double> scales;
    };

    const Surface* surface_;
    std::array<Pass, all_passes + 1> passes_;

    double at(int vertex, int passes);
    double mean(int vertex, int passes);
};

/// How wide a polygon is across its longest direction, from the moments of its corners: of a long rectangle or right triangle its
/// short side, and 0.84 (2^(-1/4)) of the side of a square or an equilateral triangle.
double extent_across(const Surface& surface, int face);

}  // namespace mrc
