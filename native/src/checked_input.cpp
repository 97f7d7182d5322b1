// SPDX-License-Identifier: GPL-3.0-or-later
#include "checked_input.h"

#include "graph_size_limit.h"
#include "patch.h"
#include "search_context.h"

namespace mrc {

Contour checked_input(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                      const std::optional<Scales>& scales) {
    options.check();
    constraints.check(surface);
    Contour checked = checked_contour(surface, contour);
    check_graph_size(static_cast<double>(checked.points.size()), options.refinement);
    if (!checked.closed && constraints.has_region()) {
        throw InvalidInput(ErrorCode::open_region, "the region term needs a closed contour: an open one encloses nothing");
    }
    if (scales) check_scales(surface, *scales);
    return checked;
}

}  // namespace mrc
