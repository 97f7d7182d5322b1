// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <vector>

namespace mrc {

/// The nearest simple contour along real edges that is homotopic to a contour: each point moves along its edge to the nearer end,
/// and where two of these are joined by a diagonal the shorter path around the polygon is taken. Where that touches itself, the
/// ends on the contour's left, then on its right are tried. Empty where none of them is simple.
std::vector<int> snapped_contour(const Surface& surface, const Contour& contour);

}  // namespace mrc
