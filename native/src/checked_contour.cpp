// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_obstacles.h"
#include "element_names.h"
#include "number_text.h"
#include "patch.h"
#include "segments.h"
#include "surface_point.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace mrc {
namespace {

std::string point_name(const SurfacePoint& p) {
    return p.is_vertex() ? "vertex " + std::to_string(p.a) : "the point at " + number_text(p.t) + " of edge " + edge_name(p.a, p.b);
}

InvalidInput no_edge(int a, int b) {
    return {ErrorCode::no_edge,
            "the contour's vertices " + std::to_string(a) + " and " + std::to_string(b) + " are not joined by an edge",
            {Element::edge(a, b), Element::vertex(a), Element::vertex(b)}};
}

void check_point(const Surface& surface, const SurfacePoint& p) {
    for (const int v : {p.a, p.b}) {
        if (v < 0 || v >= surface.vertex_count()) {
            throw InvalidInput(ErrorCode::out_of_range,
                               "contour vertex " + std::to_string(v) + " is out of range: the surface has " +
                                   std::to_string(surface.vertex_count()) + " vertices",
                               {Element::vertex(v)});
        }
    }
    if (!(p.t >= 0.0 && p.t <= 1.0)) {
        throw InvalidInput(ErrorCode::invalid_parameter,
                           "the contour's point on edge " + edge_name(p.a, p.b) + " has parameter " + number_text(p.t) +
                               ": it must be from 0 to 1",
                           {Element::edge(p.a, p.b)});
    }
    if (!p.is_vertex() && surface.find_edge(p.a, p.b, EdgeKind::any) < 0) throw no_edge(p.a, p.b);
}

/// Equal for equal points, in whichever direction their edges are written.
std::tuple<int, int, long long> place_key(const SurfacePoint& p) {
    return p.a <= p.b ? std::tuple(p.a, p.b, std::llround(p.t * 1e12)) : std::tuple(p.b, p.a, std::llround((1.0 - p.t) * 1e12));
}

void check_distinct(const Contour& contour) {
    const std::size_t least = contour.closed ? 3 : 2;
    if (contour.points.size() < least) {
        std::vector<Element> elements;
        std::ranges::transform(contour.points, std::back_inserter(elements), element_of);
        throw InvalidInput(ErrorCode::too_short,
                           "the contour has " + std::to_string(contour.points.size()) + " vertices: " +
                               (contour.closed ? "a closed" : "an open") + " contour needs at least " + std::to_string(least),
                           elements);
    }
    std::set<std::tuple<int, int, long long>> seen;
    for (const SurfacePoint& p : contour.points) {
        if (!seen.insert(place_key(p)).second) {
            throw InvalidInput(
                ErrorCode::not_simple,
                "the contour passes " + point_name(p) +
                    " twice: give a contour that does not touch itself (a closed one does not repeat its first vertex)",
                {element_of(p)});
        }
    }
}

/// Where on a triangle's boundary a point lies, from 0 to 3: the number of the side, plus how far along it.
double border_place(const Surface& surface, int triangle, const SurfacePoint& p) {
    for (int corner = 0; corner < 3; ++corner) {
        const DirectedEdge side = directed_edge(surface, 3 * triangle + corner);
        if (side.holds(p)) return corner + side.parameter(p);
    }
    return -1.0;
}

struct Crossing {
    int triangle;
    double low, high;           // places on the triangle's boundary
    const SurfacePoint* start;  // of the segment
};

/// Segments inside one triangle cross where their ends alternate on its boundary.
void check_crossings(std::vector<Crossing>& crossings) {
    std::ranges::stable_sort(crossings, {}, &Crossing::triangle);  // which of several is named must not vary
    for (auto first = crossings.begin(); first != crossings.end();) {
        const auto end = std::find_if(first, crossings.end(), [&](const Crossing& c) { return c.triangle != first->triangle; });
        for (auto i = first; i != end; ++i) {
            for (auto j = first; j != end; ++j) {
                if (i->low < j->low && j->low < i->high && i->high < j->high) {
                    const SurfacePoint &p = *i->start, &q = *j->start;
                    throw InvalidInput(ErrorCode::not_simple,
                                       "the contour crosses itself: its segments after " + point_name(p) + " and after " +
                                           point_name(q) + " meet; give a contour that does not touch itself",
                                       {element_of(p), element_of(q)});
                }
            }
        }
        first = end;
    }
}

void add_crossing(const Surface& surface, int triangle, const SurfacePoint& p, const SurfacePoint& q,
                  std::vector<Crossing>& crossings) {
    const double from = border_place(surface, triangle, p), to = border_place(surface, triangle, q);
    crossings.push_back({triangle, std::min(from, to), std::max(from, to), &p});
}

InvalidInput obstructed(const std::string& what, std::vector<Element> elements, const Obstacle& obstacle) {
    if (obstacle.element) elements.push_back(*obstacle.element);
    return {obstacle.code, what + " lies " + obstacle.words + ": move the contour off it", std::move(elements)};
}

void check_edge(const Surface& surface, int a, int b) {
    if (!surface.real_edge(a, b)) throw no_edge(a, b);
    if (const auto in_the_way = obstacle(surface, a, b))
        throw obstructed("the contour's edge " + edge_name(a, b), {Element::edge(a, b)}, *in_the_way);
}

void check_segment(const Surface& surface, const SurfacePoint& p, const SurfacePoint& q, std::vector<Crossing>& crossings) {
    if (p.is_vertex() && q.is_vertex()) check_edge(surface, p.a, q.a);
    const int triangle = triangle_of_segment(surface, p, q);
    if (triangle < 0) {
        throw InvalidInput(ErrorCode::off_surface,
                           "the contour leaves the surface between " + point_name(p) + " and " + point_name(q) +
                               ": consecutive points must lie on one triangle",
                           {element_of(p), element_of(q)});
    }
    const auto edge = shared_edge(p, q);
    const bool along = edge && surface.real_edge(edge->a, edge->b);
    if (const auto in_the_way = along ? obstacle(surface, edge->a, edge->b) : obstacle(surface, 3 * triangle)) {
        throw obstructed("the contour between " + point_name(p) + " and " + point_name(q), {element_of(p), element_of(q)},
                         *in_the_way);
    }
    // A segment along an edge lies on the boundary of both its triangles.
    add_crossing(surface, triangle, p, q, crossings);
    for (int h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        const DirectedEdge side = directed_edge(surface, h);
        const int twin = surface.twin(h);
        if (twin >= 0 && side.holds(p) && side.holds(q)) add_crossing(surface, twin / 3, p, q, crossings);
    }
}

}  // namespace

Contour checked_contour(const Surface& surface, const Contour& contour) {
    for (const SurfacePoint& p : contour.points) check_point(surface, p);
    Contour checked = normalized(contour);
    check_distinct(checked);
    std::vector<Crossing> crossings;
    for (const auto& [p, q] : segments(checked)) check_segment(surface, p, q, crossings);
    check_crossings(crossings);
    return checked;
}

}  // namespace mrc
