// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/wishes.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mrc {
namespace {

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

/// The half-edges that leave a vertex, turning left; at a border from the border on.
std::vector<int> fan_of(const Surface& surface, int vertex) {
    const int first = surface.outgoing(vertex).front();
    int start = first;
    while (surface.twin(start) >= 0 && Surface::next(surface.twin(start)) != first) start = Surface::next(surface.twin(start));
    std::vector<int> fan{start};
    for (int h = surface.twin(Surface::previous(start)); h >= 0 && h != start; h = surface.twin(Surface::previous(h)))
        fan.push_back(h);
    return fan;
}

/// Where in a vertex's fan the way to the next point of a contour lies: half-edges by their place, triangles between them.
double place_in_fan(const Surface& surface, const std::vector<int>& fan, const SurfacePoint& next) {
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const int here = surface.from(fan[i]), there = surface.to(fan[i]);
        const auto on_edge = [&](int v) { return v == here || v == there; };
        if (on_edge(next.a) && on_edge(next.b)) return static_cast<double>(i);
    }
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const auto& corners = surface.triangle(fan[i] / 3);
        if (std::ranges::count(corners, next.a) + std::ranges::count(corners, next.b) == 2) return static_cast<double>(i) + 0.5;
    }
    return -1.0;
}

/// True where barriers leave a vertex of the contour on its left and on its right.
bool barrier_on_both_sides(const Surface& surface, const SurfacePoint& last, int here, const SurfacePoint& next,
                           const Wishes& wishes) {
    const std::vector<int> fan = fan_of(surface, here);
    const double from = place_in_fan(surface, fan, next), until = place_in_fan(surface, fan, last);
    if (from < 0.0 || until < 0.0) return false;
    const auto is_barrier = [&](int v) {
        return std::ranges::any_of(wishes.barriers,
                                   [&](const auto& e) { return (e[0] == here && e[1] == v) || (e[1] == here && e[0] == v); });
    };
    bool left = false, right = false;
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const auto place = static_cast<double>(i);
        if (surface.diagonal(fan[i]) || place == from || place == until || !is_barrier(surface.to(fan[i]))) continue;
        const bool between = from < until ? from < place && place < until : from < place || place < until;
        (between ? left : right) = true;
    }
    return left && right;
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
        if (!std::isfinite(region_density[f]))
            throw InvalidInput("the region density of face " + std::to_string(f) + " is not finite");
    }
    for (const Attractor& a : attractors) {
        check_vertex(surface, a.vertex, "attractor vertex");
        const std::string name = "the attractor at vertex " + std::to_string(a.vertex);
        if (!(std::isfinite(a.radius) && a.radius > 0.0))
            throw InvalidInput(name + " has radius " + std::to_string(a.radius) + ": it must be above 0");
        if (!std::isfinite(a.strength)) throw InvalidInput(name + " has a strength that is not finite");
        if (a.sigma && !(std::isfinite(*a.sigma) && *a.sigma > 0.0)) throw InvalidInput(name + " has a sigma that is not above 0");
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

void check_barriers(const Surface& surface, const Contour& contour, const Wishes& wishes) {
    if (wishes.barriers.empty()) return;
    const std::size_t count = contour.points.size();
    const auto point = [&](std::size_t i) { return contour.points[i % count]; };
    for (const auto& [a, b] : wishes.barriers) {
        const auto on_edge = [&](const SurfacePoint& p) { return (p.a == a || p.a == b) && (p.b == a || p.b == b); };
        for (std::size_t i = 0; i < count; ++i) {
            if (point(i).is_vertex() || !on_edge(point(i))) continue;
            const bool along = on_edge(point(i + count - 1)) && on_edge(point(i + 1));
            if (!along) {
                throw InvalidInput("the contour crosses the barrier (" + std::to_string(a) + ", " + std::to_string(b) + ")");
            }
        }
    }
    for (std::size_t i = contour.closed ? 0 : 1; i + (contour.closed ? 0 : 1) < count; ++i) {
        const SurfacePoint& here = contour.points[i];
        if (!here.is_vertex()) continue;
        const SurfacePoint last = point(i + count - 1), next = point(i + 1);
        if (barrier_on_both_sides(surface, last, here.a, next, wishes)) {
            throw InvalidInput("the contour crosses a barrier at vertex " + std::to_string(here.a));
        }
    }
}

}  // namespace mrc
