// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/measure.h>

#include "checked_input.h"
#include "progress_monitor.h"
#include "region.h"
#include "search_context.h"

namespace mrc {

Measure measure(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                const std::optional<Scales>& scales, const Progress& progress) {
    const Contour checked = checked_input(surface, contour, options, constraints, scales);
    const bool region = scales && constraints.has_region() && options.region_weight != 0.0;
    Measure result;
    with_monitor(progress, [&](ProgressMonitor& monitor) {
        const Beat beat = [&] { monitor.beat(); };
        const SearchContext context(surface, checked, options, constraints.attractors, scales, beat);
        const double enclosed = region ? enclosed_change(surface, *constraints.region_density, scales->given, checked, beat) : 0.0;
        result = measure(surface, context.energy, checked, options.refinement, enclosed);
    });
    return result;
}

}  // namespace mrc
