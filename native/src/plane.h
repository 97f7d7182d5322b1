// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace mrc {

using Vec2 = Eigen::Vector2d;

/// Twice the signed area of the triangle 0, a, b: positive where b lies to the left of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace mrc
