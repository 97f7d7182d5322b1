// SPDX-License-Identifier: GPL-3.0-or-later
#include "generated_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace mrc {
namespace {

constexpr int most_faces = 200;

enum class Shape { tube, torus, ball, plane, twisted, kMaxValue = twisted };

/// Rows of vertices and the quads between them; where rows or columns wrap, the last quads lead back to the first.
struct Grid {
    int rows, columns;
    bool wrap_rows, wrap_columns, twist;

    int vertex(int row, int column) const {
        const int across = twist && column == columns ? rows - 1 - row : row;
        return (across % rows) * columns + column % columns;
    }
};

Vec3 place(Shape shape, double row, double column, double radius) {
    const double u = 2.0 * std::numbers::pi * column, v = 2.0 * std::numbers::pi * row;
    switch (shape) {
        case Shape::tube:
            return {radius * std::cos(u), radius * std::sin(u), 4.0 * row};
        case Shape::torus:
            return {(3.0 + radius * std::cos(v)) * std::cos(u), (3.0 + radius * std::cos(v)) * std::sin(u), radius * std::sin(v)};
        case Shape::ball: {
            const double latitude = std::numbers::pi * (0.05 + 0.9 * row);
            return radius * Vec3(std::sin(latitude) * std::cos(u), std::sin(latitude) * std::sin(u), -std::cos(latitude));
        }
        case Shape::twisted:
            return {(2.0 + (row - 0.5) * std::cos(0.5 * u)) * std::cos(u), (2.0 + (row - 0.5) * std::cos(0.5 * u)) * std::sin(u),
                    (row - 0.5) * std::sin(0.5 * u)};
        case Shape::plane:
            break;
    }
    return {4.0 * column, 4.0 * row, radius};
}

GeneratedMesh grid_mesh(FuzzedDataProvider& data) {
    const auto shape = data.ConsumeEnum<Shape>();
    const bool wrap_columns = shape != Shape::plane, wrap_rows = shape == Shape::torus;
    const int quads = data.PickValueInArray({24, 24, 48, 48, 96, 180});  // small meshes fail just as well, and faster
    const int columns = data.ConsumeIntegralInRange(3, std::min(16, quads / 4));
    const int rows = data.ConsumeIntegralInRange(2, quads / columns);
    const Grid grid{rows, columns, wrap_rows, wrap_columns, shape == Shape::twisted};
    GeneratedMesh mesh;
    std::mt19937 random(data.ConsumeIntegral<uint16_t>());
    const double noise = data.ConsumeIntegralInRange(0, 40) * 0.01;
    const double size = std::pow(10.0, data.ConsumeIntegralInRange(-49, 49));
    std::uniform_real_distribution<double> jitter(-noise, noise);
    for (int i = 0; i < rows; ++i) {
        const double radius = 0.25 * data.ConsumeIntegralInRange(1, 8);
        for (int j = 0; j < columns; ++j) {
            const Vec3 p = place(shape, static_cast<double>(i) / rows, static_cast<double>(j) / columns, radius);
            mesh.positions.push_back(size * (p + Vec3(jitter(random), jitter(random), jitter(random))));
        }
    }
    for (int i = 0; i + (wrap_rows ? 0 : 1) < rows; ++i) {
        for (int j = 0; j + (wrap_columns ? 0 : 1) < columns; ++j) {
            mesh.faces.push_back({grid.vertex(i, j), grid.vertex(i, j + 1), grid.vertex(i + 1, j + 1), grid.vertex(i + 1, j)});
        }
    }
    if (shape == Shape::ball) {  // the poles are polygons
        for (const int row : {0, rows - 1}) {
            std::vector<int>& pole = mesh.faces.emplace_back();
            for (int j = 0; j < columns; ++j) pole.push_back(grid.vertex(row, row == 0 ? columns - 1 - j : j));
        }
    }
    return mesh;
}

void triangulate(GeneratedMesh& mesh, int face) {
    const std::vector<int> polygon = mesh.faces[face];
    if (polygon.size() < 4) return;
    mesh.faces[face] = {polygon[0], polygon[1], polygon[2]};
    for (std::size_t i = 3; i < polygon.size(); ++i) mesh.faces.push_back({polygon[0], polygon[i - 1], polygon[i]});
}

/// Damages a mesh in one of the ways that modeling programs, exporters and scanners do.
void damage(GeneratedMesh& mesh, FuzzedDataProvider& data) {
    enum class Change { triangulate, triangulate_all, remove, flip, duplicate, hide, move_onto, lift, kMaxValue = lift };
    const int face = data.ConsumeIntegralInRange(0, static_cast<int>(mesh.faces.size()) - 1);
    const int vertex = data.ConsumeIntegralInRange(0, static_cast<int>(mesh.positions.size()) - 1);
    switch (data.ConsumeEnum<Change>()) {
        case Change::triangulate:
            return triangulate(mesh, face);
        case Change::triangulate_all:
            for (int f = 0, count = static_cast<int>(mesh.faces.size()); f < count; ++f) triangulate(mesh, f);
            return;
        case Change::remove:
            if (mesh.faces.size() > 1) mesh.faces.erase(mesh.faces.begin() + face);
            return;
        case Change::flip:
            std::ranges::reverse(mesh.faces[face]);
            return;
        case Change::duplicate: {
            const std::vector<int> copy = mesh.faces[face];
            mesh.faces.push_back(copy);
            return;
        }
        case Change::hide:
            mesh.hidden.push_back(face);
            return;
        case Change::move_onto:
            mesh.positions[vertex] = mesh.positions[mesh.faces[face][0]];
            return;
        case Change::lift:
            mesh.positions[vertex] *= data.ConsumeFloatingPointInRange(0.0, 2.0);
    }
}

/// Puts every corner that is this vertex in the faces from `first` on at another.
void reconnect(GeneratedMesh& mesh, int vertex, int other, std::size_t first = 0) {
    for (std::size_t f = first; f < mesh.faces.size(); ++f) std::ranges::replace(mesh.faces[f], vertex, other);
}

int copied(GeneratedMesh& mesh, int vertex) {
    mesh.positions.push_back(Vec3(mesh.positions[vertex]));
    return static_cast<int>(mesh.positions.size()) - 1;
}

/// What people's files have besides: long triangles, needles, faces that are not joined, doubled or inside, and vertices in which
/// parts of the surface meet.
void damage_as_in_files(GeneratedMesh& mesh, FuzzedDataProvider& data) {
    enum class Change { stretch, needle, soup, split, doubled, wall, pinch, kMaxValue = pinch };
    const int face = data.ConsumeIntegralInRange(0, static_cast<int>(mesh.faces.size()) - 1);
    const auto any = [&] { return data.ConsumeIntegralInRange(0, static_cast<int>(mesh.positions.size()) - 1); };
    switch (data.ConsumeEnum<Change>()) {
        case Change::stretch: {
            const Vec3 from = mesh.positions[any()];
            const double by = std::pow(10.0, data.ConsumeIntegralInRange(-3, 3));
            const int axis = data.ConsumeIntegralInRange(0, 2);
            for (Vec3& p : mesh.positions) {
                if (p[axis] > from[axis]) p[axis] = from[axis] + by * (p[axis] - from[axis]);
            }
            return;
        }
        case Change::needle: {
            const std::vector<int>& corners = mesh.faces[face];
            const Vec3 a = mesh.positions[corners[0]], b = mesh.positions[corners[1]];
            mesh.positions[corners[1]] = a + 1e-9 * (b - a);
            return;
        }
        case Change::soup:
            for (std::vector<int>& polygon : mesh.faces) {
                for (int& corner : polygon) corner = copied(mesh, corner);
            }
            return;
        case Change::split: {
            const std::vector<int> corners = mesh.faces[face];
            for (const int corner : corners) reconnect(mesh, corner, copied(mesh, corner), static_cast<std::size_t>(face));
            return;
        }
        case Change::doubled: {
            std::vector<int> copy = mesh.faces[face];
            std::ranges::reverse(copy);
            mesh.faces.push_back(copy);
            return;
        }
        case Change::wall: {
            const int a = any(), b = any(), c = any();
            mesh.faces.push_back({a, b, c});
            return;
        }
        case Change::pinch: {
            const int vertex = any();
            return reconnect(mesh, vertex, any());
        }
    }
}

using Step = std::pair<int, int>;

std::set<Step> steps_of(const std::vector<int>& polygon) {
    std::set<Step> steps;
    for (std::size_t i = 0; i < polygon.size(); ++i) steps.emplace(polygon[i], polygon[(i + 1) % polygon.size()]);
    return steps;
}

/// The first few faces in the order of their numbers, or of their distance from a random face.
std::vector<int> some_faces(const GeneratedMesh& mesh, FuzzedDataProvider& data) {
    const int total = static_cast<int>(mesh.faces.size());
    const int count = data.ConsumeIntegralInRange(1, total);
    std::vector<int> order;
    if (data.ConsumeBool()) {
        for (int f = 0; f < count; ++f) order.push_back(f);
        return order;
    }
    std::set<int> seen{data.ConsumeIntegralInRange(0, total - 1)};
    order.assign(seen.begin(), seen.end());
    for (std::size_t i = 0; i < order.size() && static_cast<int>(order.size()) < count; ++i) {
        const std::set<Step> here = steps_of(mesh.faces[order[i]]);
        for (int f = 0; f < total && static_cast<int>(order.size()) < count; ++f) {
            const auto adjacent = [&](const Step& step) { return here.contains({step.second, step.first}); };
            if (!seen.contains(f) && std::ranges::any_of(steps_of(mesh.faces[f]), adjacent)) {
                seen.insert(f);
                order.push_back(f);
            }
        }
    }
    return order;
}

}  // namespace

Surface GeneratedMesh::surface() const {
    std::vector<double> points;
    for (const Vec3& p : positions) points.insert(points.end(), p.begin(), p.end());
    std::vector<int32_t> offsets{0}, vertices;
    for (const std::vector<int>& face : faces) {
        vertices.insert(vertices.end(), face.begin(), face.end());
        offsets.push_back(static_cast<int32_t>(vertices.size()));
    }
    std::vector<int32_t> unseen;
    for (const int face : hidden) {
        if (face < static_cast<int>(faces.size())) unseen.push_back(face);
    }
    return Surface({points, offsets, vertices, {}, unseen});
}

GeneratedMesh generate_mesh(FuzzedDataProvider& data, bool as_in_files) {
    GeneratedMesh mesh = grid_mesh(data);
    for (int i = as_in_files ? data.ConsumeIntegralInRange(1, 4) : 0; i > 0; --i) damage_as_in_files(mesh, data);
    for (int i = data.ConsumeIntegralInRange(0, 12); i > 0; --i) damage(mesh, data);
    if (static_cast<int>(mesh.faces.size()) > most_faces) mesh.faces.resize(most_faces);
    return mesh;
}

std::vector<std::vector<int>> generate_loops(const GeneratedMesh& mesh, FuzzedDataProvider& data) {
    std::set<Step> all;
    for (const int face : some_faces(mesh, data)) {
        const std::set<Step> steps = steps_of(mesh.faces[face]);
        all.insert(steps.begin(), steps.end());
    }
    std::multimap<int, int> onward;
    for (const auto& [from, to] : all) {
        if (!all.contains({to, from})) onward.emplace(from, to);
    }
    std::vector<std::vector<int>> loops;
    while (!onward.empty()) {
        const int start = onward.begin()->first;
        std::vector<int> loop;
        for (auto step = onward.begin(); step != onward.end(); step = onward.find(loop.back() == start ? -1 : loop.back())) {
            loop.push_back(step->second);
            onward.erase(step);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

}  // namespace mrc
