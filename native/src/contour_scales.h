// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curvature_field.h"

#include <mrc/options.h>
#include <mrc/scales.h>
#include <mrc/surface.h>

namespace mrc {

double contour_length(const Surface& surface, const Contour& contour);

/// The mean edge length h near a contour.
/// @throws InvalidInput where every edge there has length 0.
double mean_edge_length(const Surface& surface, const Contour& contour);

/// `field` must be made with h = mean_edge_length(surface, contour).
Scales contour_scales(const Surface& surface, const CurvatureField& field, double h, const Contour& contour, const Options& options,
                      const Beat& beat = {});

}  // namespace mrc
