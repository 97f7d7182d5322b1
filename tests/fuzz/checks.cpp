// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.h"

#include "required_elements.h"

#include <mrc/measure.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <utility>

namespace mrc {
namespace {

using Pair = std::pair<int, int>;

Pair ends(const SurfacePoint& p) { return std::minmax(p.a, p.b); }

/// One name for a point, from whichever end of its edge it was measured.
std::pair<Pair, double> name(const SurfacePoint& p) { return {ends(p), p.a <= p.b ? p.t : 1.0 - p.t}; }

bool within(const SurfacePoint& p, const std::array<int, 3>& triangle) {
    const auto corner = [&](int v) { return std::ranges::find(triangle, v) != triangle.end(); };
    return corner(p.a) && corner(p.b);
}

/// Where along a triangle's border a point of it lies, from 0 to 3.
double along_border(const SurfacePoint& p, const std::array<int, 3>& triangle) {
    for (int side = 0; side < 3; ++side) {
        const int from = triangle[side], to = triangle[(side + 1) % 3];
        if (p.is_vertex() && p.a == from) return side;
        if (p.a == from && p.b == to) return side + p.t;
        if (p.b == from && p.a == to) return side + (1.0 - p.t);
    }
    return -1.0;
}

/// Two chords of a triangle cross where their ends alternate along its border.
bool alternate(double a, double b, double c, double d) {
    if (a > b) std::swap(a, b);
    const auto between = [&](double x) { return a < x && x < b; };
    const auto outside = [&](double x) { return x < a || b < x; };
    return (between(c) && outside(d)) || (between(d) && outside(c));
}

struct Segment {
    SurfacePoint from, to;
};

std::vector<Segment> segments_of(const Contour& contour) {
    std::vector<Segment> segments;
    const std::size_t count = contour.points.size();
    for (std::size_t i = 0; i + (contour.closed ? 0 : 1) < count; ++i)
        segments.push_back({contour.points[i], contour.points[(i + 1) % count]});
    return segments;
}

bool near(double a, double b, double unit) { return std::abs(a - b) <= 1e-6 * std::max({std::abs(a), std::abs(b), unit}); }

void check_numbers(const Result& result) {
    for (const double value : {result.ratio, result.initial_ratio, result.objective, result.initial_objective, result.salience,
                               result.lower_bound, result.gap, result.scales.h, result.scales.K, result.scales.L0})
        require(std::isfinite(value), "every number of a result is finite");
    for (const double value : result.history) require(std::isfinite(value), "the history is finite");
    require(result.gap >= 0.0, "the gap is not negative");
    require(result.statistics.arcs >= 0 && result.statistics.nodes >= 0, "counts are not negative");
}

}  // namespace

void require(bool holds, const char* law) {
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n", law);
    std::abort();
}

void check_surface(const Surface& surface) {
    for (int h = 0; h < surface.halfedge_count(); ++h) {
        const int twin = surface.twin(h);
        if (twin >= 0) {
            require(surface.twin(twin) == h, "a twin's twin is the half-edge");
            require(surface.from(twin) == surface.to(h) && surface.to(twin) == surface.from(h), "twins run against each other");
            require(surface.edge(twin) == surface.edge(h), "twins have one edge");
        }
        require(0 <= surface.edge(h) && surface.edge(h) < surface.edge_count(), "edges are numbered");
        if (!surface.diagonal(h)) require(surface.find_halfedge(surface.from(h), surface.to(h)) >= 0, "real half-edges are found");
    }
    for (int v = 0; v < surface.vertex_count(); ++v) {
        for (const int h : surface.outgoing(v)) require(surface.from(h) == v, "outgoing half-edges start at their vertex");
    }
}

void check_simple(const Surface& surface, const Contour& contour) {
    std::set<std::pair<Pair, double>> seen;
    for (const SurfacePoint& p : contour.points) {
        require(0 <= p.a && p.a < surface.vertex_count() && 0 <= p.b && p.b < surface.vertex_count(), "vertices exist");
        require(p.is_vertex() ? p.t == 0.0 : 0.0 < p.t && p.t < 1.0, "points lie inside their edges, or are vertices");
        require(seen.insert(name(p)).second, "no point comes twice");
    }
    const std::vector<Segment> segments = segments_of(contour);
    require(segments.size() >= (contour.closed ? 3u : 1u), "a contour is no edge there and back");
    for (const Segment& s : segments) require(!(s.from == s.to), "no segment is empty");
    std::vector<bool> held(segments.size(), false);
    for (int t = 0; t < surface.triangle_count(); ++t) {
        const auto& triangle = surface.triangle(t);
        std::vector<std::pair<double, double>> chords;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            if (!within(segments[i].from, triangle) || !within(segments[i].to, triangle)) continue;
            held[i] = true;
            chords.emplace_back(along_border(segments[i].from, triangle), along_border(segments[i].to, triangle));
        }
        for (std::size_t i = 0; i < chords.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j)
                require(!alternate(chords[i].first, chords[i].second, chords[j].first, chords[j].second), "no chords cross");
        }
    }
    require(std::ranges::all_of(held, [](bool h) { return h; }), "every segment lies in a triangle");
}

bool apart(const Contour& one, const Contour& two) {
    std::set<std::pair<Pair, double>> points;
    for (const SurfacePoint& p : one.points) points.insert(name(p));
    return std::ranges::none_of(two.points, [&](const SurfacePoint& p) { return points.contains(name(p)); });
}

void check_result(const Surface& surface, const Contour& given, const Options& options, const Constraints& constraints,
                  const Result& result) {
    check_numbers(result);
    check_simple(surface, result.contour);
    require(result.contour.closed == given.closed, "closed stays closed");
    if (result.status == Status::unchanged || result.status == Status::cancelled)
        require(result.contour == given, "unchanged is the given contour");
    if (result.status == Status::cancelled) return;
    require(!result.reason.empty() || result.status != Status::unchanged || options.iterations + options.regular_iterations == 0,
            "what is unchanged has a reason");
    if (result.status == Status::improved) require(result.objective < result.initial_objective, "improved is better than given");
    require(result.lower_bound <= result.objective, "the bound is a bound");
    require(has_required_elements(result.contour, constraints), "required elements are passed");
    if (constraints.has_region()) return;  // what is enclosed counts from the contour as given
    const Measure measured = measure(surface, result.contour, options, constraints, result.scales);
    require(near(measured.ratio, result.ratio, result.scales.K), "measuring the result gives its ratio");
}

}  // namespace mrc
