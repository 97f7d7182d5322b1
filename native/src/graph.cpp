// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph.h"

#include "ambient_graph.h"
#include "directed_segments.h"
#include "exclude_segments.h"
#include "graph_input.h"
#include "graph_size_limit.h"
#include "line_graph.h"
#include "open_ends.h"
#include "required_chords.h"
#include "topological_order.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace mrc {
namespace {

/// Chooses the level of the cut for a closed contour, and measures the points' levels from there.
void choose_level(const AmbientGraph& ambient, bool closed, ContourGraph& graph) {
    if (closed) graph.level = cheapest_level(ambient.values, ambient.segments);
    for (std::size_t p = 0; p < ambient.places.size(); ++p) {
        const double level = closed ? above(ambient.values[p], graph.level) : ambient.values[p];
        graph.points.push_back({ambient.places[p], level, ambient.ranks[p]});
    }
}

/// Makes the graph's chords, in topological order; gives their sites.
std::vector<ChordSite> sort_chords(const std::vector<Segment>& segments, const std::vector<DirectedSegment>& directed,
                                   const Beat& beat, ContourGraph& graph) {
    const std::vector<int> order = topological_order(graph.points, directed, beat);
    std::vector<ChordSite> sites;
    graph.chords.reserve(order.size());
    sites.reserve(order.size());
    for (const int chord : order) {
        const DirectedSegment& d = directed[chord];
        const Segment& s = segments[d.segment];
        graph.chords.push_back({d.tail, d.head, d.increment});
        sites.push_back({s.halfedge, s.triangle, -1, d.climb});
        graph.crossing += d.crosses;
    }
    return sites;
}

/// Marks the chords that the given contour runs along.
void mark_given(const GraphInput& input, const std::vector<Chord>& chords, std::vector<ChordSite>& sites) {
    const int count = static_cast<int>(input.given.size());
    std::vector<int> place(input.ambient.point_count(), -1);
    for (int i = 0; i < count; ++i) {
        const int p = input.ambient.point_at(input.patch, input.given[i]);
        if (p >= 0) place[p] = i;
    }
    for (std::size_t c = 0; c < chords.size(); ++c) {
        const int tail = place[chords[c].tail], head = place[chords[c].head];
        const bool follows = head == tail + 1 || (input.patch.closed && head == 0 && tail + 1 == count);
        if (tail >= 0 && head >= 0 && follows) sites[c].given = tail;
    }
}

/// In a closed band a chord that crosses the level is the source of a path and, one period later, its destination.
void add_cut(ContourGraph& graph) {
    for (int i = 0; i < graph.crossing; ++i) {
        graph.search.sources.push_back({i, 0.0, 0.0});
        graph.search.destinations.push_back({static_cast<int>(graph.chords.size()) + i, 0.0, 0.0});
    }
}

}  // namespace

ContourGraph make_graph(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow, const Energy& energy,
                        const Options& options, const Constraints& constraints, int steiner, const EdgeForm* region,
                        const Exclusion& exclusion, const Beat& beat) {
    check_graph_size(static_cast<double>(std::ranges::count(band.face, 1)), steiner);
    const auto pause = [&] {
        if (beat) beat();
    };
    const std::vector<SurfacePoint> given = expressed(patch.given, steiner).points;
    AmbientGraph ambient = make_ambient_graph(patch, band, flow, steiner);
    const GraphInput input{surface, patch, band, energy, options, constraints, exclusion, ambient, given};
    ContourGraph graph;
    pause();
    choose_level(ambient, patch.closed, graph);
    exclude_segments(surface, patch, exclusion, ambient);
    pause();
    std::vector<DirectedSegment> directed = direct_segments(surface, ambient, graph.points, patch.closed, graph.level);
    pause();
    const RequiredElements required = keep_required_chords(input, graph.points, directed);
    pause();
    std::vector<ChordSite> sites = sort_chords(ambient.segments, directed, beat, graph);
    directed = std::vector<DirectedSegment>();  // the arcs are to come, which need the room
    ambient.segments = std::vector<Segment>();
    pause();
    mark_given(input, graph.chords, sites);
    const Chords chords{graph.points, graph.chords, sites, graph.crossing, static_cast<int>(given.size()), required};
    graph.search = make_line_graph(surface, chords, energy, region, beat);
    graph.search.matched = patch.closed;
    patch.closed ? add_cut(graph) : add_open_ends(input, chords, graph.search);
    return graph;
}

}  // namespace mrc
