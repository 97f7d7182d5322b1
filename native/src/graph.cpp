// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/graph.h>

#include "levels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mrc {
namespace {

using Halfedge = PatchMesh::HalfedgeHandle;

enum class Climb : std::uint8_t { rising, falling, along };  // level chords by rank, and those that the flow runs along

struct DirectedSegment {
    int tail, head, face, crossings;
    double increment;
    Climb climb;
};

class GraphBuilder {
  public:
    GraphBuilder(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow, const Energy& energy)
        : surface_(surface), patch_(patch), band_(band), flow_(flow), energy_(energy) {}

    ContourGraph build() {
        add_points();
        add_segments();
        merge_levels(values_, segments_);
        choose_level();
        orient();
        sort_chords();
        find_given();
        join();
        return std::move(graph_);
    }

  private:
    const Surface& surface_;
    const Patch& patch_;
    const Band& band_;
    const Flow& flow_;
    const Energy& energy_;
    ContourGraph graph_;
    std::vector<int> point_of_vertex_;
    std::vector<double> values_;
    std::vector<Segment> segments_;
    std::vector<DirectedSegment> directed_;
    std::vector<int> given_place_;  // of each chord: its place in the given contour, or -1

    void add_points() {
        point_of_vertex_.assign(patch_.vertex.size(), -1);
        for (std::size_t v = 0; v < patch_.vertex.size(); ++v) {
            if (band_.side[v] == Side::outside) continue;
            point_of_vertex_[v] = static_cast<int>(graph_.points.size());
            const double rank = static_cast<double>(band_.side[v]) * patch_.distance[v];
            graph_.points.push_back({vertex_point(patch_.vertex[v]), 0.0, rank});
            values_.push_back(flow_.value[v]);
        }
    }

    /// The regular graph's segments are the real edges of the band.
    void add_segments() {
        for (int e = 0; e < static_cast<int>(patch_.mesh.n_edges()); ++e) {
            if (!band_.edge[e] || patch_.diagonal[e]) continue;
            const Halfedge h(2 * e);
            const int halfedge = patch_.halfedge[2 * e] >= 0 ? patch_.halfedge[2 * e] : patch_.halfedge[2 * e + 1];
            segments_.push_back({point_of_vertex_[patch_.mesh.from_vertex_handle(h).idx()],
                                 point_of_vertex_[patch_.mesh.to_vertex_handle(h).idx()], flow_.jump[2 * e],
                                 surface_.halfedge_face(halfedge)});
        }
    }

    void choose_level() {
        graph_.level = cheapest_level(values_, segments_);
        for (std::size_t p = 0; p < values_.size(); ++p) graph_.points[p].level = above(values_[p], graph_.level);
    }

    /// Each segment becomes the chord that the flow runs along; a level one becomes two, by rank; of equal rank, none.
    void orient() {
        for (const Segment& s : segments_) {
            const double a = graph_.points[s.a].level, b = graph_.points[s.b].level;
            const int crossings = s.jump + whole(values_[s.b], graph_.level) - whole(values_[s.a], graph_.level);
            const double increment = b - a + crossings;
            if (increment == 0.0) {
                orient_level(s);
            } else if (std::abs(increment) < 1.0) {  // no closed contour holds a chord that goes all the way round
                const bool forward = increment > 0.0;
                directed_.push_back({forward ? s.a : s.b, forward ? s.b : s.a, s.face, std::abs(crossings), std::abs(increment), Climb::along});
            }
        }
    }

    void orient_level(const Segment& s) {
        const double difference = graph_.points[s.b].rank - graph_.points[s.a].rank;
        const double length = (position(s.b) - position(s.a)).norm();
        if (std::abs(difference) <= 1e-9 * length) return;
        const int low = difference > 0.0 ? s.a : s.b, high = difference > 0.0 ? s.b : s.a;
        directed_.push_back({low, high, s.face, 0, 0.0, Climb::rising});
        directed_.push_back({high, low, s.face, 0, 0.0, Climb::falling});
    }

    Vec3 position(int point) const { return surface_.position(graph_.points[point].place); }

    /// Topological order: by the flow at the tail; level chords first, each kind by rank in its own direction; crossing ones last.
    void sort_chords() {
        std::vector<int> place(graph_.points.size());
        for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<int>(i);
        std::ranges::sort(place, {}, [&](int p) { return std::tuple(graph_.points[p].level, graph_.points[p].rank, p); });
        std::vector<int> position_in_order(place.size());
        for (std::size_t i = 0; i < place.size(); ++i) position_in_order[place[i]] = static_cast<int>(i);
        const auto key = [&](const DirectedSegment& d) {
            const GraphPoint &tail = graph_.points[d.tail], &head = graph_.points[d.head];
            const double across = d.crossings ? tail.rank + head.rank : 0.0;
            const int along_rank = d.climb == Climb::falling ? -position_in_order[d.tail] : position_in_order[d.tail];
            return std::tuple(d.crossings, across, tail.level, d.climb, along_rank, position_in_order[d.head]);
        };
        std::ranges::sort(directed_, {}, key);
        for (const DirectedSegment& d : directed_) {
            graph_.chords.push_back({d.tail, d.head, d.face, d.increment});
            graph_.crossing += d.crossings;
        }
    }

    /// The places of the chords that the given contour runs along.
    void find_given() {
        given_place_.assign(graph_.chords.size(), -1);
        const std::size_t count = patch_.contour.size();
        std::vector<int> place(graph_.points.size(), -1);
        for (std::size_t i = 0; i < count; ++i) place[point_of_vertex_[patch_.contour[i]]] = static_cast<int>(i);
        for (std::size_t c = 0; c < graph_.chords.size(); ++c) {
            const int tail = place[graph_.chords[c].tail], head = place[graph_.chords[c].head];
            if (tail >= 0 && head >= 0 && head == (tail + 1) % static_cast<int>(count)) given_place_[c] = tail;
        }
    }

    bool consecutive_in_given(int in, int out) const {
        return given_place_[in] >= 0 && given_place_[out] >= 0 &&
               given_place_[out] == (given_place_[in] + 1) % static_cast<int>(patch_.contour.size());
    }

    bool joins(int in, int out, const ChordEnd& end, const ChordEnd& start) const {
        const DirectedSegment &e1 = directed_[in], &e2 = directed_[out];
        if (e1.tail == e2.head) return false;
        // A contour passes a level by one monotone chain.
        if (e1.climb != Climb::along && e2.climb != Climb::along && e1.climb != e2.climb) return false;
        return consecutive_in_given(in, out) || !energy_.turns_too_much(end, start);
    }

    /// The arcs: pairs of chords, the second of which starts where the first ends.
    void join() {
        std::vector<Frame> frames;
        for (const GraphPoint& p : graph_.points) frames.push_back(energy_.frame(p.place));
        std::vector<ChordEnd> starts, ends;
        std::vector<std::vector<int>> arriving(graph_.points.size());
        for (std::size_t c = 0; c < graph_.chords.size(); ++c) {
            const Chord& chord = graph_.chords[c];
            const Vec3 along = position(chord.head) - position(chord.tail);
            starts.push_back(Energy::chord_end(frames[chord.tail], along));
            ends.push_back(Energy::chord_end(frames[chord.head], along));
            arriving[chord.head].push_back(static_cast<int>(c));
        }
        const int chords = static_cast<int>(graph_.chords.size()), plain = chords - graph_.crossing;
        const auto node_after = [&](int c) { return c < plain ? graph_.crossing + c : c - plain; };
        WeightedGraph& search = graph_.search;
        search.first_arc.assign(graph_.crossing + 1, 0);
        for (int out = 0; out < chords; ++out) {
            const int point = graph_.chords[out].tail;
            for (const int in : arriving[point]) {
                if (!joins(in, out, ends[in], starts[out])) continue;
                if (in >= plain && out >= plain) continue;
                search.from.push_back(node_after(in));
                search.f.push_back(energy_.numerator(frames[point], ends[in], starts[out]));
                search.g.push_back(Energy::denominator(ends[in], starts[out]));
            }
            search.first_arc.push_back(static_cast<int>(search.from.size()));
        }
        for (int i = 0; i < graph_.crossing; ++i) {
            search.sources.push_back({i, 0.0, 0.0});
            search.destinations.push_back({chords + i, 0.0, 0.0});
        }
    }
};

}  // namespace

ContourGraph make_graph(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow, const Energy& energy) {
    return GraphBuilder(surface, patch, band, flow, energy).build();
}

}  // namespace mrc
