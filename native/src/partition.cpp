// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition.h"

#include "segments.h"
#include "surface_point.h"

#include <algorithm>
#include <set>

namespace mrc {
namespace {

/// The local vertices of a polygon, without repetition.
std::vector<int> polygon_vertices(const Patch& patch, int polygon) {
    std::vector<int> vertices;
    for (int f = patch.first_face[polygon]; f < patch.first_face[polygon + 1]; ++f) {
        for (const auto v : patch.mesh.fv_range(PatchMesh::FaceHandle(f))) vertices.push_back(v.idx());
    }
    std::ranges::sort(vertices);
    vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
    return vertices;
}

/// The faces inside which a contour runs, also where that is along a diagonal.
std::vector<int> crossed_faces(const Surface& surface, const Contour& contour) {
    std::vector<int> faces;
    for (const auto& [p, q] : segments(contour)) {
        const auto edge = shared_edge(p, q);
        if (edge && surface.real_edge(edge->a, edge->b)) continue;
        faces.push_back(surface.triangle_face(triangle_of_segment(surface, p, q)));
    }
    return faces;
}

}  // namespace

void Partition::add(Owners& owners, int element, int contour) {
    std::vector<int>& list = owners[element];
    if (std::ranges::find(list, contour) == list.end()) list.push_back(contour);
}

std::span<const int> Partition::owners_of(const Owners& owners, int element) {
    const auto found = owners.find(element);
    return found == owners.end() ? std::span<const int>() : std::span<const int>(found->second);
}

bool Partition::has_other(std::span<const int> owners, int contour) {
    return std::ranges::any_of(owners, [&](int other) { return other != contour; });
}

int Partition::edge_of(const Patch& patch, int e) const { return surface_.edge(patch.edge_halfedge(e)); }

void Partition::occupy(int contour, const Contour& where) {
    const auto edge_between = [&](int a, int b) { return surface_.edge(surface_.find_edge(a, b, EdgeKind::any)); };
    for (const SurfacePoint& p : where.points) {
        if (p.is_vertex()) {
            add(vertices_, p.a, contour);
        } else {
            add(edges_, edge_between(p.a, p.b), contour);
        }
    }
    for (const auto& [p, q] : segments(where)) {
        const auto edge = shared_edge(p, q);
        if (edge && surface_.real_edge(edge->a, edge->b)) add(edges_, edge_between(edge->a, edge->b), contour);
    }
    for (const int face : crossed_faces(surface_, where)) add(faces_, face, contour);
}

std::vector<int> Partition::entangled_with(int contour, const Contour& where) const {
    std::set<int> others;
    for (const int face : crossed_faces(surface_, where)) {
        const auto owners = owners_of(faces_, face);
        others.insert(owners.begin(), owners.end());
    }
    others.erase(contour);
    return {others.begin(), others.end()};
}

void Partition::claim(int contour, const Patch& patch) {
    for (int p = 0; p < patch.polygon_count(); ++p) {
        double distance = 0.0;
        for (const int v : polygon_vertices(patch, p)) distance += patch.distance[v];
        claims_[patch.polygon_face[p]].emplace_back(contour, distance);
    }
}

/// The contours that a face belongs to, or would without the ties between them, where it is not this one's.
std::vector<int> Partition::refusing(int contour, int face) const {
    std::vector<int> others;
    const auto crossing = owners_of(faces_, face);
    if (!crossing.empty()) {
        std::ranges::copy_if(crossing, std::back_inserter(others), [&](int other) { return other != contour; });
        return others;
    }
    const auto& claims = claims_.at(face);
    const double own = std::ranges::find(claims, contour, &std::pair<int, double>::first)->second;
    for (const auto& [other, distance] : claims) {
        if (other != contour && distance <= own + 1e-9 * (own + distance)) others.push_back(other);
    }
    return others;
}

Exclusion Partition::exclusion(int contour, const Patch& patch) const {
    Exclusion exclusion;
    for (const int face : patch.polygon_face) exclusion.refused.push_back(!refusing(contour, face).empty());
    for (int e = 0; e < static_cast<int>(patch.mesh.n_edges()); ++e) {
        exclusion.wall.push_back(has_other(owners_of(edges_, edge_of(patch, e)), contour));
    }
    return exclusion;
}

void Partition::enclose(int contour, const Patch& patch, const Band& band) {
    for (std::size_t v = 0; v < patch.vertex.size(); ++v) {
        if (band.side[v] != Side::outside) add(band_vertices_, patch.vertex[v], contour);
    }
    for (int e = 0; e < static_cast<int>(patch.mesh.n_edges()); ++e) {
        if (band.edge[e]) add(band_edges_, edge_of(patch, e), contour);
    }
}

void Partition::close(int contour, const Patch& patch, Exclusion& exclusion) const {
    for (const int v : patch.vertex) {
        exclusion.closed_vertex.push_back(has_other(owners_of(vertices_, v), contour) ||
                                          has_other(owners_of(band_vertices_, v), contour));
    }
    for (int e = 0; e < static_cast<int>(patch.mesh.n_edges()); ++e) {
        const int edge = edge_of(patch, e);
        exclusion.closed_edge.push_back(has_other(owners_of(edges_, edge), contour) ||
                                        has_other(owners_of(band_edges_, edge), contour));
    }
}

std::vector<int> Partition::held_back_by(int contour, const Patch& patch, const Band& band) const {
    std::set<int> others;
    for (const int polygon : band.refused) {
        for (const int other : refusing(contour, patch.polygon_face[polygon])) others.insert(other);
    }
    for (std::size_t v = 0; v < patch.vertex.size(); ++v) {
        if (band.side[v] == Side::outside) continue;
        const auto occupied = owners_of(vertices_, patch.vertex[v]);
        if (std::ranges::find(occupied, contour) != occupied.end()) continue;  // its own, and open to it
        others.insert(occupied.begin(), occupied.end());
        const auto enclosed = owners_of(band_vertices_, patch.vertex[v]);
        others.insert(enclosed.begin(), enclosed.end());
    }
    for (int e = 0; e < static_cast<int>(patch.mesh.n_edges()); ++e) {
        const auto walls = band.edge[e] ? owners_of(edges_, edge_of(patch, e)) : std::span<const int>();
        others.insert(walls.begin(), walls.end());
    }
    others.erase(contour);
    return {others.begin(), others.end()};
}

bool Partition::shares(int contour, int vertex) const { return has_other(owners_of(vertices_, vertex), contour); }

}  // namespace mrc
