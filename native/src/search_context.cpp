// SPDX-License-Identifier: GPL-3.0-or-later
#include "search_context.h"

#include "contour_scales.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace mrc {

void check_scales(const Surface& surface, const Scales& scales) {
    for (const SurfacePoint& p : scales.given.points) {
        if (std::max(p.a, p.b) >= surface.vertex_count()) {
            throw InvalidInput(ErrorCode::other_surface,
                               "the scales belong to another surface: their contour has vertex " +
                                   std::to_string(std::max(p.a, p.b)) + ", and this surface has " +
                                   std::to_string(surface.vertex_count()) + " vertices",
                               {Element::vertex(std::max(p.a, p.b))});
        }
    }
    for (const double value : {scales.h, scales.K, scales.kappa_0, scales.L0}) {
        if (!(std::isfinite(value) && value > 0.0)) {
            throw InvalidInput(ErrorCode::incomputable_scales,
                               "lengths or curvatures near the contour are too large or too small to compute with: scale the mesh");
        }
    }
}

SearchContext::SearchContext(const Surface& surface, const Contour& contour, const Options& options,
                             const std::vector<Attractor>& attractors, const std::optional<Scales>& given, const Beat& beat)
    : field(surface, options),
      scales(given ? *given : contour_scales(surface, field, contour, options, beat)),
      energy(surface, field, scales, options, attractors) {
    check_scales(surface, scales);
}

}  // namespace mrc
