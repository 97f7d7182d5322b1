// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace mrc {

/// A soft constraint (4.5): a place that attracts contours, or repels them where its strength is negative.
struct Attractor {
    int vertex = no_element;
    double radius = 0.0;          ///< along the surface in the mesh's unit, above 0; beyond it there is no effect
    double strength = 1.0;        ///< of the pull, in units of K
    std::optional<double> sigma;  ///< of the pull's Gaussian; none: half the radius
};

/// Requirements and preferences besides a low ratio.
struct Constraints {
    std::vector<int> required_vertices;              ///< vertices that the contour must pass (4.4)
    std::vector<std::array<int, 2>> required_edges;  ///< real edges that it must run along
    std::vector<Attractor> attractors;
    std::vector<std::array<int, 2>> barriers;  ///< real edges that neither band nor contour crosses
    /// Density of each face, per unit of area, for the region term (6.1.2); null or empty: no region term. Shared, because many
    /// contours may have the same one.
    std::shared_ptr<const std::vector<double>> region_density;

    bool has_region() const { return region_density && !region_density->empty(); }

    /// @throws InvalidInput that names the element: out of range, no real edge, radius or sigma not above 0.
    void check(const Surface& surface) const;
};

}  // namespace mrc
