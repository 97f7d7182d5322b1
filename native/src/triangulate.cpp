// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulate.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mrc {
namespace {

using Vec2 = Eigen::Vector2d;

// Below this sine (or share of a quad's area) a corner counts as straight: positions often come from 32-bit floats.
constexpr double straight = 1e-6;
// Diagonals that differ by less than this share count as equal, so that rotating a mesh does not flip its squares.
constexpr double tie = 1e-6;

// Newell's normal: twice the area vector, for polygons that are not planar the best of its kind.
Vec3 newell_normal(std::span<const Vec3> corners) {
    Vec3 normal = Vec3::Zero();
    for (size_t i = 2; i < corners.size(); ++i) {
        normal += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
    }
    return normal;
}

// The corner, 0 or 1, from which a quad's diagonal starts.
int quad_diagonal(std::span<const Vec3> q) {
    const Vec3 first = q[2] - q[0];
    const Vec3 second = q[3] - q[1];
    const Vec3 normal = first.cross(second);
    // A diagonal leaves both triangles with the quad's winding where each has a share of its area between 0 and 1.
    const double whole = normal.squaredNorm();
    const auto inside = [&](double share) { return share > straight * whole && share < (1.0 - straight) * whole; };
    const bool first_inside = inside((q[1] - q[0]).cross(first).dot(normal));
    const bool second_inside = inside((q[2] - q[1]).cross(second).dot(normal));
    if (first_inside != second_inside) return first_inside ? 0 : 1;
    return second.squaredNorm() < (1.0 - tie) * first.squaredNorm() ? 1 : 0;
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double orientation(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

}  // namespace

std::span<const std::array<int, 3>> Triangulator::operator()(std::span<const Vec3> corners) {
    triangles_.clear();
    if (corners.size() <= 3) {
        triangles_.push_back({0, 1, 2});
    } else if (corners.size() == 4) {
        if (quad_diagonal(corners) == 0) {
            triangles_.assign({{0, 1, 2}, {0, 2, 3}});
        } else {
            triangles_.assign({{0, 1, 3}, {1, 2, 3}});
        }
    } else {
        clip_ears(newell_normal(corners), corners);
    }
    return triangles_;
}

void Triangulator::clip_ears(const Vec3& normal, std::span<const Vec3> corners) {
    const int n = static_cast<int>(corners.size());
    next_.resize(corners.size());
    previous_.resize(corners.size());
    for (int i = 0; i < n; ++i) {
        next_[i] = (i + 1) % n;
        previous_[i] = (i + n - 1) % n;
    }
    if (!(normal.norm() > 0.0)) return fan(0, n);

    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.normalized().cross(u);
    flat_.clear();
    for (const Vec3& p : corners) flat_.emplace_back(u.dot(p - corners[0]), v.dot(p - corners[0]));
    blunt_.clear();
    for (int i = 0; i < n; ++i) {
        if (!convex(i)) blunt_.push_back(i);
    }

    int corner = 0;
    int left = n;
    for (int refused = 0; left > 3 && refused < left;) {
        if (ear(corner)) {
            clip(corner);
            --left;
            refused = 0;
            corner = next_[corner];  // the ear's neighbour is passed over once: less slender than a fan
        } else {
            ++refused;
        }
        corner = next_[corner];
    }
    fan(corner, left);
}

bool Triangulator::convex(int corner) const {
    const Vec2 in = flat_[corner] - flat_[previous_[corner]];
    const Vec2 out = flat_[next_[corner]] - flat_[corner];
    return cross(in, out) > straight * in.norm() * out.norm();
}

bool Triangulator::ear(int corner) const {
    if (!convex(corner)) return false;
    const Vec2& a = flat_[previous_[corner]];
    const Vec2& b = flat_[corner];
    const Vec2& c = flat_[next_[corner]];
    return std::ranges::none_of(blunt_, [&](int i) {
        const Vec2& p = flat_[i];
        if (p == a || p == b || p == c) return false;
        return orientation(a, b, p) >= 0.0 && orientation(b, c, p) >= 0.0 && orientation(c, a, p) >= 0.0;
    });
}

void Triangulator::clip(int corner) {
    const int before = previous_[corner];
    const int after = next_[corner];
    triangles_.push_back({before, corner, after});
    next_[before] = after;
    previous_[after] = before;
    std::erase_if(blunt_, [&](int i) { return (i == before || i == after) && convex(i); });
}

void Triangulator::fan(int corner, int count) {
    for (int i = next_[corner]; count > 2; --count, i = next_[i]) triangles_.push_back({corner, i, next_[i]});
}

}  // namespace mrc
