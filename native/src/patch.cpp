// SPDX-License-Identifier: GPL-3.0-or-later
#include "patch.h"

#include "snapped_contour.h"
#include "surface_point.h"

#include "distances.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace mrc {
namespace {

std::string edge_name(int a, int b) { return "(" + std::to_string(a) + ", " + std::to_string(b) + ")"; }

/// A diagonal that joins the same vertices as another edge would be one edge with it in the patch's mesh.
bool has_shared_diagonal(const Surface& surface, int face) {
    const int begin = 3 * surface.first_triangle(face), end = 3 * surface.first_triangle(face + 1);
    for (int h = begin; h < end; ++h) {
        if (!surface.diagonal(h)) continue;
        const auto same = [&](int other) { return surface.to(other) == surface.to(h); };
        if (std::ranges::count_if(surface.outgoing(surface.from(h)), same) > 1) return true;
        if (surface.real_edge(surface.from(h), surface.to(h))) return true;
    }
    return false;
}

/// Bands keep to polygons that are shown and whose vertices have one fan each.
bool usable(const Surface& surface, int face) {
    if (surface.hidden(face)) return false;
    const auto vertices = surface.face(face);
    if (!std::ranges::all_of(vertices, [&](int v) { return surface.regular(v); })) return false;
    return vertices.size() == 3 || !has_shared_diagonal(surface, face);
}

std::string point_name(const SurfacePoint& p) {
    return p.is_vertex() ? "vertex " + std::to_string(p.a)
                         : "the point at " + std::to_string(p.t) + " of edge " + edge_name(p.a, p.b);
}

/// A half-edge with these ends, real or diagonal, or -1.
int any_halfedge(const Surface& surface, int a, int b) {
    for (const int h : surface.outgoing(a)) {
        if (surface.to(h) == b) return h;
    }
    return -1;
}

void check_point(const Surface& surface, const SurfacePoint& p) {
    for (const int v : {p.a, p.b}) {
        if (v < 0 || v >= surface.vertex_count()) {
            throw InvalidInput("contour vertex " + std::to_string(v) + " is out of range: the surface has " +
                               std::to_string(surface.vertex_count()) + " vertices");
        }
    }
    if (!(p.t >= 0.0 && p.t <= 1.0)) {
        throw InvalidInput("the contour's point on edge " + edge_name(p.a, p.b) + " has parameter " + std::to_string(p.t) +
                           ": it must be from 0 to 1");
    }
    if (!p.is_vertex() && any_halfedge(surface, p.a, p.b) < 0 && any_halfedge(surface, p.b, p.a) < 0) {
        throw InvalidInput("the contour's vertices " + std::to_string(p.a) + " and " + std::to_string(p.b) +
                           " are not joined by an edge");
    }
}

/// The order of points on edges, whichever way these are written.
std::tuple<int, int, long long> place_key(const SurfacePoint& p) {
    return p.a <= p.b ? std::tuple(p.a, p.b, std::llround(p.t * 1e12)) : std::tuple(p.b, p.a, std::llround((1.0 - p.t) * 1e12));
}

void check_distinct(const Contour& contour) {
    const std::size_t least = contour.closed ? 3 : 2;
    if (contour.points.size() < least) {
        throw InvalidInput("a contour of " + std::to_string(contour.points.size()) + " vertices: " +
                           (contour.closed ? "a closed" : "an open") + " contour needs at least " + std::to_string(least));
    }
    std::set<std::tuple<int, int, long long>> seen;
    for (const SurfacePoint& p : contour.points) {
        if (!seen.insert(place_key(p)).second) {
            throw InvalidInput("the contour passes " + point_name(p) +
                               " twice: give a contour that does not touch itself (a closed one does not repeat its first vertex)");
        }
    }
}

/// What keeps a band from growing on the side of this half-edge, in words; empty: nothing.
std::string obstacle(const Surface& surface, int halfedge) {
    if (halfedge == Surface::border) return "on the border of the mesh";
    if (halfedge == Surface::irregular) return "on an edge of more than two faces, or of two whose normals disagree";
    const int face = surface.halfedge_face(halfedge);
    if (surface.hidden(face)) return "beside the hidden face " + std::to_string(face);
    for (const int v : surface.face(face)) {
        if (!surface.regular(v))
            return "beside vertex " + std::to_string(v) + ", which is non-manifold or has faces whose normals disagree";
    }
    if (!usable(surface, face))
        return "beside face " + std::to_string(face) + ", two opposite corners of which another edge or face joins too";
    return {};
}

}  // namespace

std::string obstacle(const Surface& surface, int a, int b) {
    const int forward = surface.find_halfedge(a, b), backward = surface.find_halfedge(b, a);
    const int halfedge = forward >= 0 ? forward : backward, twin = surface.twin(halfedge);
    if (twin < 0) return obstacle(surface, twin);
    const std::string left = obstacle(surface, halfedge), right = obstacle(surface, twin);
    return left.empty() || right.empty() ? std::string() : left;
}

namespace {

/// Where on a triangle's border a point lies: side and share of it, as one number from 0 to 3.
double border_place(const Surface& surface, int triangle, const SurfacePoint& p) {
    for (int corner = 0; corner < 3; ++corner) {
        const int from = surface.triangle(triangle)[corner], to = surface.triangle(triangle)[(corner + 1) % 3];
        if (p.is_vertex() && p.a == from) return corner;
        if (!p.is_vertex() && p.a == from && p.b == to) return corner + p.t;
        if (!p.is_vertex() && p.b == from && p.a == to) return corner + 1.0 - p.t;
    }
    return -1.0;
}

struct Crossing {
    int triangle;
    double low, high;  // places on the triangle's border
    std::size_t segment;
};

/// Segments inside one triangle cross where their ends alternate on its border.
void check_crossings(const Contour& contour, std::vector<Crossing>& crossings) {
    std::ranges::sort(crossings, {}, &Crossing::triangle);
    for (auto first = crossings.begin(); first != crossings.end();) {
        const auto end = std::find_if(first, crossings.end(), [&](const Crossing& c) { return c.triangle != first->triangle; });
        for (auto i = first; i != end; ++i) {
            for (auto j = first; j != end; ++j) {
                if (i->low < j->low && j->low < i->high && i->high < j->high) {
                    throw InvalidInput("the contour crosses itself behind " + point_name(contour.points[i->segment]) +
                                       " and behind " + point_name(contour.points[j->segment]) +
                                       ": give a contour that does not touch itself");
                }
            }
        }
        first = end;
    }
}

bool on_edge(const Surface& surface, int halfedge, const SurfacePoint& p) {
    const int a = surface.from(halfedge), b = surface.to(halfedge);
    return (p.a == a || p.a == b) && (p.b == a || p.b == b);
}

void add_crossing(const Surface& surface, int triangle, const SurfacePoint& p, const SurfacePoint& q, std::size_t index,
                  std::vector<Crossing>& crossings) {
    const double from = border_place(surface, triangle, p), to = border_place(surface, triangle, q);
    crossings.push_back({triangle, std::min(from, to), std::max(from, to), index});
}

void check_edge(const Surface& surface, int a, int b) {
    if (!surface.real_edge(a, b)) {
        throw InvalidInput("the contour's vertices " + std::to_string(a) + " and " + std::to_string(b) +
                           " are not joined by an edge");
    }
    const std::string why = obstacle(surface, a, b);
    if (!why.empty()) throw InvalidInput("the contour's edge " + edge_name(a, b) + " lies " + why + ": move the contour off it");
}

void check_segment(const Surface& surface, const SurfacePoint& p, const SurfacePoint& q, std::size_t index,
                   std::vector<Crossing>& crossings) {
    if (p.is_vertex() && q.is_vertex()) check_edge(surface, p.a, q.a);
    const int triangle = triangle_of_segment(surface, p, q);
    if (triangle < 0) {
        throw InvalidInput("the contour leaves the surface between " + point_name(p) + " and " + point_name(q) +
                           ": consecutive points must lie on one triangle");
    }
    const SharedEdge edge(p, q);
    const bool along = edge.a >= 0 && surface.real_edge(edge.a, edge.b);
    const std::string why = along ? obstacle(surface, edge.a, edge.b) : obstacle(surface, 3 * triangle);
    if (!why.empty()) {
        throw InvalidInput("the contour between " + point_name(p) + " and " + point_name(q) + " lies " + why +
                           ": move the contour off it");
    }
    // A segment along an edge lies on the border of both its triangles.
    const int start = 3 * triangle;
    add_crossing(surface, triangle, p, q, index, crossings);
    for (int h = start; h < start + 3; ++h) {
        const int twin = surface.twin(h);
        if (twin >= 0 && on_edge(surface, h, p) && on_edge(surface, h, q)) add_crossing(surface, twin / 3, p, q, index, crossings);
    }
}

/// Collects polygons ring by ring and numbers their vertices.
class PatchBuilder {
  public:
    PatchBuilder(const Surface& surface, const Contour& contour) : surface_(surface) {
        patch_.closed = contour.closed;
        patch_.given = contour;
        for (const int v : snapped_contour(surface, contour)) patch_.contour.push_back(local_vertex(v));
    }

    void add_rings(std::optional<int> rings) {
        std::size_t begin = 0;
        for (int ring = 0; (!rings || ring < *rings) && begin < patch_.vertex.size(); ++ring) {
            for (const std::size_t end = patch_.vertex.size(); begin < end; ++begin) add_star(patch_.vertex[begin]);
        }
        patch_.first_face.push_back(static_cast<int>(patch_.polygon.size()));
    }

    Patch finish() {
        label_edges();
        measure_distances();
        return std::move(patch_);
    }

  private:
    const Surface& surface_;
    Patch patch_;
    std::unordered_map<int, int> local_;
    std::unordered_set<int> met_;
    std::vector<int> triangle_;

    int local_vertex(int vertex) {
        const auto [entry, fresh] = local_.emplace(vertex, static_cast<int>(patch_.vertex.size()));
        if (fresh) {
            patch_.vertex.push_back(vertex);
            const Vec3& p = surface_.position(vertex);
            patch_.mesh.add_vertex(PatchMesh::Point(p.x(), p.y(), p.z()));
        }
        return entry->second;
    }

    void add_star(int vertex) {
        for (const int h : surface_.outgoing(vertex)) {
            const int face = surface_.halfedge_face(h);
            if (met_.insert(face).second && usable(surface_, face)) add_polygon(face);
        }
    }

    void add_polygon(int face) {
        const int polygon = patch_.polygon_count();
        patch_.polygon_face.push_back(face);
        patch_.first_face.push_back(static_cast<int>(patch_.polygon.size()));
        for (int t = surface_.first_triangle(face); t < surface_.first_triangle(face + 1); ++t) {
            const auto& corners = surface_.triangle(t);
            const auto handle = [&](int c) { return PatchMesh::VertexHandle(local_vertex(corners[c])); };
            const auto added = patch_.mesh.add_face(handle(0), handle(1), handle(2));
            if (!added.is_valid()) throw std::logic_error("patch: face " + std::to_string(face) + " does not fit its neighbors");
            patch_.polygon.push_back(polygon);
            triangle_.push_back(t);
        }
    }

    void label_edges() {
        PatchMesh& mesh = patch_.mesh;
        patch_.halfedge.assign(mesh.n_halfedges(), -1);
        patch_.diagonal.assign(mesh.n_edges(), 0);
        for (std::size_t f = 0; f < triangle_.size(); ++f) {
            auto h = mesh.halfedge_handle(PatchMesh::FaceHandle(static_cast<int>(f)));
            for (int corner = 0; corner < 3; ++corner, h = mesh.next_halfedge_handle(h)) {
                const int from = patch_.vertex[mesh.from_vertex_handle(h).idx()];
                int halfedge = 3 * triangle_[f];
                while (surface_.from(halfedge) != from) ++halfedge;
                patch_.halfedge[h.idx()] = halfedge;
                patch_.diagonal[h.idx() / 2] = surface_.diagonal(halfedge);
            }
        }
        mark_borders();
    }

    void mark_borders() {
        for (const auto edge : patch_.mesh.edges()) {
            patch_.border_edge.push_back(surface_.twin(patch_.edge_halfedge(edge.idx())) < 0);
        }
    }

    void measure_distances() {
        const DistanceField field(surface_, patch_.given);
        for (const int v : patch_.vertex) patch_.distance.push_back(field.at(v));
    }
};

}  // namespace

Contour checked_contour(const Surface& surface, const Contour& contour) {
    for (const SurfacePoint& p : contour.points) check_point(surface, p);
    Contour checked = normalized(contour);
    check_distinct(checked);
    std::vector<Crossing> crossings;
    const std::size_t count = checked.points.size();
    for (std::size_t i = 0; i + (checked.closed ? 0 : 1) < count; ++i) {
        check_segment(surface, checked.points[i], checked.points[(i + 1) % count], i, crossings);
    }
    check_crossings(checked, crossings);
    return checked;
}

bool has_neighbor_along_edges(const Surface& surface, const Contour& contour) {
    const std::vector<int> snapped = snapped_contour(surface, contour);
    const std::size_t count = snapped.size();
    for (std::size_t i = 0; i + (contour.closed ? 0 : 1) < count; ++i) {
        if (!obstacle(surface, snapped[i], snapped[(i + 1) % count]).empty()) return false;
    }
    return !snapped.empty();
}

Patch make_patch(const Surface& surface, const Contour& contour, std::optional<int> rings) {
    if (!has_neighbor_along_edges(surface, contour)) {
        throw InvalidInput("no simple contour along mesh edges lies beside the given one, so that no band can grow from it");
    }
    PatchBuilder builder(surface, contour);
    builder.add_rings(rings);
    return builder.finish();
}

}  // namespace mrc
