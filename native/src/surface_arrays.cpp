// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_arrays.h"

#include "input_range.h"

#include <algorithm>
#include <limits>

namespace mrc {
namespace {

bool outside(int id, int count) { return static_cast<unsigned>(id) >= static_cast<unsigned>(count); }

std::string range_text(int count) { return count == 0 ? "there are none" : "they run from 0 to " + std::to_string(count - 1); }

std::vector<int> triangle_offsets(size_t corner_count) {
    if (corner_count % 3 != 0) {
        throw InvalidInput(ErrorCode::wrong_size, "face_vertices has " + std::to_string(corner_count) +
                                                      " entries and face_offsets is empty; triangles need a multiple of three");
    }
    std::vector<int> offsets(corner_count / 3 + 1);
    for (size_t face = 0; face < offsets.size(); ++face) offsets[face] = static_cast<int>(3 * face);
    return offsets;
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

}  // namespace

void require_size(size_t size, const char* what) {
    if (size > static_cast<size_t>(std::numeric_limits<int>::max()) / 3) {
        throw InvalidInput(ErrorCode::wrong_size,
                           std::string(what) + " has " + std::to_string(size) + " entries; that is too many for 32-bit ids");
    }
}

std::vector<Vec3> copy_positions(std::span<const double> values) {
    if (values.size() % 3 != 0) {
        throw InvalidInput(ErrorCode::wrong_size,
                           "positions has " + std::to_string(values.size()) + " numbers; every vertex needs three");
    }
    require_size(values.size() / 3, "positions");
    std::vector<Vec3> positions;
    positions.reserve(values.size() / 3);
    Complaints complaints;
    for (size_t i = 0; i < values.size(); i += 3) {
        positions.emplace_back(values[i], values[i + 1], values[i + 2]);
        const Vec3& p = positions.back();
        if ((p.array().abs() <= largest_input).all()) continue;
        complaints.add(ErrorCode::not_finite, Element::vertex(static_cast<int>(i / 3)), [&] {
            const std::string where = element_name("vertex", static_cast<int64_t>(i / 3));
            if (!p.allFinite()) return where + " has a position that is not finite";
            return where + " has a coordinate beyond 1e50, which is too large to compute with: scale the mesh down";
        });
    }
    complaints.raise();
    return positions;
}

std::vector<int> copy_offsets(std::span<const int32_t> offsets, size_t corner_count) {
    if (offsets.empty()) return triangle_offsets(corner_count);
    if (offsets.front() != 0 || offsets.back() != static_cast<int>(corner_count)) {
        throw InvalidInput(ErrorCode::wrong_size, "face_offsets must start with 0, rise, and end with the size of face_vertices (" +
                                                      std::to_string(corner_count) + "); it starts with " +
                                                      std::to_string(offsets.front()) + " and ends with " +
                                                      std::to_string(offsets.back()));
    }
    Complaints complaints;
    for (size_t face = 0; face + 1 < offsets.size(); ++face) {
        const int64_t n = int64_t{offsets[face + 1]} - offsets[face];
        if (n >= 3) continue;
        complaints.add(ErrorCode::invalid_face, Element::face(static_cast<int>(face)), [&] {
            const std::string where = element_name("face", static_cast<int64_t>(face));
            if (n >= 0) return where + " has " + std::to_string(n) + " vertices, fewer than three";
            return "face_offsets must start with 0, rise, and end with the size of face_vertices; it falls from " +
                   std::to_string(offsets[face]) + " to " + std::to_string(offsets[face + 1]) + " at " + where;
        });
    }
    complaints.raise();
    return {offsets.begin(), offsets.end()};
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
            complaints.add(ErrorCode::out_of_range, Element::face(face), [&] {
                return element_name("face", face) + " uses vertex " + std::to_string(*bad) + "; " + range_text(vertex_count);
            });
        } else if (const int v = repeated_vertex(polygon, scratch); v >= 0) {
            complaints.add(ErrorCode::invalid_face, Element::face(face),
                           [&] { return element_name("face", face) + " repeats vertex " + std::to_string(v); });
        }
    }
    complaints.raise();
}

std::vector<uint8_t> mark_hidden(std::span<const int32_t> hidden_faces, int face_count) {
    std::vector<uint8_t> hidden(face_count, 0);
    Complaints complaints;
    for (const int face : hidden_faces) {
        if (outside(face, face_count)) {
            complaints.add(ErrorCode::out_of_range, Element::face(face),
                           [&] { return "hidden face " + std::to_string(face) + " does not exist; " + range_text(face_count); });
        } else {
            hidden[face] = 1;
        }
    }
    complaints.raise();
    return hidden;
}

}  // namespace mrc
