// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curvature_field.h"
#include "distances.h"
#include "elementary_functions.h"
#include "ratio.h"

#include <mrc/constraints.h>
#include <mrc/measure.h>
#include <mrc/scales.h>

#include <cmath>
#include <memory>

namespace mrc {

class Attraction;

/// What eq. 3.2 needs at a point of the surface.
struct Frame {
    Vec3 normal = Vec3::UnitZ();
    Vec3 direction = Vec3::UnitX();  ///< unit, tangent: the direction that contours follow
    Vec3 across = Vec3::UnitY();     ///< normal x direction
    double kappa = 0.0;              ///< feature curvature, negative in a valley (ridge: -kappa_max), exponent applied
    bool umbilic = true;             ///< no direction: the term is pure bending
    double potential = 0.0;          ///< added cost per unit of length, besides eq. 3.2
};

/// One end of a chord, seen in the tangent plane of the point at that end: what an arc there needs of the chord alone.
struct ChordEnd {
    Eigen::Vector2d tangent = Eigen::Vector2d::Zero();  ///< the chord's projection; x runs along the frame's direction
    double projected = 0.0;                             ///< its length
    double length = 0.0;                                ///< of the chord in space
    double along = 0.0;                                 ///< length times cosine to the frame's direction, exponent applied
    double cost = 0.0;                                  ///< half the length times potential and crease
};

/// The cosine of eq. 3.2 between a chord and direction p, with exponent b; 0 for a chord that points along the normal.
inline double cosine(const ChordEnd& e, const Eigen::Vector2d& p, double exponent) {
    if (e.projected == 0.0) return 0.0;
    const double c = e.tangent.dot(p) / e.projected;
    return exponent == 1.0 ? c : std::copysign(elementary::pow(std::abs(c), exponent), c);
}

/// The weights of the arcs through one point, from chord e1, ending there, to chord e2, starting there.
struct ArcWeights {
    double kappa, kappa_0, direction_exponent;
    double least_cosine;  ///< of max_turn
    bool umbilic;
    bool counted;  ///< arcs are counted (appendix A)

    /// Eq. 3.2.
    double bending(const ChordEnd& e1, const ChordEnd& e2) const {
        const double along = std::abs(umbilic ? along_own(e1, e2) : e1.along + e2.along);  // A
        return kappa < 0.0 ? 0.5 * kappa * along : 0.5 * kappa_0 * (e1.length + e2.length - along);
    }
    /// f: eq. 3.2, the crease term, and the potential of the point.
    double numerator(const ChordEnd& e1, const ChordEnd& e2) const { return bending(e1, e2) + (e1.cost + e2.cost); }
    /// g (eq. 3.1), or 1 where arcs are counted; a chord of length 0 stands for none.
    double denominator(const ChordEnd& e1, const ChordEnd& e2) const {
        if (counted) return e1.length == 0.0 || e2.length == 0.0 ? 0.5 : 1.0;
        return 0.5 * (e1.length + e2.length);
    }
    /// True where the angle between the two in the tangent plane is above max_turn.
    bool turns_too_much(const ChordEnd& e1, const ChordEnd& e2) const {
        return e1.tangent.dot(e2.tangent) < least_cosine * e1.projected * e2.projected;
    }

  private:
    /// Without a direction the contour's own is taken: that of e1' + e2'.
    double along_own(const ChordEnd& e1, const ChordEnd& e2) const {
        const Eigen::Vector2d sum = e1.tangent + e2.tangent;
        if (!(sum.norm() > 0.0)) return 0.0;
        const Eigen::Vector2d p = sum.normalized();
        return e1.length * cosine(e1, p, direction_exponent) + e2.length * cosine(e2, p, direction_exponent);
    }
};

/// The weights of eq. 3.1 and 3.2 with the weights that options add; pure functions of the surface and the scales.
class Energy {
  public:
    /// All arguments must outlive the energy.
    Energy(const Surface& surface, const CurvatureField& field, const Scales& scales, const Options& options,
           const std::vector<Attractor>& attractors = {});
    ~Energy();

    /// kappa interpolates linearly along an edge, the direction through its projector p p^T (eq. 3.5), which needs no sign.
    Frame frame(const SurfacePoint& point) const;

    /// `crease`: cost of the chord's edge per unit of length.
    ChordEnd chord_end(const Frame& frame, const Vec3& chord, double crease = 0.0) const {
        ChordEnd end{{chord.dot(frame.direction), chord.dot(frame.across)}};
        end.projected = end.tangent.norm();
        end.length = chord.norm();
        end.along = end.length * cosine(end, Eigen::Vector2d(1.0, 0.0), options_.direction_exponent);
        end.cost = 0.5 * end.length * (frame.potential + crease);
        return end;
    }

    /// Cost of a chord along a mesh edge per unit of length: crease K min(3, exp(3 sin beta)), beta its signed dihedral;
    /// of one off the mesh's edges (-1), crease K.
    double crease_cost(int halfedge) const;
    /// The same for a chord off the mesh's edges.
    double plain_crease_cost() const { return options_.crease * scales_.K; }

    ArcWeights weights(const Frame& frame) const {
        return {frame.kappa,   scales_.kappa_0, options_.direction_exponent,
                least_cosine_, frame.umbilic,   options_.denominator == Denominator::arcs};
    }

    /// What a unit of density enclosed on the contour's left adds to the numerator: region_weight K / L0, signed by the side.
    double region_factor() const;
    /// K, the unit of ratios; with the factor L0 / n0 where arcs are counted.
    double unit() const;
    /// The plain ratio, or with a length bias ratio / K + length_bias max(length / L0, length_floor), which has no unit.
    Objective objective() const;

  private:
    const Surface& surface_;
    const CurvatureField& field_;
    const Scales& scales_;
    const Options& options_;
    DistanceField from_given_;
    std::unique_ptr<const Attraction> attraction_;  // none without attractors
    double negligible_, least_cosine_;

    Frame vertex_frame(int vertex) const;
    Frame interpolated_frame(const SurfacePoint& point) const;
    double feature(int vertex) const;
    void finish(Frame& frame, double kappa, const SurfacePoint& point) const;
};

/// The same curve with the k Steiner points that it passes along edges among its points.
Contour expressed(const Contour& contour, int steiner);

/// Eq. 3.3 for a contour, expressed with the run's k, as the graph weighs it. @throws InvalidInput where the contour has length
/// 0. `enclosed`: the change of the region term's integral since the first given contour.
Measure measure(const Surface& surface, const Energy& energy, const Contour& contour, int steiner, double enclosed = 0.0);

}  // namespace mrc
