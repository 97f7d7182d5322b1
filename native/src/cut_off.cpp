// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_off.h"

#include "snapped_contour.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_set>

namespace mrc {
namespace {

constexpr int few = 4;                      // triangles: fewer are no part, unless their boundary is a good one
constexpr double good_salience = 1.0;       // of a boundary that may cut off a single face
constexpr double least_share = 0.004;       // of the surface: less is no part where the boundary follows nothing
constexpr double followed_salience = 0.25;  // below this nothing is followed, as in Options::recommended

/// Counts the triangles on one side of a contour.
class SideCount {
  public:
    SideCount(const Surface& surface, const std::vector<int>& contour, bool closed) : surface_(surface) {
        const std::size_t count = contour.size() - (closed ? 0 : 1);
        for (std::size_t i = 0; i < count; ++i) {
            const int a = contour[i], b = contour[(i + 1) % contour.size()];
            walls_.insert(surface.edge(surface.find_edge(a, b)));
            add(left_, surface.find_halfedge(a, b));
            add(right_, surface.find_halfedge(b, a));
        }
    }

    int left(int limit) { return flood(left_, right_, limit); }
    int right(int limit) { return flood(right_, left_, limit); }
    bool separates() const { return separates_; }
    /// The side counted last has met the border of the mesh.
    bool met_border() const { return met_border_; }

  private:
    const Surface& surface_;
    std::unordered_set<int> walls_;
    std::vector<int> left_, right_;  // triangles along the contour
    bool separates_ = true, met_border_ = false;

    static void add(std::vector<int>& triangles, int halfedge) {
        if (halfedge >= 0) triangles.push_back(halfedge / 3);
    }

    int flood(const std::vector<int>& seeds, const std::vector<int>& others, int limit) {
        std::unordered_set<int> seen;
        std::vector<int> stack;
        const auto enter = [&](int triangle) {
            if (seen.insert(triangle).second) stack.push_back(triangle);
        };
        met_border_ = false;
        for (const int triangle : seeds) enter(triangle);
        while (!stack.empty() && static_cast<int>(seen.size()) < limit) {
            const int triangle = stack.back();
            stack.pop_back();
            for (int h = 3 * triangle; h < 3 * triangle + 3; ++h) {
                met_border_ |= surface_.twin(h) == Surface::border;
                if (surface_.twin(h) >= 0 && !walls_.contains(surface_.edge(h))) enter(surface_.twin(h) / 3);
            }
        }
        if (std::ranges::any_of(others, [&](int triangle) { return seen.contains(triangle); })) separates_ = false;
        return std::min(static_cast<int>(seen.size()), limit);
    }
};

}  // namespace

CutOff cut_off_by(const Surface& surface, const std::vector<int>& contour, bool closed, int limit) {
    SideCount sides(surface, contour, closed);
    CutOff cut;
    cut.left = sides.left(limit);
    cut.left_border = sides.met_border();
    cut.right = sides.right(limit);
    cut.right_border = sides.met_border();
    cut.separates = sides.separates();
    return cut;
}

int slipped_off(const Surface& surface, const Contour& given, const Contour& found, double salience) {
    if (salience >= good_salience) return 0;
    const int share = static_cast<int>(least_share * surface.triangle_count());
    const int limit = salience < followed_salience ? std::max(few, share) : few;
    const std::vector<int> path = snapped_contour(surface, found), start = snapped_contour(surface, given);
    if (path.empty() || start.empty()) return 0;
    const CutOff cut = cut_off_by(surface, path, found.closed, limit);
    const int least = std::min(cut.left, cut.right);
    if (!cut.separates || least == 0 || least >= limit) return 0;
    const bool left = cut.left == least;
    if (left ? cut.left_border : cut.right_border) return 0;  // the rim of a hole is no tip
    // Of the connected component, which may be small.
    SideCount rest(surface, path, found.closed);
    const int most = static_cast<int>(least / least_share);
    if ((left ? rest.right(most) : rest.left(most)) < most) return 0;
    SideCount before(surface, start, given.closed);
    return (left ? before.left(least + 1) : before.right(least + 1)) > least ? least : 0;
}

}  // namespace mrc
