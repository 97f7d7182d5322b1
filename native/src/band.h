// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/constraints.h>
#include <mrc/options.h>
#include "exclusion.h"
#include "patch.h"

#include <vector>

namespace mrc {

/// Where a vertex lies as one walks along the contour.
enum class Side : signed char { right = -1, contour = 0, left = 1, outside = 2 };

/// The faces searched, and the boundary curves of every dilation round on both sides (4.2.1).
struct Band {
    std::vector<char> face;          ///< of each patch face: true inside the band
    std::vector<char> edge;          ///< of each patch edge: true for sides and diagonals of the band's faces and for the contour
    std::vector<int> polygons;       ///< local polygons of the band, in the order in which they entered
    std::vector<Side> polygon_side;  ///< of each of `polygons`: left or right, or `contour` for the `end_polygons`
    std::vector<Side> side;          ///< of each patch vertex: left or right of the contour as one walks along it
    std::vector<int> round;          ///< of each patch vertex: the round in which it entered, 0 on the contour, -1 outside
    /// left[r], right[r]: the boundary after round r as patch vertices, running along with the contour; [0] is the contour. Those
    /// of an open curve run from its first vertex to its last, before the `end_polygons` enter.
    std::vector<std::vector<int>> left, right;
    int end_polygons = 0;      ///< the last of `polygons`, which join the two sides beyond the ends of an open curve
    int rounds = 0;            ///< rounds that added something on either side
    std::vector<int> refused;  ///< local polygons that it met and that its exclusion refuses, ascending
};

/// Grows the band by whole polygons, round by round, so that it stays an annulus, or a disk around an open curve.
///
/// A polygon enters when it meets the band in one connected chain of edges and its other vertices are outside (spike and merge,
/// 4.2.1, are the triangle's two cases), in the order of its round and then of its distance from the contour. The chain lies on
/// one side of the contour; last of all, polygons whose chains run around an end of an open curve, or on from there, close the
/// disk.
Band grow_band(const Surface& surface, const Patch& patch, const Options& options, const Constraints& constraints = {},
               const Exclusion& exclusion = {}, const Beat& beat = {});

}  // namespace mrc
