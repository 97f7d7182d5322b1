// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/optimize.h>

namespace mrc {

/// Ends the program with a message where a law does not hold: the fuzzer keeps the input.
void require(bool holds, const char* law);

/// Half-edges and vertices of a surface agree with each other.
void check_surface(const Surface& surface);

/// A contour on the surface that neither meets nor crosses itself, judged by the triangles alone.
void check_contour(const Surface& surface, const Contour& contour);

/// Whether two contours have no point in common.
bool apart(const Contour& one, const Contour& two);

/// What holds of every result, whatever the options.
void check_result(const Surface& surface, const Contour& given, const Options& options, const Constraints& constraints,
                  const Result& result);

}  // namespace mrc
