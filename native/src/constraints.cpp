// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/constraints.h>

#include "element_names.h"
#include "input_range.h"
#include "number_text.h"

#include <algorithm>
#include <span>
#include <string>

namespace mrc {
namespace {

void check_vertex(const Surface& surface, int vertex, const char* what) {
    if (vertex >= 0 && vertex < surface.vertex_count()) return;
    throw InvalidInput(ErrorCode::out_of_range,
                       std::string(what) + " " + std::to_string(vertex) + " is out of range: the surface has " +
                           std::to_string(surface.vertex_count()) + " vertices",
                       {Element::vertex(vertex)});
}

void check_edges(const Surface& surface, const std::vector<std::array<int, 2>>& edges, const char* what) {
    for (const auto& [a, b] : edges) {
        check_vertex(surface, a, what);
        check_vertex(surface, b, what);
        if (!surface.real_edge(a, b)) {
            throw InvalidInput(ErrorCode::no_edge, std::string(what) + " " + edge_name(a, b) + " is not an edge of the mesh",
                               {Element::edge(a, b)});
        }
    }
}

}  // namespace

void Constraints::check(const Surface& surface) const {
    for (const int v : required_vertices) check_vertex(surface, v, "required vertex");
    check_edges(surface, required_edges, "required edge");
    check_edges(surface, barriers, "barrier");
    const std::span<const double> densities = has_region() ? std::span(*region_density) : std::span<const double>();
    if (has_region() && densities.size() != static_cast<std::size_t>(surface.face_count())) {
        throw InvalidInput(ErrorCode::wrong_size, "the region density has " + std::to_string(densities.size()) + " entries for " +
                                                      std::to_string(surface.face_count()) + " faces");
    }
    for (std::size_t f = 0; f < densities.size(); ++f) {
        if (!in_input_range(densities[f]))
            throw InvalidInput(ErrorCode::not_finite,
                               "the region density of face " + std::to_string(f) + " is not finite, or beyond 1e50",
                               {Element::face(static_cast<int>(f))});
    }
    for (const Attractor& a : attractors) {
        check_vertex(surface, a.vertex, "attractor vertex");
        const std::string begin = "the attractor at vertex " + std::to_string(a.vertex) + " has ";
        const auto require = [&](bool valid, const std::string& fault) {
            if (!valid) throw InvalidInput(ErrorCode::invalid_attractor, begin + fault, {Element::vertex(a.vertex)});
        };
        require(in_input_range(a.radius) && a.radius > 0.0,
                "radius " + number_text(a.radius) + ": it must be above 0, and no larger than 1e50");
        require(in_input_range(a.strength), "a strength that is not finite, or beyond 1e50");
        require(!a.sigma || (in_input_range(*a.sigma) && *a.sigma > 0.0), "a sigma that is not above 0, or beyond 1e50");
    }
}

}  // namespace mrc
