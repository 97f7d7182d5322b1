// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/surface.h>

#include "components.h"
#include "surface_arrays.h"
#include "triangulate.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

namespace mrc {
namespace {

using Triangle = std::array<int, 3>;

std::vector<Triangle> to_triangles(std::span<const int32_t> vertices) {
    std::vector<Triangle> triangles(vertices.size() / 3);
    if (!triangles.empty()) std::memcpy(triangles.data(), vertices.data(), vertices.size_bytes());
    return triangles;
}

// The half-edges of real edges whose lower vertex is v, grouped by their upper vertex, within a group by index.
class EdgeBucket {
  public:
    EdgeBucket(const std::vector<Triangle>& triangles, const std::vector<uint8_t>& diagonal)
        : triangles_(triangles), diagonal_(diagonal) {}

    void gather(int v, std::span<const int> outgoing) {
        entries_.clear();
        for (const int h : outgoing) {
            const int corner = h % 3;
            const int previous = corner == 0 ? h + 2 : h - 1;
            const Triangle& triangle = triangles_[h / 3];
            add(v, triangle[corner == 2 ? 0 : corner + 1], h, 0);
            add(v, triangle[corner == 0 ? 2 : corner - 1], previous, 1);
        }
        std::ranges::sort(entries_);
    }

    size_t size() const { return entries_.size(); }
    int upper(size_t i) const { return static_cast<int>(entries_[i] >> 32); }
    int halfedge(size_t i) const { return static_cast<int>((entries_[i] & 0xffffffffu) >> 1); }
    bool falling(size_t i) const { return (entries_[i] & 1) != 0; }

  private:
    const std::vector<Triangle>& triangles_;
    const std::vector<uint8_t>& diagonal_;
    std::vector<uint64_t> entries_;  // upper vertex, half-edge, 1 where it runs down to the lower vertex

    void add(int v, int upper, int halfedge, unsigned falling) {
        if (upper < v || diagonal_[halfedge] != 0) return;
        entries_.push_back(static_cast<uint64_t>(upper) << 32 | static_cast<uint64_t>(halfedge) << 1 | falling);
    }
};

}  // namespace

Surface::Surface(const SurfaceArrays& arrays) {
    copy_and_validate(arrays);
    triangulate(arrays);
    connect();
    classify_vertices();
    components_ = std::make_shared<Components>();
}

void Surface::copy_and_validate(const SurfaceArrays& arrays) {
    require_size(arrays.face_vertices.size(), "face_vertices");
    positions_ = copy_positions(arrays.positions);
    face_offsets_ = copy_offsets(arrays.face_offsets, arrays.face_vertices.size());
    check_faces(face_offsets_, arrays.face_vertices, vertex_count());
    hidden_ = mark_hidden(arrays.hidden_faces, face_count());
}

void Surface::triangulate(const SurfaceArrays& arrays) {
    const size_t count = static_cast<size_t>(first_triangle(face_count()));
    const std::span<const int32_t> given = arrays.triangles;
    if (!given.empty() && given.size() != 3 * count) {
        throw InvalidInput(ErrorCode::wrong_size, "triangles has " + std::to_string(given.size()) +
                                                      " entries; n - 2 triples for every face of n make " +
                                                      std::to_string(3 * count));
    }
    diagonal_.resize(3 * count);
    twins_.assign(3 * count, border);
    edges_.resize(3 * count);
    triangle_faces_.resize(count);
    if (arrays.face_vertices.size() == 3 * count && (given.empty() || std::ranges::equal(given, arrays.face_vertices))) {
        // Triangles only, as in most large meshes: they are the polygons as well, and there is no diagonal.
        triangles_ = to_triangles(arrays.face_vertices);
        std::iota(triangle_faces_.begin(), triangle_faces_.end(), 0);
        return;
    }
    face_vertices_.assign(arrays.face_vertices.begin(), arrays.face_vertices.end());
    if (given.empty()) {
        triangles_.resize(count);
        cut_polygons();
    } else {
        triangles_ = to_triangles(given);
    }
    pair_diagonals();
}

void Surface::cut_polygons() {
    Triangulator cut;
    std::vector<Vec3> corners;
    for (int f = 0; f < face_count(); ++f) {
        const std::span<const int> polygon = face(f);
        int t = first_triangle(f);
        corners.clear();
        if (polygon.size() > 3) {
            for (const int v : polygon) corners.push_back(positions_[v]);
        }
        for (const auto& [a, b, c] : cut(corners)) triangles_[t++] = {polygon[a], polygon[b], polygon[c]};
    }
}

void Surface::pair_diagonals() {
    const auto pair = [&](int a, int b) {
        diagonal_[a] = diagonal_[b] = 1;
        twins_[a] = b;
        twins_[b] = a;
        edges_[a] = edges_[b] = a;
    };
    PolygonSides sides(vertex_count());
    Complaints complaints;
    for (int f = 0; f < face_count(); ++f) {
        const std::span<const int> polygon = face(f);
        const int first = first_triangle(f);
        const auto triangles = std::span(triangles_).subspan(first, polygon.size() - 2);
        std::fill_n(triangle_faces_.begin() + first, triangles.size(), f);
        if (sides.read(polygon, triangles, first)) {
            sides.for_each_diagonal(pair);
        } else {
            complaints.add(ErrorCode::invalid_triangles, Element::face(f), [&] {
                return "the triangles of " + element_name("face", f) + " do not make up its polygon: " + sides.fault();
            });
        }
    }
    complaints.raise();
}

void Surface::sort_outgoing() {
    // A counting sort; it leaves the half-edges of each vertex in ascending order.
    outgoing_offsets_.assign(positions_.size() + 1, 0);
    for (const Triangle& triangle : triangles_) {
        for (const int v : triangle) ++outgoing_offsets_[v];
    }
    std::exclusive_scan(outgoing_offsets_.begin(), outgoing_offsets_.end(), outgoing_offsets_.begin(), 0);
    outgoing_.resize(3 * triangles_.size());
    int h = 0;
    for (const Triangle& triangle : triangles_) {
        for (const int v : triangle) outgoing_[outgoing_offsets_[v]++] = h++;
    }
    // Each offset now stands at the end of its vertex, which is where the next one starts.
    std::shift_right(outgoing_offsets_.begin(), outgoing_offsets_.end(), 1);
    outgoing_offsets_[0] = 0;
}

void Surface::connect() {
    sort_outgoing();
    EdgeBucket bucket(triangles_, diagonal_);
    for (int v = 0; v < vertex_count(); ++v) {
        bucket.gather(v, outgoing(v));
        for (size_t i = 0, end = 0; i < bucket.size(); i = end) {
            const int first = bucket.halfedge(i);
            for (end = i; end < bucket.size() && bucket.upper(end) == bucket.upper(i); ++end) edges_[bucket.halfedge(end)] = first;
            if (end - i == 2 && bucket.falling(i) != bucket.falling(i + 1)) {
                twins_[first] = bucket.halfedge(i + 1);
                twins_[twins_[first]] = first;
            } else if (end - i > 1) {
                for (size_t k = i; k < end; ++k) twins_[bucket.halfedge(k)] = irregular;
            }
        }
    }
    number_edges();
}

void Surface::number_edges() {
    // So far every half-edge holds the first half-edge of its edge, which comes before it and has its number already.
    for (int h = 0; h < halfedge_count(); ++h) edges_[h] = edges_[h] == h ? edge_count_++ : edges_[edges_[h]];
}

void Surface::classify_vertices() {
    // A walk through twins stops at irregular edges as at borders. It cannot reach every face at a vertex with such an edge: it
    // passes other edges only, so of three faces on the edge it misses one, and two of disagreeing winding are never on one walk.
    regular_.resize(positions_.size());
    for (int v = 0; v < vertex_count(); ++v) {
        const std::span<const int> fan = outgoing(v);
        regular_[v] = fan.empty() || fan_size(fan[0]) == fan.size();
    }
}

size_t Surface::fan_size(int start) const {
    size_t size = 1;
    for (int h = twin(previous(start)); h != start; h = twin(previous(h)), ++size) {
        if (h >= 0) continue;
        for (h = twin(start); h >= 0; h = twin(next(h))) ++size;  // an open fan: the rest lies on the other side
        break;
    }
    return size;
}

std::span<const int> Surface::face(int face) const {
    if (face_vertices_.empty()) return triangles_[face];
    return std::span(face_vertices_).subspan(face_offsets_[face], face_offsets_[face + 1] - face_offsets_[face]);
}

std::span<const int> Surface::outgoing(int vertex) const {
    return std::span(outgoing_).subspan(outgoing_offsets_[vertex], outgoing_offsets_[vertex + 1] - outgoing_offsets_[vertex]);
}

int Surface::find_halfedge(int a, int b, EdgeKind kind) const {
    const std::span<const int> candidates = outgoing(a);
    const auto found =
        std::ranges::find_if(candidates, [&](int h) { return to(h) == b && (kind == EdgeKind::any || !diagonal(h)); });
    return found == candidates.end() ? no_element : *found;
}

}  // namespace mrc
