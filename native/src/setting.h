// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/curvature.h>
#include <mrc/energy.h>
#include <mrc/options.h>
#include <mrc/scales.h>

#include <vector>

namespace mrc {

/// @throws InvalidInput where the scales are those of another surface, or no numbers.
void check_scales(const Surface& surface, const Scales& scales);

/// Scales, curvature and energy, made once for a contour.
struct Setting {
    Setting(const Surface& surface, const Contour& contour, const Options& options, const std::vector<Attractor>& attractors,
            const Scales* given);
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;

    double h;  ///< the mean edge length
    CurvatureField field;
    Scales scales;
    Energy energy;
};

}  // namespace mrc
