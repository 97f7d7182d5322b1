// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <vector>

namespace mrc {

/// The nearest simple contour along real edges that is homotopic to a contour: each point moves along its edge to the nearer end,
/// and where two of these are joined by a diagonal the shorter way round the polygon is taken. Where that touches itself, the ends
/// on the contour's left, then on its right are tried. Empty where none of them is simple.
std::vector<int> guide_vertices(const Surface& surface, const Contour& contour);

/// The same contour with t = 0 and t = 1 written as vertices.
Contour normalised(const Contour& contour);

/// A triangle that holds the segment from p to q on its border or inside, or -1.
int triangle_of_segment(const Surface& surface, const SurfacePoint& p, const SurfacePoint& q);

}  // namespace mrc
