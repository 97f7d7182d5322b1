// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curvature_field.h"
#include "energy.h"

#include <mrc/options.h>
#include <mrc/scales.h>

#include <vector>

namespace mrc {

/// @throws InvalidInput where the scales are those of another surface, or no numbers.
void check_scales(const Surface& surface, const Scales& scales);

/// Scales, curvature and energy, made once for a contour.
struct SearchContext {
    SearchContext(const Surface& surface, const Contour& contour, const Options& options, const std::vector<Attractor>& attractors,
                  const std::optional<Scales>& given, const Beat& beat = {});
    SearchContext(const SearchContext&) = delete;
    SearchContext& operator=(const SearchContext&) = delete;

    CurvatureField field;
    Scales scales;
    Energy energy;
};

}  // namespace mrc
