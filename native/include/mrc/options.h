// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>

namespace mrc {

enum class FlowKind { gates, arc_length, harmonic };
enum class Feature { valley, ridge };

/// All settings of the method; each stage reads its own. Sections are those of Clements 2006.
struct Options {
    // band, 4.2.1
    std::optional<int> width = 4;  ///< rings of faces to each side, at least 1; none: until topology stops the band
    // curvature, 3.4
    double curvature_radius = 1.6;     ///< of the disk B, in h, above 0
    double curvature_smoothing = 1.0;  ///< sigma of the tensor's Gaussian, in h; 0: no smoothing
    // flow, 4.2.3
    FlowKind flow = FlowKind::gates;
    // energy, 3.4
    double kappa0_factor = 3.0;       ///< kappa_0 over K, above 0
    double feature_exponent = 1.0;    ///< a: K |kappa / K|^a in the place of |kappa|
    double direction_exponent = 1.0;  ///< b: sign(c) |c|^b in the place of a cosine c
    Feature feature = Feature::valley;
    double max_turn = std::numbers::pi / 2;  ///< radians in the tangent plane; arcs that turn more are pruned
    // iteration, 5.3
    int iterations = 1;

    /// @throws InvalidInput that names the option, its value and its range.
    void check() const;
};

}  // namespace mrc
