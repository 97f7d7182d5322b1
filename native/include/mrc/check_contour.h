// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/errors.h>
#include <mrc/surface.h>

#include <array>
#include <optional>
#include <span>

namespace mrc {

/// Why `optimize` would refuse a contour before any search; none: it would not.
///
/// That is all that concerns the contour and the barriers, with default options and no other constraints. Whether the search itself
/// can meet required elements, or fits into memory, only the search shows. Takes as long as `measure`, and none is returned where
/// `progress` cancels it.
std::optional<InvalidInput> check_contour(const Surface& surface, const Contour& contour,
                                          std::span<const std::array<int, 2>> barriers = {}, const Progress& progress = {});

}  // namespace mrc
