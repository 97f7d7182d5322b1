// SPDX-License-Identifier: GPL-3.0-or-later
#include "patch.h"

#include "distances.h"
#include "edge_obstacles.h"
#include "segments.h"
#include "snapped_contour.h"

#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace mrc {
namespace {

/// Collects polygons ring by ring and numbers their vertices.
class PatchBuilder {
  public:
    PatchBuilder(const Surface& surface, const Contour& contour, const Beat& beat) : surface_(surface), beat_(beat) {
        patch_.closed = contour.closed;
        patch_.given = contour;
        for (const int v : snapped_contour(surface, contour)) patch_.contour.push_back(local_vertex(v));
    }

    void add_rings(std::optional<int> rings) {
        std::size_t begin = 0;
        for (int ring = 0; (!rings || ring < *rings) && begin < patch_.vertex.size(); ++ring) {
            for (const std::size_t end = patch_.vertex.size(); begin < end; ++begin) {
                beat(begin);
                add_star(patch_.vertex[begin]);
            }
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
    const Beat& beat_;
    Patch patch_;
    std::unordered_map<int, int> local_;
    std::unordered_set<int> met_;
    std::vector<int> triangle_;

    void beat(std::size_t i) const { beat_at(i, beat_); }

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
            if (met_.insert(face).second && usable_face(surface_, face)) add_polygon(face);
        }
    }

    void add_polygon(int face) {
        const int polygon = patch_.polygon_count();
        patch_.polygon_face.push_back(face);
        patch_.first_face.push_back(static_cast<int>(patch_.polygon.size()));
        for (int t = surface_.first_triangle(face); t < surface_.first_triangle(face + 1); ++t) {
            const auto& corners = surface_.triangle(t);
            const auto handle = [&](int c) { return PatchMesh::VertexHandle(local_vertex(corners[c])); };
            const auto third = handle(2), second = handle(1), first = handle(0);  // compilers differ in how they order arguments
            const auto added = patch_.mesh.add_face(first, second, third);
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
            beat(f);
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
        for (const int v : patch_.vertex) {
            beat(patch_.distance.size());
            patch_.distance.push_back(field.at(v));
        }
    }
};

}  // namespace

bool has_neighbor_along_edges(const Surface& surface, const Contour& contour) {
    const std::vector<int> snapped = snapped_contour(surface, contour);
    for (const auto& [a, b] : segments(snapped, contour.closed)) {
        if (obstacle(surface, a, b)) return false;
    }
    return !snapped.empty();
}

Patch make_patch(const Surface& surface, const Contour& contour, std::optional<int> rings, const Beat& beat) {
    if (!has_neighbor_along_edges(surface, contour)) {
        throw InvalidInput(ErrorCode::no_neighbor,
                           "no simple contour along mesh edges lies beside the given one, so that no band can grow from it");
    }
    PatchBuilder builder(surface, contour, beat);
    builder.add_rings(rings);
    return builder.finish();
}

}  // namespace mrc
