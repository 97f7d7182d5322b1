// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/wishes.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mrc {
namespace {

bool usable(double value) { return std::abs(value) <= 1e50; }  // as positions

void check_vertex(const Surface& surface, int vertex, const char* what) {
    if (vertex >= 0 && vertex < surface.vertex_count()) return;
    throw InvalidInput(std::string(what) + " " + std::to_string(vertex) + " is out of range: the surface has " +
                       std::to_string(surface.vertex_count()) + " vertices");
}

void check_edges(const Surface& surface, const std::vector<std::array<int, 2>>& edges, const char* what) {
    for (const auto& [a, b] : edges) {
        check_vertex(surface, a, what);
        check_vertex(surface, b, what);
        if (!surface.real_edge(a, b)) {
            throw InvalidInput(std::string(what) + " (" + std::to_string(a) + ", " + std::to_string(b) +
                               ") is no edge of the mesh");
        }
    }
}

}  // namespace

void Wishes::check(const Surface& surface) const {
    for (const int v : required_vertices) check_vertex(surface, v, "required vertex");
    check_edges(surface, required_edges, "required edge");
    check_edges(surface, barriers, "barrier");
    if (!region_density.empty() && region_density.size() != static_cast<std::size_t>(surface.face_count())) {
        throw InvalidInput("the region density has " + std::to_string(region_density.size()) + " entries for " +
                           std::to_string(surface.face_count()) + " faces");
    }
    for (std::size_t f = 0; f < region_density.size(); ++f) {
        if (!usable(region_density[f]))
            throw InvalidInput("the region density of face " + std::to_string(f) + " is not finite, or beyond 1e50");
    }
    for (const Attractor& a : attractors) {
        check_vertex(surface, a.vertex, "attractor vertex");
        const std::string name = "the attractor at vertex " + std::to_string(a.vertex);
        if (!(usable(a.radius) && a.radius > 0.0))
            throw InvalidInput(name + " has radius " + std::to_string(a.radius) + ": it must be above 0, and no larger than 1e50");
        if (!usable(a.strength)) throw InvalidInput(name + " has a strength that is not finite, or beyond 1e50");
        if (a.sigma && !(usable(*a.sigma) && *a.sigma > 0.0))
            throw InvalidInput(name + " has a sigma that is not above 0, or beyond 1e50");
    }
}

bool meets(const Contour& contour, const Wishes& wishes) {
    const std::size_t count = contour.points.size();
    const auto passes = [&](int v) { return std::ranges::find(contour.points, vertex_point(v)) != contour.points.end(); };
    const auto runs_along = [&](const std::array<int, 2>& edge) {
        const auto on_edge = [&](const SurfacePoint& p) {
            return (p.a == edge[0] || p.a == edge[1]) && (p.b == edge[0] || p.b == edge[1]);
        };
        // All the way from one end to the other without leaving the edge.
        for (std::size_t i = 0; i < count; ++i) {
            if (!contour.points[i].is_vertex() || !on_edge(contour.points[i])) continue;
            for (std::size_t j = i + 1; j < i + count && (contour.closed || j < count); ++j) {
                const SurfacePoint& p = contour.points[j % count];
                if (!on_edge(p)) break;
                if (p.is_vertex()) return true;
            }
        }
        return false;
    };
    return std::ranges::all_of(wishes.required_vertices, passes) && std::ranges::all_of(wishes.required_edges, runs_along);
}

}  // namespace mrc
