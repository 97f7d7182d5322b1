// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/constraints.h>

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

void Constraints::check(const Surface& surface) const {
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

}  // namespace mrc
