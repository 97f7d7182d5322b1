// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/surface.h>

#include "components.h"

#include "triangulate.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace mrc {
namespace {

using Triangle = std::array<int, 3>;

// Gathers what is wrong, says the first few in full and how many more there are.
class Complaints {
  public:
    template <class Text>
    void add(Text&& text) {
        if (++count_ > shown) return;
        if (!message_.empty()) message_ += "; ";
        message_ += text();
    }

    void raise() const {
        if (count_ == 0) return;
        const std::string more = count_ > shown ? "; and " + std::to_string(count_ - shown) + " more" : "";
        throw InvalidInput(message_ + more);
    }

  private:
    static constexpr size_t shown = 3;
    size_t count_ = 0;
    std::string message_;
};

std::string name(const char* kind, int64_t id) { return std::string(kind) + " " + std::to_string(id); }

bool outside(int id, int count) { return static_cast<unsigned>(id) >= static_cast<unsigned>(count); }

std::string range_text(int count) { return count == 0 ? "there are none" : "they run from 0 to " + std::to_string(count - 1); }

void require_size(size_t size, const char* what) {
    if (size > static_cast<size_t>(std::numeric_limits<int>::max()) / 3) {
        throw InvalidInput(std::string(what) + " has " + std::to_string(size) + " entries; that is too many for 32-bit ids");
    }
}

constexpr double farthest = 1e50;

std::vector<Vec3> copy_positions(std::span<const double> values) {
    if (values.size() % 3 != 0) {
        throw InvalidInput("positions has " + std::to_string(values.size()) + " numbers; every vertex needs three");
    }
    require_size(values.size() / 3, "positions");
    std::vector<Vec3> positions;
    positions.reserve(values.size() / 3);
    Complaints complaints;
    for (size_t i = 0; i < values.size(); i += 3) {
        positions.emplace_back(values[i], values[i + 1], values[i + 2]);
        const Vec3& p = positions.back();
        if ((p.array().abs() <= farthest).all()) continue;
        complaints.add([&] {
            const std::string where = name("vertex", static_cast<int64_t>(i / 3));
            if (!p.allFinite()) return where + " has a position that is not finite";
            return where + " has a coordinate beyond 1e50, whose powers are no numbers any more: scale the mesh down";
        });
    }
    complaints.raise();
    return positions;
}

std::vector<int> triangle_offsets(size_t corner_count) {
    if (corner_count % 3 != 0) {
        throw InvalidInput("face_vertices has " + std::to_string(corner_count) +
                           " entries and face_offsets is empty; triangles need a multiple of three");
    }
    std::vector<int> offsets(corner_count / 3 + 1);
    for (size_t face = 0; face < offsets.size(); ++face) offsets[face] = static_cast<int>(3 * face);
    return offsets;
}

std::vector<int> copy_offsets(std::span<const int32_t> offsets, size_t corner_count) {
    if (offsets.empty()) return triangle_offsets(corner_count);
    if (offsets.front() != 0 || offsets.back() != static_cast<int>(corner_count)) {
        throw InvalidInput("face_offsets must start with 0, rise, and end with the size of face_vertices (" +
                           std::to_string(corner_count) + "); it starts with " + std::to_string(offsets.front()) +
                           " and ends with " + std::to_string(offsets.back()));
    }
    Complaints complaints;
    for (size_t face = 0; face + 1 < offsets.size(); ++face) {
        const int64_t n = int64_t{offsets[face + 1]} - offsets[face];
        if (n >= 3) continue;
        complaints.add([&] {
            const std::string where = name("face", static_cast<int64_t>(face));
            if (n >= 0) return where + " has " + std::to_string(n) + " vertices, fewer than three";
            return "face_offsets must start with 0, rise, and end with the size of face_vertices; it falls from " +
                   std::to_string(offsets[face]) + " to " + std::to_string(offsets[face + 1]) + " at " + where;
        });
    }
    complaints.raise();
    return {offsets.begin(), offsets.end()};
}

// The vertex that a polygon holds more than once, or -1.
int repeated_vertex(std::span<const int> polygon, std::vector<int>& scratch) {
    constexpr size_t small = 8;
    if (polygon.size() > small) {
        scratch.assign(polygon.begin(), polygon.end());
        std::ranges::sort(scratch);
        const auto repeated = std::ranges::adjacent_find(scratch);
        return repeated == scratch.end() ? -1 : *repeated;
    }
    for (size_t i = 1; i < polygon.size(); ++i) {
        for (size_t j = 0; j < i; ++j) {
            if (polygon[i] == polygon[j]) return polygon[i];
        }
    }
    return -1;
}

// True where all faces are triangles of three different vertices in range: one pass without branches for the usual case.
bool triangles_are_sound(std::span<const int> face_vertices, int face_count, int vertex_count) {
    if (face_vertices.size() != 3 * static_cast<size_t>(face_count)) return false;
    const unsigned limit = static_cast<unsigned>(vertex_count);
    bool bad = false;
    for (size_t i = 0; i < face_vertices.size(); i += 3) {
        const unsigned a = static_cast<unsigned>(face_vertices[i]);
        const unsigned b = static_cast<unsigned>(face_vertices[i + 1]);
        const unsigned c = static_cast<unsigned>(face_vertices[i + 2]);
        bad |= (a >= limit) | (b >= limit) | (c >= limit) | (a == b) | (b == c) | (c == a);
    }
    return !bad;
}

void check_faces(std::span<const int> face_offsets, std::span<const int> face_vertices, int vertex_count) {
    const int face_count = static_cast<int>(face_offsets.size()) - 1;
    if (triangles_are_sound(face_vertices, face_count, vertex_count)) return;
    Complaints complaints;
    std::vector<int> scratch;
    for (int face = 0; face < face_count; ++face) {
        const auto polygon = face_vertices.subspan(face_offsets[face], face_offsets[face + 1] - face_offsets[face]);
        const auto bad = std::ranges::find_if(polygon, [&](int v) { return outside(v, vertex_count); });
        if (bad != polygon.end()) {
            complaints.add(
                [&] { return name("face", face) + " uses vertex " + std::to_string(*bad) + "; " + range_text(vertex_count); });
        } else if (const int v = repeated_vertex(polygon, scratch); v >= 0) {
            complaints.add([&] { return name("face", face) + " repeats vertex " + std::to_string(v); });
        }
    }
    complaints.raise();
}

std::vector<uint8_t> mark_hidden(std::span<const int32_t> hidden_faces, int face_count) {
    std::vector<uint8_t> hidden(face_count, 0);
    Complaints complaints;
    for (const int face : hidden_faces) {
        if (outside(face, face_count)) {
            complaints.add([&] { return "hidden face " + std::to_string(face) + " is no face; " + range_text(face_count); });
        } else {
            hidden[face] = 1;
        }
    }
    complaints.raise();
    return hidden;
}

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
        throw InvalidInput("triangles has " + std::to_string(given.size()) + " entries; n - 2 triples for every face of n make " +
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
            complaints.add([&] { return "the triangles of " + name("face", f) + " do not make up its polygon: " + sides.fault(); });
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
        for (h = twin(start); h >= 0; h = twin(next(h))) ++size;  // an open fan: the rest lies the other way
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

int Surface::find_halfedge(int a, int b) const {
    const std::span<const int> candidates = outgoing(a);
    const auto found = std::ranges::find_if(candidates, [&](int h) { return to(h) == b && !diagonal(h); });
    return found == candidates.end() ? -1 : *found;
}

}  // namespace mrc
