// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/curvature.h>
#include <mrc/scales.h>

namespace mrc {

/// What eq. 3.2 needs to know at a point of the surface.
struct Frame {
    Vec3 normal = Vec3::UnitZ();
    Vec3 direction = Vec3::UnitX();  ///< unit, tangent: the direction that contours follow
    double kappa = 0.0;              ///< feature curvature, negative in a valley (ridge: -kappa_max), exponent applied
    bool umbilic = true;             ///< no direction: the term is pure bending
};

/// One end of a chord, seen in the tangent plane of the point at that end.
struct ChordEnd {
    Eigen::Vector2d tangent = Eigen::Vector2d::Zero();  ///< the chord's projection; x runs along the frame's direction
    double length = 0.0;                                ///< of the chord in space
};

/// The weights of eq. 3.1 and 3.2 as DESIGN of the energy settles them; pure functions of the surface and the scales.
class Energy {
  public:
    /// All arguments must outlive the energy.
    Energy(const Surface& surface, const CurvatureField& field, const Scales& scales, const Options& options);

    /// kappa interpolates linearly along an edge, the direction through its projector p p^T (eq. 3.5), which needs no sign.
    Frame frame(const SurfacePoint& point) const;

    static ChordEnd chord_end(const Frame& frame, const Vec3& chord);

    /// f of the arc from chord e1, ending in the frame's point, to chord e2, starting there (eq. 3.2).
    double numerator(const Frame& frame, const ChordEnd& e1, const ChordEnd& e2) const;
    /// g of the same arc (eq. 3.1).
    static double denominator(const ChordEnd& e1, const ChordEnd& e2) { return 0.5 * (e1.length + e2.length); }

    /// True where the angle between the two in the tangent plane is above max_turn.
    bool turns_too_much(const ChordEnd& e1, const ChordEnd& e2) const;

  private:
    const Surface& surface_;
    const CurvatureField& field_;
    const Scales& scales_;
    const Options& options_;
    double negligible_, least_cosine_;

    Frame vertex_frame(int vertex) const;
    Frame interpolated_frame(const SurfacePoint& point) const;
    void finish(Frame& frame, double kappa) const;
};

struct Measure {
    double ratio = 0.0;      ///< numerator over length
    double numerator = 0.0;  ///< sum of f over the contour's arcs
    double length = 0.0;     ///< sum of g
    double objective = 0.0;  ///< what is minimised: the ratio, in units of one over length
};

/// Eq. 3.3 for a contour. @throws InvalidInput where the contour has length 0.
Measure measure(const Surface& surface, const Energy& energy, const Contour& contour);

}  // namespace mrc
