// SPDX-License-Identifier: GPL-3.0-or-later
#include "ambient_graph.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mrc {
namespace {

/// A point on a triangle's border, with the whole number that lifts its flow value to the triangle's first corner's.
struct LiftedPoint {
    int point, lift;
};

class AmbientGraphBuilder {
  public:
    AmbientGraphBuilder(const Patch& patch, const Band& band, const Flow& flow, int steiner)
        : patch_(patch), band_(band), flow_(flow) {
        ambient_.steiner = steiner;
    }

    AmbientGraph build() {
        const std::size_t k = ambient_.steiner, edges = std::ranges::count(band_.edge, 1),
                          faces = std::ranges::count(band_.face, 1);
        ambient_.segments.reserve(edges * (k + 1) + faces * 3 * k * (k + 1));
        merge_vertices();
        add_vertices();
        add_steiner_points();
        add_edge_segments();
        if (k > 0) {
            add_face_segments();
            merge_levels(ambient_.values, ambient_.segments, level_points);
        }
        return std::move(ambient_);
    }

  private:
    const Patch& patch_;
    const Band& band_;
    Flow flow_;
    AmbientGraph ambient_;

    double rank(int v) const { return static_cast<double>(band_.side[v]) * patch_.distance[v]; }
    /// The regular graph never sees a diagonal; refined chords may cross one or run along it.
    bool used(int e) const { return band_.edge[e] && (ambient_.steiner > 0 || !patch_.diagonal[e]); }

    /// Vertices are made level before points come between them, so that the flow stays linear in every triangle.
    void merge_vertices() {
        std::vector<int> edges;
        std::vector<Segment> uncut;  // between patch vertices
        for (int e = 0; e < static_cast<int>(patch_.mesh.n_edges()); ++e) {
            if (!used(e)) continue;
            edges.push_back(e);
            uncut.push_back({patch_.from(2 * e), patch_.to(2 * e), flow_.jump[2 * e], -1, -1});
        }
        merge_levels(flow_.value, uncut, level_vertices);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            flow_.jump[2 * edges[i]] = uncut[i].jump;
            flow_.jump[opposite(2 * edges[i])] = -uncut[i].jump;
        }
    }

    void add_vertices() {
        ambient_.point_of_vertex.assign(patch_.vertex.size(), -1);
        for (std::size_t v = 0; v < patch_.vertex.size(); ++v) {
            if (band_.side[v] == Side::outside) continue;
            ambient_.point_of_vertex[v] = static_cast<int>(ambient_.places.size());
            ambient_.local.emplace(patch_.vertex[v], static_cast<int>(v));
            ambient_.places.push_back(vertex_point(patch_.vertex[v]));
            ambient_.ranks.push_back(rank(static_cast<int>(v)));
            ambient_.values.push_back(flow_.value[v]);
        }
    }

    /// k equally spaced points on each edge, from half-edge 2 e's start to its end (3.2). The flow is linear along the edge.
    void add_steiner_points() {
        ambient_.first_point_of_edge.assign(patch_.mesh.n_edges(), -1);
        for (int e = 0; e < static_cast<int>(patch_.mesh.n_edges()); ++e) {
            if (ambient_.steiner == 0 || !used(e)) continue;
            const int a = patch_.from(2 * e), b = patch_.to(2 * e);
            ambient_.first_point_of_edge[e] = static_cast<int>(ambient_.places.size());
            for (int i = 1; i <= ambient_.steiner; ++i) {
                const double t = static_cast<double>(i) / (ambient_.steiner + 1);
                ambient_.places.push_back({patch_.vertex[a], patch_.vertex[b], t});
                ambient_.ranks.push_back((1.0 - t) * rank(a) + t * rank(b));
                ambient_.values.push_back(flow_.value[a] + t * flow_.increment(patch_.mesh, 2 * e));
            }
        }
    }

    /// The edges, each cut into k + 1 segments.
    void add_edge_segments() {
        for (int e = 0; e < static_cast<int>(patch_.mesh.n_edges()); ++e) {
            if (!used(e)) continue;
            const int halfedge = patch_.halfedge[2 * e] >= 0 ? patch_.halfedge[2 * e] : patch_.halfedge[2 * e + 1];
            const bool walkable = !patch_.border_edge[e];
            int last = ambient_.point_of_vertex[patch_.from(2 * e)];
            for (int i = 0; i < ambient_.steiner; ++i) {
                ambient_.segments.push_back({last, ambient_.first_point_of_edge[e] + i, 0, halfedge, -1, walkable});
                last = ambient_.first_point_of_edge[e] + i;
            }
            ambient_.segments.push_back(
                {last, ambient_.point_of_vertex[patch_.to(2 * e)], flow_.jump[2 * e], halfedge, -1, walkable});
        }
    }

    /// The chords inside each triangle: from a corner to the points of the side opposite, and between points of two sides.
    void add_face_segments() {
        for (std::size_t f = 0; f < band_.face.size(); ++f) {
            if (!band_.face[f]) continue;
            std::array<LiftedPoint, 3> corners;
            std::array<std::vector<LiftedPoint>, 3> sides;
            lift_triangle(static_cast<int>(f), corners, sides);
            const auto add = [&](const LiftedPoint& p, const LiftedPoint& q) {
                ambient_.segments.push_back({p.point, q.point, q.lift - p.lift, -1, static_cast<int>(f)});
            };
            for (std::size_t i = 0; i < 3; ++i) {
                for (const LiftedPoint& q : sides[(i + 1) % 3]) add(corners[i], q);
                for (const LiftedPoint& p : sides[i]) {
                    for (const LiftedPoint& q : sides[(i + 1) % 3]) add(p, q);
                }
            }
        }
    }

    /// A side's points hold their flow value from the start of its edge's first half-edge.
    void lift_triangle(int f, std::array<LiftedPoint, 3>& corners, std::array<std::vector<LiftedPoint>, 3>& sides) const {
        auto h = patch_.mesh.halfedge_handle(PatchMesh::FaceHandle(f));
        int lift = 0;
        for (std::size_t i = 0; i < 3; ++i, h = patch_.mesh.next_halfedge_handle(h)) {
            corners[i] = {ambient_.point_of_vertex[patch_.from(h.idx())], lift};
            const int next = lift + flow_.jump[h.idx()];
            const bool forward = h.idx() % 2 == 0;
            for (int s = 0; s < ambient_.steiner; ++s)
                sides[i].push_back({ambient_.first_point_of_edge[h.idx() / 2] + s, forward ? lift : next});
            lift = next;
        }
    }
};

}  // namespace

int AmbientGraph::point_at(const Patch& patch, const SurfacePoint& place) const {
    const auto vertex = [&](int v) {
        const auto found = local.find(v);
        return found == local.end() ? -1 : found->second;
    };
    const int a = vertex(place.a), b = vertex(place.b);
    if (a < 0 || b < 0) return -1;
    if (place.is_vertex()) return point_of_vertex[a];
    const auto h = patch.find_halfedge(a, b);
    if (!h.is_valid() || first_point_of_edge[h.idx() / 2] < 0) return -1;
    const double t = (h.idx() % 2 == 0 ? place.t : 1.0 - place.t) * (steiner + 1);
    if (std::abs(t - std::round(t)) > 1e-9) return -1;
    return first_point_of_edge[h.idx() / 2] + static_cast<int>(std::lround(t)) - 1;
}

AmbientGraph make_ambient_graph(const Patch& patch, const Band& band, const Flow& flow, int steiner) {
    return AmbientGraphBuilder(patch, band, flow, steiner).build();
}

}  // namespace mrc
