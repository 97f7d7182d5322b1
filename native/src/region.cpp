// SPDX-License-Identifier: GPL-3.0-or-later
#include "region.h"

#include "segments.h"
#include "surface_point.h"

#include "curvature_field.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace mrc {
namespace {

double triangle_area(const Surface& surface, int triangle) {
    const auto& v = surface.triangle(triangle);
    return 0.5 * (surface.position(v[1]) - surface.position(v[0])).cross(surface.position(v[2]) - surface.position(v[0])).norm();
}

/// The integral of the density over a triangle. The polygon's area, which no triangulation changes, is divided among its
/// triangles in proportion to theirs.
double content(const Surface& surface, std::span<const double> density, int triangle) {
    const int face = surface.triangle_face(triangle);
    double sum = 0.0;
    for (int t = surface.first_triangle(face); t < surface.first_triangle(face + 1); ++t) sum += triangle_area(surface, t);
    if (sum == 0.0) return 0.0;
    return density[face] * polygon_area_vector(surface, face).norm() * triangle_area(surface, triangle) / sum;
}

/// A spanning tree of triangles, root first: each but the root passes what it has gathered on to its parent.
struct Tree {
    std::vector<int> triangles;
    std::vector<int> leaving;  // the half-edge through which each passes it on; of the root, -1
};

/// Breadth first over the triangles that `inside` admits.
template <class Inside>
Tree grow_tree(const Surface& surface, const std::vector<int>& seeds, Inside&& inside, const Beat& beat) {
    Tree tree;
    std::unordered_map<int, char> met;
    const auto enter = [&](int triangle, int leaving) {
        if (!met.emplace(triangle, 1).second) return;
        tree.triangles.push_back(triangle);
        tree.leaving.push_back(leaving);
    };
    for (const int seed : seeds) enter(seed, -1);
    for (std::size_t i = 0; i < tree.triangles.size(); ++i) {
        beat_at(i, beat);
        for (int h = 3 * tree.triangles[i]; h < 3 * tree.triangles[i] + 3; ++h) {
            const int twin = surface.twin(h);
            if (twin >= 0 && inside(twin / 3)) enter(twin / 3, twin);
        }
    }
    return tree;
}

/// Gathers the contents towards the root: the form on the edge to a triangle's parent gives the triangle its circulation.
EdgeForm gather(const Surface& surface, const Tree& tree, std::span<const double> density, const Beat& beat) {
    EdgeForm form(surface);
    for (std::size_t i = tree.triangles.size(); i-- > 0;) {
        beat_at(i, beat);
        if (tree.leaving[i] < 0) continue;
        const int first = 3 * tree.triangles[i];
        const double circulation = form.on(first) + form.on(first + 1) + form.on(first + 2);
        form.add(tree.leaving[i], content(surface, density, tree.triangles[i]) - circulation);
    }
    return form;
}

/// Of triangles in the order of their distance from two contours, one that moving the first contour into the second does not
/// pass: the last at the border of the mesh, which no band encloses; without a border, the last of all.
int outer_triangle(const Surface& surface, const std::vector<int>& triangles) {
    const auto at_border = [&](int t) {
        return surface.twin(3 * t) == Surface::border || surface.twin(3 * t + 1) == Surface::border ||
               surface.twin(3 * t + 2) == Surface::border;
    };
    const auto last = std::ranges::find_if(triangles.rbegin(), triangles.rend(), at_border);
    return last == triangles.rend() ? triangles.back() : *last;
}

/// True where these triangles, a connected component, close up to a sphere: then every contour divides them in two.
bool is_sphere(const Surface& surface, const std::vector<int>& triangles, const Beat& beat) {
    std::unordered_set<int> vertices;
    for (const int t : triangles) {
        beat_at(vertices.size(), beat);
        for (int h = 3 * t; h < 3 * t + 3; ++h) {
            if (surface.twin(h) < 0) return false;
            vertices.insert(surface.from(h));
        }
    }
    return 2 * vertices.size() == triangles.size() + 4;  // V - E + F = 2 with E = 3 F / 2
}

/// The barycentric coordinates of a point on a triangle's border.
std::array<double, 3> barycentric(const Surface& surface, int triangle, const SurfacePoint& p) {
    std::array<double, 3> coordinates{};
    for (std::size_t i = 0; i < 3; ++i) {
        const int v = surface.triangle(triangle)[i];
        if (v == p.a) coordinates[i] += 1.0 - p.t;
        if (v == p.b) coordinates[i] += p.t;
    }
    return coordinates;
}

}  // namespace

double EdgeForm::on(int halfedge) const {
    const auto found = values_.find(lower(halfedge));
    if (found == values_.end()) return 0.0;
    return lower(halfedge) == halfedge ? found->second : -found->second;
}

void EdgeForm::add(int halfedge, double value) { values_[lower(halfedge)] += lower(halfedge) == halfedge ? value : -value; }

// The integral of l_i dl_j - l_j dl_i from p to q is l_i(p) l_j(q) - l_j(p) l_i(q).
double EdgeForm::along(const SurfacePoint& from, const SurfacePoint& to) const {
    const int triangle = triangle_of_segment(*surface_, from, to);
    if (triangle < 0) return 0.0;
    const auto p = barycentric(*surface_, triangle, from), q = barycentric(*surface_, triangle, to);
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        sum += on(3 * triangle + static_cast<int>(i)) * (p[i] * q[j] - p[j] * q[i]);
    }
    return sum;
}

double EdgeForm::along(const Contour& contour) const {
    double sum = 0.0;
    for (const auto& [p, q] : segments(contour)) sum += along(p, q);
    return sum;
}

EdgeForm region_form(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow,
                     std::span<const double> density, double reached, const Beat& beat) {
    std::unordered_map<int, char> inside;
    for (const auto face : patch.mesh.faces()) {
        if (!band.face[face.idx()]) continue;
        beat_at(inside.size(), beat);
        const auto h = patch.mesh.halfedge_handle(face);
        inside.emplace(patch.halfedge[h.idx()] / 3, 1);
    }
    // The root passes on through the band's border, so that every triangle has its circulation.
    int root = -1, exit = -1;
    for (const auto h : patch.mesh.halfedges()) {
        const int here = patch.halfedge[h.idx()], there = patch.halfedge[patch.mesh.opposite_halfedge_handle(h).idx()];
        if (here < 0 || !inside.contains(here / 3) || (there >= 0 && inside.contains(there / 3))) continue;
        root = here / 3;
        exit = here;
        break;
    }
    if (root < 0) return EdgeForm(surface);
    Tree tree = grow_tree(
        surface, {root}, [&](int t) { return inside.contains(t); }, beat);
    tree.leaving[0] = exit;
    EdgeForm form = gather(surface, tree, density, beat);
    const double gauge = reached - form.along(patch.given);
    for (const auto edge : patch.mesh.edges()) {
        if (!band.edge[edge.idx()]) continue;
        const int h = 2 * edge.idx(), here = patch.halfedge[h];
        const double part = gauge * flow.increment(patch.mesh, h);
        here >= 0 ? form.add(here, part) : form.add(patch.halfedge[opposite(h)], -part);
    }
    return form;
}

double enclosed_change(const Surface& surface, std::span<const double> density, const Contour& from, const Contour& to,
                       const Beat& beat) {
    std::vector<int> seeds;
    for (const Contour* contour : {&from, &to}) {
        for (const SurfacePoint& p : contour->points) {
            for (const int h : surface.outgoing(p.a)) seeds.push_back(h / 3);
        }
    }
    const auto everywhere = [](int) { return true; };
    const int root = outer_triangle(surface, grow_tree(surface, seeds, everywhere, beat).triangles);
    Tree tree = grow_tree(surface, {root}, everywhere, beat);
    for (int h = 3 * root; h < 3 * root + 3; ++h) {
        if (surface.twin(h) == Surface::border) tree.leaving[0] = h;  // through the border, so that the root counts too
    }
    const EdgeForm form = gather(surface, tree, density, beat);
    const double change = form.along(to) - form.along(from);
    if (!is_sphere(surface, tree.triangles, beat)) return change;
    // There a contour may pass the root. The form misses the whole where the root is on a contour's left: where its area is
    // negative.
    const std::vector<double> ones(surface.face_count(), 1.0);
    const EdgeForm area = gather(surface, tree, ones, beat);
    double total = 0.0;
    for (const int t : tree.triangles) total += content(surface, density, t);
    return change + total * ((area.along(to) < 0.0) - (area.along(from) < 0.0));
}

}  // namespace mrc
