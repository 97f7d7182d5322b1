// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/curvature.h>
#include <mrc/distances.h>
#include <mrc/ratio.h>
#include <mrc/scales.h>
#include <mrc/wishes.h>

namespace mrc {

/// What eq. 3.2 needs to know at a point of the surface.
struct Frame {
    Vec3 normal = Vec3::UnitZ();
    Vec3 direction = Vec3::UnitX();  ///< unit, tangent: the direction that contours follow
    double kappa = 0.0;              ///< feature curvature, negative in a valley (ridge: -kappa_max), exponent applied
    bool umbilic = true;             ///< no direction: the term is pure bending
    double potential = 0.0;          ///< what passing here costs for each unit of length, besides eq. 3.2
};

/// One end of a chord, seen in the tangent plane of the point at that end.
struct ChordEnd {
    Eigen::Vector2d tangent = Eigen::Vector2d::Zero();  ///< the chord's projection; x runs along the frame's direction
    double length = 0.0;                                ///< of the chord in space
    double crease = 0.0;                                ///< what the chord's edge costs for each unit of length
};

/// The weights of eq. 3.1 and 3.2 with the weights that options add; pure functions of the surface and the scales.
class Energy {
  public:
    /// All arguments must outlive the energy.
    Energy(const Surface& surface, const CurvatureField& field, const Scales& scales, const Options& options,
           const std::vector<Attractor>& attractors = {});

    /// kappa interpolates linearly along an edge, the direction through its projector p p^T (eq. 3.5), which needs no sign.
    Frame frame(const SurfacePoint& point) const;

    static ChordEnd chord_end(const Frame& frame, const Vec3& chord, double crease = 0.0);

    /// What a chord along a mesh edge costs for each unit of length: crease K min(3, exp(3 sin beta)), beta its signed dihedral.
    double crease_cost(int halfedge) const;
    /// The same of a chord off the mesh's edges.
    double plain_crease_cost() const { return options_.crease * scales_.K; }

    /// Eq. 3.2 for the arc from chord e1, ending in the frame's point, to chord e2, starting there.
    double bending(const Frame& frame, const ChordEnd& e1, const ChordEnd& e2) const;
    /// f of that arc: eq. 3.2, the crease term, and the potential of the point.
    double numerator(const Frame& frame, const ChordEnd& e1, const ChordEnd& e2) const;
    /// g of the same arc (eq. 3.1), or 1 where arcs are counted (appendix A).
    double denominator(const ChordEnd& e1, const ChordEnd& e2) const {
        if (options_.denominator == Denominator::arcs) return e1.length == 0.0 || e2.length == 0.0 ? 0.5 : 1.0;
        return 0.5 * (e1.length + e2.length);
    }

    /// What a unit of enclosed density on the contour's left adds to the numerator: region_weight K / L0, signed by the side.
    double region_factor() const;
    /// K, the unit of ratios; with the factor L0 / n0 where arcs are counted.
    double unit() const;
    /// The plain ratio, or with a length bias ratio / K + length_bias max(length / L0, length_floor), which has no unit.
    Objective objective() const;

    /// True where the angle between the two in the tangent plane is above max_turn.
    bool turns_too_much(const ChordEnd& e1, const ChordEnd& e2) const;

  private:
    const Surface& surface_;
    const CurvatureField& field_;
    const Scales& scales_;
    const Options& options_;
    DistanceField from_given_;
    struct Pull {
        Attractor attractor;
        DistanceField distance;
    };
    std::vector<Pull> pulls_;
    double negligible_, least_cosine_;

    Frame vertex_frame(int vertex) const;
    Frame interpolated_frame(const SurfacePoint& point) const;
    double feature(int vertex) const;
    double attraction(const SurfacePoint& point) const;
    void finish(Frame& frame, double kappa, const SurfacePoint& point) const;
};

struct Measure {
    double ratio = 0.0;      ///< numerator over length
    double numerator = 0.0;  ///< sum of f over the contour's arcs
    double length = 0.0;     ///< sum of g
    double objective =
        0.0;  ///< what is minimised: the ratio, or with a length bias ratio / K + length_bias max(length / L0, length_floor)
    double salience = 0.0;  ///< minus the ratio of eq. 3.2's energy alone, over K
};

/// The same curve with the k Steiner points that it passes along edges among its points.
Contour expressed(const Contour& contour, int steiner);

/// Eq. 3.3 for a contour, expressed with the run's k, as the graph weighs it. @throws InvalidInput where the contour has length 0.
/// `enclosed`: the change of the region term's integral since the first given contour.
Measure measure(const Surface& surface, const Energy& energy, const Contour& contour, int steiner, double enclosed = 0.0);

}  // namespace mrc
