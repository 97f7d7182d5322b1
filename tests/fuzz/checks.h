// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/optimize.h>

namespace mrc {

/// Aborts with a message if a law does not hold, so that the fuzzer keeps the input.
void require(bool holds, const char* law);

/// Checks that the half-edges and vertices of a surface are consistent.
void check_surface(const Surface& surface);

/// Checks that a contour is on the surface and does not meet or cross itself, using only the triangles.
void check_simple(const Surface& surface, const Contour& contour);

/// Whether two contours have no point in common.
bool apart(const Contour& one, const Contour& two);

/// Checks what holds for every result, whatever the options.
void check_result(const Surface& surface, const Contour& given, const Options& options, const Constraints& constraints,
                  const Result& result);

}  // namespace mrc
