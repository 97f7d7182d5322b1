// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/constraints.h>
#include <mrc/options.h>
#include <mrc/scales.h>
#include <mrc/surface.h>

namespace mrc {

/// The contour, once all input is checked; a band has at least as many triangles as its contour has segments.
/// @throws InvalidInput, TooLarge.
Contour checked_input(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                      const std::optional<Scales>& scales);

}  // namespace mrc
