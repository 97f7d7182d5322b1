// SPDX-License-Identifier: GPL-3.0-or-later
#include "search_space.h"

#include "checked_input.h"
#include "progress_monitor.h"
#include "search_context.h"

#include <utility>

namespace mrc {

SearchSpace search_space(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                         const std::optional<Scales>& scales, const Progress& progress) {
    const Contour checked = checked_input(surface, contour, options, constraints, scales);
    SearchSpace space;
    const bool done = with_monitor(progress, [&](ProgressMonitor& monitor) {
        const Beat beat = [&] { monitor.beat(); };
        const SearchContext context(surface, checked, options, constraints.attractors, scales, beat);
        space.patch = make_patch(surface, checked, options.width, beat);
        space.band = grow_band(surface, space.patch, options, constraints, {}, beat);
        space.flow = make_flow(space.patch, space.band, options, beat);
        space.graph = make_graph(surface, space.patch, space.band, space.flow, context.energy, options, constraints,
                                 options.refinement, nullptr, {}, beat);
    });
    return done ? std::move(space) : SearchSpace();
}

}  // namespace mrc
