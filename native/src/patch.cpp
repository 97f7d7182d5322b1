// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/patch.h>

#include <mrc/distances.h>

#include <algorithm>
#include <string>
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

void check_indices(const Surface& surface, const Contour& contour) {
    for (const SurfacePoint& p : contour.points) {
        for (const int v : {p.a, p.b}) {
            if (v < 0 || v >= surface.vertex_count()) {
                throw InvalidInput("contour vertex " + std::to_string(v) + " is out of range: the surface has " +
                                   std::to_string(surface.vertex_count()) + " vertices");
            }
        }
        if (!p.is_vertex()) {
            throw InvalidInput("the contour's point on edge " + edge_name(p.a, p.b) + " is not at a vertex: give a contour along mesh edges");
        }
    }
}

void check_simple(const Contour& contour) {
    const std::size_t least = contour.closed ? 3 : 2;
    if (contour.points.size() < least) {
        throw InvalidInput("a contour of " + std::to_string(contour.points.size()) + " vertices: a " +
                           (contour.closed ? "closed" : "open") + " contour needs at least " + std::to_string(least));
    }
    std::unordered_set<int> seen;
    for (const SurfacePoint& p : contour.points) {
        if (!seen.insert(p.a).second) {
            throw InvalidInput("the contour passes vertex " + std::to_string(p.a) +
                               " twice: give a contour that does not touch itself (a closed one does not repeat its first vertex)");
        }
    }
}

/// What keeps a band from growing on the side of this half-edge, in words; empty: nothing.
std::string obstacle(const Surface& surface, int halfedge) {
    if (halfedge == Surface::border) return "on the border of the mesh";
    if (halfedge == Surface::irregular) return "on an edge of more than two faces or of disagreeing winding";
    const int face = surface.halfedge_face(halfedge);
    if (surface.hidden(face)) return "beside the hidden face " + std::to_string(face);
    for (const int v : surface.face(face)) {
        if (!surface.regular(v)) return "beside the non-manifold vertex " + std::to_string(v);
    }
    if (!usable(surface, face)) return "beside face " + std::to_string(face) + ", whose diagonal joins the ends of another edge";
    return {};
}

/// The half-edge from a to b along the contour.
void check_edge(const Surface& surface, int a, int b) {
    const int forward = surface.find_halfedge(a, b), backward = surface.find_halfedge(b, a);
    if (forward < 0 && backward < 0) {
        throw InvalidInput("the contour's vertices " + std::to_string(a) + " and " + std::to_string(b) + " are not joined by an edge");
    }
    const int left = forward >= 0 ? forward : surface.twin(backward);
    const int right = backward >= 0 ? backward : surface.twin(forward);
    for (const int halfedge : {left, right, left >= 0 ? surface.twin(left) : left}) {
        if (const std::string why = obstacle(surface, halfedge); !why.empty()) {
            throw InvalidInput("the contour's edge " + edge_name(a, b) + " lies " + why + ": move the contour off it");
        }
    }
}

/// Collects polygons ring by ring and numbers their vertices.
class PatchBuilder {
  public:
    PatchBuilder(const Surface& surface, const Contour& contour) : surface_(surface) {
        patch_.closed = contour.closed;
        for (const SurfacePoint& p : contour.points) patch_.contour.push_back(local_vertex(p.a));
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
            if (!added.is_valid()) throw std::logic_error("patch: face " + std::to_string(face) + " does not fit its neighbours");
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
    }

    void measure_distances() {
        patch_.distance.assign(patch_.vertex.size(), 0.0);
        std::vector<int> seeds;
        for (const int v : patch_.contour) seeds.push_back(patch_.vertex[v]);
        std::size_t left = patch_.vertex.size();
        settle_outwards(surface_, seeds, [&](int vertex, double distance) {
            const auto found = local_.find(vertex);
            if (found == local_.end()) return true;
            patch_.distance[found->second] = distance;
            return --left > 0;
        });
    }
};

}  // namespace

void check_contour(const Surface& surface, const Contour& contour) {
    check_indices(surface, contour);
    check_simple(contour);
    const std::size_t count = contour.points.size();
    for (std::size_t i = 0; i + (contour.closed ? 0 : 1) < count; ++i) {
        check_edge(surface, contour.points[i].a, contour.points[(i + 1) % count].a);
    }
}

Patch make_patch(const Surface& surface, const Contour& contour, std::optional<int> rings) {
    check_contour(surface, contour);
    PatchBuilder builder(surface, contour);
    builder.add_rings(rings);
    return builder.finish();
}

}  // namespace mrc
