// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/measure.h>

#include "checked_input.h"
#include "region.h"
#include "search_context.h"

namespace mrc {

Measure measure(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                const std::optional<Scales>& scales) {
    const Contour checked = checked_input(surface, contour, options, constraints, scales);
    const SearchContext context(surface, checked, options, constraints.attractors, scales);
    const bool region = scales && constraints.has_region() && options.region_weight != 0.0;
    return measure(surface, context.energy, checked, options.refinement,
                   region ? enclosed_change(surface, *constraints.region_density, scales->given, checked) : 0.0);
}

}  // namespace mrc
