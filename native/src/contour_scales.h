// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curvature_field.h"

#include <mrc/options.h>
#include <mrc/scales.h>
#include <mrc/surface.h>

namespace mrc {

double contour_length(const Surface& surface, const Contour& contour);

/// @throws InvalidInput where every edge there has length 0.
Scales contour_scales(const Surface& surface, const CurvatureField& field, const Contour& contour, const Options& options,
                      const Beat& beat = {});

}  // namespace mrc
