// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace made {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

}  // namespace

mrc::Surface Mesh::surface(const std::vector<int32_t>& hidden) const {
    std::vector<double> positions;
    std::vector<int32_t> offsets{0}, corners;
    for (const Vec3& p : points) positions.insert(positions.end(), p.begin(), p.end());
    for (const std::vector<int>& face : faces) {
        corners.insert(corners.end(), face.begin(), face.end());
        offsets.push_back(static_cast<int32_t>(corners.size()));
    }
    return mrc::Surface({positions, offsets, corners, {}, hidden});
}

Mesh Mesh::mapped(const std::function<Vec3(const Vec3&)>& map) const {
    Mesh mesh = *this;
    std::ranges::transform(points, mesh.points.begin(), map);
    return mesh;
}

Mesh Mesh::inside_out() const {
    Mesh mesh = *this;
    for (std::vector<int>& face : mesh.faces) std::ranges::reverse(face);
    return mesh;
}

Mesh Mesh::renumbered(std::span<const int> number) const {
    Mesh mesh = *this;
    for (std::size_t v = 0; v < points.size(); ++v) mesh.points[number[v]] = points[v];
    for (std::vector<int>& face : mesh.faces) {
        for (int& v : face) v = number[v];
    }
    return mesh;
}

Mesh Mesh::beside(const Mesh& other) const {
    Mesh mesh = *this;
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (std::vector<int> face : other.faces) {
        for (int& v : face) v += static_cast<int>(points.size());
        mesh.faces.push_back(std::move(face));
    }
    return mesh;
}

Mesh plate(int columns, int rows) {
    Mesh mesh;
    const int width = columns + 1;
    for (int v = 0; v < width * (rows + 1); ++v) mesh.points.emplace_back(v % width, v / width, 0.0);
    for (int j = 0; j < rows; ++j) {
        for (int v = j * width; v < j * width + columns; ++v) mesh.faces.push_back({v, v + 1, v + 1 + width, v + width});
    }
    return mesh;
}

Mesh turned(std::span<const std::pair<double, double>> profile, int around) {
    Mesh mesh;
    for (const auto& [radius, height] : profile) {
        for (int i = 0; i < around; ++i) {
            const double angle = turn * i / around;
            mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
        }
    }
    for (int v = 0; v < around * (static_cast<int>(profile.size()) - 1); ++v) {
        const int next = v / around * around + (v + 1) % around;
        mesh.faces.push_back({v, next, next + around, v + around});
    }
    return mesh;
}

Mesh tube(int around, int rows, double radius, double step) {
    std::vector<std::pair<double, double>> profile;
    for (int row = 0; row <= rows; ++row) profile.emplace_back(radius, step * row);
    return turned(profile, around);
}

Mesh torus(int around, int across, double ring, double tube) {
    Mesh mesh;
    const auto at = [&](int i, int j) { return i % around * across + j % across; };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = turn * i / around, v = turn * j / across, reach = ring + tube * std::cos(v);
            mesh.points.emplace_back(reach * std::cos(u), reach * std::sin(u), tube * std::sin(v));
            mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

Mesh ball(int around, int rings, double radius) {
    Mesh mesh;
    mesh.points.emplace_back(0.0, 0.0, -radius);
    for (int v = 0; v < around * rings; ++v) {
        const int ring = v / around + 1;
        const double u = turn * (v % around) / around, height = std::numbers::pi * ring / (rings + 1);
        mesh.points.push_back(radius * Vec3(std::sin(height) * std::cos(u), std::sin(height) * std::sin(u), -std::cos(height)));
    }
    mesh.points.emplace_back(0.0, 0.0, radius);
    const int last = static_cast<int>(mesh.points.size()) - 1;
    for (int i = 0; i < around; ++i) {
        const int next = (i + 1) % around, top = 1 + around * (rings - 1);
        mesh.faces.push_back({0, 1 + next, 1 + i});
        mesh.faces.push_back({last, top + i, top + next});
        for (int v = 1; v < top; v += around) mesh.faces.push_back({v + i, v + next, v + next + around, v + i + around});
    }
    return mesh;
}

std::vector<int> shuffled(int count, unsigned seed) {
    std::vector<int> number(count);
    std::iota(number.begin(), number.end(), 0);
    std::mt19937 random(seed);
    std::ranges::shuffle(number, random);
    return number;
}

mrc::Contour ring(int around, int row) {
    std::vector<int> vertices(around);
    std::iota(vertices.begin(), vertices.end(), row * around);
    return mrc::vertex_contour(vertices);
}

mrc::Contour reversed(mrc::Contour contour) {
    std::ranges::reverse(contour.points);
    return contour;
}

mrc::Contour renumbered(mrc::Contour contour, std::span<const int> number) {
    for (mrc::SurfacePoint& p : contour.points) p = {number[p.a], number[p.b], p.t};
    return contour;
}

}  // namespace made
