// SPDX-License-Identifier: GPL-3.0-or-later
#include "search_space.h"

#include "checked_input.h"
#include "search_context.h"

namespace mrc {

SearchSpace search_space(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                         const std::optional<Scales>& scales) {
    const Contour checked = checked_input(surface, contour, options, constraints, scales);
    const SearchContext context(surface, checked, options, constraints.attractors, scales);
    SearchSpace space;
    space.patch = make_patch(surface, checked, options.width);
    space.band = grow_band(surface, space.patch, options, constraints);
    space.flow = make_flow(space.patch, space.band, options);
    space.graph =
        make_graph(surface, space.patch, space.band, space.flow, context.energy, options, constraints, options.refinement);
    return space;
}

}  // namespace mrc
