// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>

namespace mrc {

/// How the flow is computed, which says how far along the contour each point of the band lies (4.2.3).
enum class FlowKind { gates, arc_length, harmonic };
/// What contours follow: concave creases, or crests (3.4, footnote).
enum class Feature { valley, ridge };
enum class RegionSide { left, right };
/// What is held at the ends of an open curve (4.6): the first and the last edge, or their end vertices. With the other two, ends on
/// the mesh border slide along it: else the vertices are held with `border`, the edges with `edges_or_border`.
enum class Ends { edges, vertices, border, edges_or_border };
/// What length_bias counts, and what the ratio divides by: lengths, or numbers of edges (appendix A).
enum class LengthMeasure { arc, edges };
enum class Denominator { length, arcs };

/// All settings of the method; each stage reads those it needs. Sections are those of Clements 2006. K and L0 are those of `Scales`.
struct Options {
    // band, 4.2.1
    /// Rings of faces on each side, at least 1. None: the band grows until topology stops it, and iterations with refinement then
    /// search a band of the default width around the regular result.
    std::optional<int> width = 4;
    /// A further limit from the third ring on: all vertices of a polygon must lie within this distance of the contour that the
    /// iteration starts from. In average radii of the contour's connected component; none: no limit.
    std::optional<double> band_distance;
    // curvature, 3.4
    double curvature_radius = 1.6;  ///< of the disk B, in the local scale h of the surface (`VertexCurvature`), above 0
    /// Sigma in h. The disk gets the second moment that it would have after smoothing with a Gaussian of this sigma, and parts at
    /// the distance d from its center count with 1 - d^2 / radius^2. 0: the plain disk of eq. 3.4.
    double curvature_smoothing = 1.0;
    // flow, 4.2.3
    FlowKind flow = FlowKind::harmonic;  ///< gave the best results; needs no starting line
    // energy, 3.4
    double kappa0_factor = 3.0;       ///< kappa_0 over K, above 0
    double feature_exponent = 1.0;    ///< a: K |kappa / K|^a instead of |kappa|
    double direction_exponent = 1.0;  ///< b: sign(c) |c|^b instead of a cosine c
    Feature feature = Feature::valley;
    double max_turn = std::numbers::pi / 2;  ///< radians in the tangent plane; arcs that turn more are pruned
    double anchor = 0.0;                  ///< in K, 0 or more: holds the contour near the given one: far features must be worth it
    std::optional<double> feature_clamp;  ///< in (0, 1): the quantile of the negative kappa_min at which their size is cut off
    double crease = 0.0;                  ///< in K, 0 or more: how strongly sharp concave edges pull contours onto themselves
    // region term, 6.1.2
    double region_weight = 0.0;                 ///< weight of the change of the enclosed density, in K / L0
    RegionSide region_side = RegionSide::left;  ///< which side of the given direction counts as enclosed
    // length bias, 6.1.1
    double length_bias = 0.0;   ///< beta: weight of length / L0 beside ratio / K
    double length_floor = 0.0;  ///< below this fraction of L0 nothing is gained by shrinking
    LengthMeasure length_measure = LengthMeasure::arc;
    Denominator denominator = Denominator::length;
    Ends ends = Ends::edges;
    // refinement, 3.2, and iteration, 5.3 and 5.6
    int refinement = 0;          ///< k, the Steiner points put on each edge; 0: contours keep to mesh edges
    int regular_iterations = 0;  ///< iterations along mesh edges first
    int iterations = 1;          ///< iterations with `refinement` after the regular ones; both end early where nothing moves
    /// Where the best found has less salience than this, there is nothing concave to find and the given contour stays.
    std::optional<double> min_salience;
    int threads = 0;  ///< that optimize several contours; 0: as many as the machine has; no result depends on it

    /// The settings whose contours lie closest to where people draw part boundaries; the defaults above are those of the thesis.
    static Options recommended();

    /// @throws InvalidInput that names the option, its value and its range.
    void check() const;

    bool operator==(const Options&) const = default;
};

}  // namespace mrc
