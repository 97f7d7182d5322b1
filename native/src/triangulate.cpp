// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulate.h"

#include "plane.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <tuple>

namespace mrc {
namespace {

// Below this sine (or fraction of a quad's area) a corner counts as straight: positions often come from 32-bit floats.
constexpr double straight = 1e-6;
// Diagonals that differ by less than this fraction count as equal, so that rotating a mesh does not flip its squares.
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
    // A diagonal leaves both triangles with the quad's winding where each has between 0 and 1 of its area.
    const double whole = normal.squaredNorm();
    const auto inside = [&](double part) { return part > straight * whole && part < (1.0 - straight) * whole; };
    const bool first_inside = inside((q[1] - q[0]).cross(first).dot(normal));
    const bool second_inside = inside((q[2] - q[1]).cross(second).dot(normal));
    if (first_inside != second_inside) return first_inside ? 0 : 1;
    return second.squaredNorm() < (1.0 - tie) * first.squaredNorm() ? 1 : 0;
}

double orientation(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

std::string side_name(int a, int b) { return std::to_string(a) + "-" + std::to_string(b); }

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
    // A diagonal through another corner would leave corners in a line, which no triangles tile: only if there is no other ear.
    double margin = straight;
    for (int refused = 0; left > 3;) {
        if (ear(corner, margin)) {
            clip(corner);
            --left;
            refused = 0;
            margin = straight;
            corner = next_[corner];  // the ear's neighbor is passed over once: less slender than a fan
        } else if (++refused == left) {
            if (margin == 0.0) break;
            refused = 0;
            margin = 0.0;
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

bool Triangulator::ear(int corner, double margin) const {
    if (!convex(corner)) return false;
    const Vec2& a = flat_[previous_[corner]];
    const Vec2& b = flat_[corner];
    const Vec2& c = flat_[next_[corner]];
    const double beside = -margin * (a - c).squaredNorm();
    return std::ranges::none_of(blunt_, [&](int i) {
        const Vec2& p = flat_[i];
        if (p == a || p == b || p == c) return false;
        return orientation(a, b, p) >= 0.0 && orientation(b, c, p) >= 0.0 && orientation(c, a, p) >= beside;
    });
}

void Triangulator::clip(int corner) {
    const int before = previous_[corner];
    const int after = next_[corner];
    triangles_.push_back({before, corner, after});
    next_[before] = after;
    previous_[after] = before;
}

void Triangulator::fan(int corner, int count) {
    for (int i = next_[corner]; count > 2; --count, i = next_[i]) triangles_.push_back({corner, i, next_[i]});
}

bool PolygonSides::read(std::span<const int> polygon, std::span<const std::array<int, 3>> triangles, int first_triangle) {
    diagonals_.clear();
    if (read_plain(polygon, triangles, first_triangle)) return true;
    fault_.clear();
    seen_.assign(polygon.size(), 0);
    corner_.resize(vertex_count_);
    for (size_t i = 0; i < polygon.size(); ++i) corner_[polygon[i]] = static_cast<int>(i);
    int halfedge = 3 * first_triangle;
    for (const auto& t : triangles) {
        for (int c = 0; c < 3; ++c, ++halfedge) {
            if (!read_side(polygon, t[c], t[c == 2 ? 0 : c + 1], halfedge)) return false;
        }
    }
    const size_t missing = static_cast<size_t>(std::ranges::find(seen_, 0) - seen_.begin());
    if (missing == seen_.size()) return pair_diagonals(polygon);
    fault_ = "side " + side_name(polygon[missing], polygon[(missing + 1) % polygon.size()]) + " is missing";
    return false;
}

// A shortcut for triangles and quads whose triangles start where they usually do.
bool PolygonSides::read_plain(std::span<const int> polygon, std::span<const std::array<int, 3>> triangles, int first_triangle) {
    const auto is = [&](size_t triangle, int a, int b, int c) {
        return triangles[triangle] == std::array{polygon[a], polygon[b], polygon[c]};
    };
    if (polygon.size() == 3) return is(0, 0, 1, 2);
    if (polygon.size() > 4) return false;
    const int h = 3 * first_triangle;
    if (is(0, 0, 1, 2) && is(1, 0, 2, 3)) {
        diagonals_.assign({{0, 2, false, h + 2}, {0, 2, true, h + 3}});
    } else if (is(0, 0, 1, 3) && is(1, 1, 2, 3)) {
        diagonals_.assign({{1, 3, true, h + 1}, {1, 3, false, h + 5}});
    }
    return !diagonals_.empty();
}

bool PolygonSides::read_side(std::span<const int> polygon, int a, int b, int halfedge) {
    const auto triangle = [&] { return "triangle " + std::to_string(halfedge / 3); };
    for (const int v : {a, b}) {
        if (holds(polygon, v)) continue;
        fault_ = "vertex " + std::to_string(v) + " of " + triangle() + " is not in the face";
        return false;
    }
    const int n = static_cast<int>(polygon.size());
    const int i = corner_[a];
    const int j = corner_[b];
    if (i == j) {
        fault_ = triangle() + " repeats vertex " + std::to_string(a);
    } else if (i == (j + 1) % n) {
        fault_ = triangle() + " runs against side " + side_name(b, a);
    } else if (j != (i + 1) % n) {
        diagonals_.push_back({std::min(i, j), std::max(i, j), i < j, halfedge});
    } else if (seen_[i]++ != 0) {
        fault_ = "side " + side_name(a, b) + " occurs more than once";
    }
    return fault_.empty();
}

bool PolygonSides::holds(std::span<const int> polygon, int vertex) const {
    if (vertex < 0 || vertex >= vertex_count_) return false;
    const size_t corner = static_cast<size_t>(corner_[vertex]);
    return corner < polygon.size() && polygon[corner] == vertex;
}

bool PolygonSides::pair_diagonals(std::span<const int> polygon) {
    // Sorted, the two half-edges of a diagonal are neighbors. A diagonal that occurs more often fails here as well: its first two
    // run in the same direction, as they are sorted by that next.
    std::ranges::sort(diagonals_, {}, [](const Diagonal& d) { return std::tuple(d.low, d.high, d.rising); });
    for (size_t i = 0; i < diagonals_.size(); i += 2) {
        const Diagonal& first = diagonals_[i];
        const Diagonal second = i + 1 < diagonals_.size() ? diagonals_[i + 1] : Diagonal{};
        if (first.low == second.low && first.high == second.high && first.rising != second.rising) continue;
        fault_ = "diagonal " + side_name(polygon[first.low], polygon[first.high]) + " must occur twice, once in each direction";
        return false;
    }
    return true;
}

}  // namespace mrc
