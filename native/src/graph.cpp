// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/graph.h>

#include "ambient.h"
#include "memory.h"
#include "requirements.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace mrc {
namespace {

using Halfedge = PatchMesh::HalfedgeHandle;

enum class Climb : std::uint8_t { rising, falling, along };  // level chords by rank, and those that the flow runs along

struct DirectedSegment {
    int tail, head;
    int segment;
    int crossings;
    double increment;
    Climb climb;
};

class GraphBuilder {
  public:
    GraphBuilder(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow, const Energy& energy,
                 const Options& options, const Wishes& wishes, int steiner, const EdgeForm* region, const Territory& territory,
                 const Beat& beat)
        : surface_(surface),
          patch_(patch),
          band_(band),
          energy_(energy),
          options_(options),
          wishes_(wishes),
          region_(region),
          territory_(territory),
          beat_(beat),
          given_(expressed(patch.given, steiner).points),
          ambient_(make_ambient_graph(patch, band, flow, steiner)) {}

    ContourGraph build() {
        beat();
        merge_levels(ambient_.values, ambient_.segments);
        beat();
        choose_level();
        keep_off_others();
        beat();
        orient();
        beat();
        require();
        beat();
        sort_chords();
        beat();
        find_given();
        join();
        return std::move(graph_);
    }

  private:
    const Surface& surface_;
    const Patch& patch_;
    const Band& band_;
    const Energy& energy_;
    const Options& options_;
    const Wishes& wishes_;
    const EdgeForm* region_;
    const Territory& territory_;
    const Beat& beat_;
    const std::vector<SurfacePoint> given_;  // the given contour with the graph's own points along edges
    AmbientGraph ambient_;
    ContourGraph graph_;
    std::vector<DirectedSegment> directed_;
    Requirements requirements_;
    std::vector<int> given_place_;  // of each chord: its place in the given contour, or -1

    void choose_level() {
        if (patch_.closed) graph_.level = cheapest_level(ambient_.values, ambient_.segments);
        for (std::size_t p = 0; p < ambient_.places.size(); ++p) {
            const double level = patch_.closed ? above(ambient_.values[p], graph_.level) : ambient_.values[p];
            graph_.points.push_back({ambient_.places[p], level, ambient_.ranks[p]});
        }
    }

    /// Where another contour lies or may come to is closed, but for the contour's own points and segments.
    void keep_off_others() {
        if (territory_.closed_vertex.empty()) return;
        std::vector<char> closed = closed_points();
        std::set<std::pair<int, int>> own_segments;
        for (const Contour& own : territory_.own) {
            std::vector<int> points;
            for (const SurfacePoint& p : own.points) points.push_back(ambient_.point_at(patch_, p));
            for (std::size_t i = 0; i < points.size(); ++i) {
                const int a = points[i], b = points[(i + 1) % points.size()];
                if (a >= 0) closed[a] = 0;
                if (b >= 0 && (own.closed || i + 1 < points.size())) own_segments.insert(std::minmax(a, b));
            }
        }
        std::set<int> walls;  // by the surface's edges
        for (int e = 0; e < static_cast<int>(territory_.wall.size()); ++e) {
            if (territory_.wall[e]) walls.insert(surface_.edge(patch_.edge_halfedge(e)));
        }
        for (Segment& s : ambient_.segments) {
            const bool crossed = s.halfedge >= 0 && walls.contains(surface_.edge(s.halfedge));
            if ((closed[s.a] || closed[s.b] || crossed) && !own_segments.contains(std::minmax(s.a, s.b))) s.walkable = false;
        }
    }

    std::vector<char> closed_points() const {
        std::vector<char> closed(ambient_.point_count(), 0);
        for (std::size_t v = 0; v < patch_.vertex.size(); ++v) {
            if (ambient_.point_of_vertex[v] >= 0) closed[ambient_.point_of_vertex[v]] = territory_.closed_vertex[v];
        }
        for (std::size_t e = 0; e < territory_.closed_edge.size(); ++e) {
            const int first = ambient_.first_point_of_edge[e];
            for (int i = 0; first >= 0 && i < ambient_.steiner; ++i) closed[first + i] = territory_.closed_edge[e];
        }
        return closed;
    }

    /// Each segment becomes the chord that the flow runs along; a level one becomes two, by rank; of equal rank, none.
    void orient() {
        directed_.reserve(ambient_.segments.size());
        for (const Segment& s : ambient_.segments) {
            if (!s.walkable) continue;
            const double a = graph_.points[s.a].level, b = graph_.points[s.b].level;
            const int crossings =
                patch_.closed ? s.jump + whole(ambient_.values[s.b], graph_.level) - whole(ambient_.values[s.a], graph_.level) : 0;
            const double increment = b - a + crossings;
            if (increment == 0.0) {
                orient_level(s);
            } else if (!patch_.closed ||
                       std::abs(increment) < 1.0) {  // no closed contour holds a chord that goes all the way round
                const bool forward = increment > 0.0;
                directed_.push_back(
                    {forward ? s.a : s.b, forward ? s.b : s.a, index(s), std::abs(crossings), std::abs(increment), Climb::along});
            }
        }
    }

    void orient_level(const Segment& s) {
        const double difference = graph_.points[s.b].rank - graph_.points[s.a].rank;
        const double length = (position(s.b) - position(s.a)).norm();
        if (std::abs(difference) <= 1e-9 * length) return;
        const int low = difference > 0.0 ? s.a : s.b, high = difference > 0.0 ? s.b : s.a;
        directed_.push_back({low, high, index(s), 0, 0.0, Climb::rising});
        directed_.push_back({high, low, index(s), 0, 0.0, Climb::falling});
    }

    Requirements::Place place(int point) const { return {graph_.points[point].level, graph_.points[point].rank, point}; }
    Requirements::Span span(const DirectedSegment& d) const {
        const GraphPoint &tail = graph_.points[d.tail], &head = graph_.points[d.head];
        return {tail.level, head.level, d.crossings > 0, tail.rank, head.rank, d.segment};
    }

    /// The band's vertex for a required one.
    int required_point(int vertex) const {
        const auto found = ambient_.local.find(vertex);
        if (found != ambient_.local.end()) return ambient_.point_of_vertex[found->second];
        const char* others = territory_.refused.empty() ? "" : ", which other contours may keep back";
        throw InvalidInput("required vertex " + std::to_string(vertex) + " lies outside the band" + others +
                           ": widen the band or drop the requirement");
    }

    /// Deletes the chords that no contour through the required elements can hold (4.4).
    void require() {
        for (const int v : wishes_.required_vertices) requirements_.require(place(required_point(v)));
        for (const auto& [a, b] : wishes_.required_edges) require_edge(a, b);
        if (!patch_.closed && options_.ends == Ends::edges) require_end_edges();
        if (requirements_.empty()) return;
        std::erase_if(directed_, [&](const DirectedSegment& d) { return !requirements_.allows(span(d)); });
    }

    void require_edge(int a, int b) {
        const int p = required_point(a), q = required_point(b);
        const auto h =
            patch_.mesh.find_halfedge(PatchMesh::VertexHandle(ambient_.local.at(a)), PatchMesh::VertexHandle(ambient_.local.at(b)));
        const int edge = h.is_valid() ? h.idx() / 2 : -1;
        if (edge < 0 || !band_.edge[edge] || patch_.diagonal[edge] || patch_.border_edge[edge]) {
            throw InvalidInput("required edge (" + std::to_string(a) + ", " + std::to_string(b) +
                               ") is no edge inside the band: widen the band or drop the requirement");
        }
        requirements_.require(place(p));
        requirements_.require(place(q));
        std::vector<int> own = segments_of_edge(edge);
        if (!std::ranges::all_of(own, [&](int s) { return ambient_.segments[s].walkable; })) {
            throw InvalidInput("required edge (" + std::to_string(a) + ", " + std::to_string(b) +
                               ") touches another contour or its band: drop the requirement");
        }
        for (const DirectedSegment& d : directed_) {
            if (std::ranges::find(own, d.segment) != own.end()) requirements_.require(span(d), own);
        }
    }

    std::vector<int> segments_of_edge(int edge) const {
        const int halfedge = patch_.edge_halfedge(edge);
        std::vector<int> own;
        for (std::size_t i = 0; i < ambient_.segments.size(); ++i) {
            const int h = ambient_.segments[i].halfedge;
            if (h >= 0 && surface_.edge(h) == surface_.edge(halfedge)) own.push_back(static_cast<int>(i));
        }
        return own;
    }

    /// Open curves with their first and last edge held (4.6). A refined one whose ends are no whole edges holds its end points.
    void require_end_edges() {
        const auto& points = given_;
        const auto hold = [&](const SurfacePoint& end, const SurfacePoint& next) {
            if (!end.is_vertex()) return;
            const int other = next.is_vertex() ? next.a : next.a == end.a ? next.b : next.b == end.a ? next.a : -1;
            if (other >= 0 && surface_.real_edge(end.a, other)) require_edge(end.a, other);
        };
        hold(points.front(), points[1]);
        hold(points.back(), points[points.size() - 2]);
    }

    int index(const Segment& s) const { return static_cast<int>(&s - ambient_.segments.data()); }
    Vec3 position(int point) const { return surface_.position(graph_.points[point].place); }

    void beat(std::size_t i = 0) const {
        if (beat_ && i % 1024 == 0) beat_();
    }

    /// Where a chord stands in the topological order: by the flow at the tail; level chords first, each kind by rank in its own
    /// direction; those that cross the cut last.
    struct ChordKey {
        int crossings;
        double across;
        int level;  // of the tail, by number
        Climb climb;
        int tail, head;  // by their places among the points
        std::size_t chord;
        auto operator<=>(const ChordKey&) const = default;
    };

    std::vector<ChordKey> chord_keys() const {
        const std::size_t count = graph_.points.size();
        std::vector<int> order(count), place(count), level(count, 0);
        for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<int>(i);
        std::ranges::sort(order, {}, [&](int p) { return std::tuple(graph_.points[p].level, graph_.points[p].rank, p); });
        for (std::size_t i = 0; i < count; ++i) {
            place[order[i]] = static_cast<int>(i);
            if (i > 0) level[order[i]] = level[order[i - 1]] + (graph_.points[order[i]].level > graph_.points[order[i - 1]].level);
        }
        std::vector<ChordKey> keys;
        keys.reserve(directed_.size());
        for (std::size_t i = 0; i < directed_.size(); ++i) {
            const DirectedSegment& d = directed_[i];
            const double across = d.crossings ? graph_.points[d.tail].rank + graph_.points[d.head].rank : 0.0;
            const int tail = d.climb == Climb::falling ? -place[d.tail] : place[d.tail];
            keys.push_back({d.crossings, across, level[d.tail], d.climb, tail, place[d.head], i});
        }
        return keys;
    }

    /// Sorted in buckets of one level each, and one for what crosses the cut.
    void sort_chords() {
        const std::vector<ChordKey> keys = chord_keys();
        beat();
        const std::size_t last = graph_.points.size();  // no level has a higher number
        const auto bucket = [&](const ChordKey& key) { return key.crossings > 0 ? last : static_cast<std::size_t>(key.level); };
        std::vector<std::size_t> end(last + 1, 0);
        for (const ChordKey& key : keys) ++end[bucket(key)];
        std::inclusive_scan(end.begin(), end.end(), end.begin());
        std::vector<std::size_t> next(end.size(), 0);
        std::copy(end.begin(), end.end() - 1, next.begin() + 1);
        std::vector<ChordKey> sorted(keys.size());
        for (const ChordKey& key : keys) sorted[next[bucket(key)]++] = key;
        for (std::size_t b = 0, begin = 0; b < end.size(); begin = end[b++]) {
            beat(b);
            std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin), sorted.begin() + static_cast<std::ptrdiff_t>(end[b]));
        }
        std::vector<DirectedSegment> directed;
        directed.reserve(sorted.size());
        graph_.chords.reserve(sorted.size());
        for (const ChordKey& key : sorted) {
            const DirectedSegment& d = directed.emplace_back(directed_[key.chord]);
            graph_.chords.push_back({d.tail, d.head, d.increment});
            graph_.crossing += d.crossings;
        }
        directed_ = std::move(directed);
    }

    /// The places of the chords that the given contour runs along.
    void find_given() {
        given_place_.assign(graph_.chords.size(), -1);
        const std::size_t count = given_.size();
        std::vector<int> place(graph_.points.size(), -1);
        for (std::size_t i = 0; i < count; ++i) {
            const int p = ambient_.point_at(patch_, given_[i]);
            if (p >= 0) place[p] = static_cast<int>(i);
        }
        for (std::size_t c = 0; c < graph_.chords.size(); ++c) {
            const int tail = place[graph_.chords[c].tail], head = place[graph_.chords[c].head];
            const bool follows = head == tail + 1 || (patch_.closed && head == 0 && tail + 1 == static_cast<int>(count));
            if (tail >= 0 && head >= 0 && follows) given_place_[c] = tail;
        }
    }

    bool consecutive_in_given(int in, int out) const {
        return given_place_[in] >= 0 && given_place_[out] >= 0 &&
               given_place_[out] == (given_place_[in] + 1) % static_cast<int>(given_.size());
    }

    static int sign(Climb climb) { return climb == Climb::rising ? 1 : climb == Climb::falling ? -1 : 0; }

    bool joins(int in, int out, const ChordEnd& end, const ChordEnd& start) const {
        const DirectedSegment &e1 = directed_[in], &e2 = directed_[out];
        if (e1.tail == e2.head) return false;
        // A contour passes a level by one monotone chain.
        if (e1.climb != Climb::along && e2.climb != Climb::along && e1.climb != e2.climb) return false;
        const int climb_in = sign(e1.climb), climb_out = sign(e2.climb);
        if (!requirements_.empty() && !requirements_.allows_arc(place(e2.tail), climb_in, climb_out)) return false;
        if (consecutive_in_given(in, out)) return true;
        // Two chords inside one triangle are never better than one (3.2).
        const int triangle = ambient_.segments[e1.segment].triangle;
        if (triangle >= 0 && triangle == ambient_.segments[e2.segment].triangle) return false;
        return !energy_.turns_too_much(end, start);
    }

    /// The points at which an open curve may end: its own end, or the piece of mesh border within the band that holds it.
    std::vector<char> end_points(const SurfacePoint& end, const SurfacePoint& other, bool held) const {
        std::vector<char> allowed(graph_.points.size(), 0);
        if (const int own = ambient_.point_at(patch_, end); own >= 0) allowed[own] = 1;
        if (held || options_.ends != Ends::border || !end.is_vertex() || !other.is_vertex()) return allowed;
        const std::vector<int> piece = border_piece(patch_, band_, ambient_.local.at(end.a));
        if (std::ranges::find(piece, ambient_.local.at(other.a)) != piece.end()) return allowed;
        for (const int v : piece) {
            allowed[ambient_.point_of_vertex[v]] = 1;
            for (const auto h : patch_.mesh.voh_range(PatchMesh::VertexHandle(v))) {
                const int first = patch_.border_edge[h.idx() / 2] ? ambient_.first_point_of_edge[h.idx() / 2] : -1;
                for (int i = 0; first >= 0 && i < ambient_.steiner; ++i) allowed[first + i] = 1;
            }
        }
        return allowed;
    }

    /// Any chord that leaves the first end may begin a path, and any that reaches the last may end it, each with the outer half that
    /// eq. 3.3 leaves out.
    void add_open_ends(const std::vector<Frame>& frames, const std::vector<ChordEnd>& starts, const std::vector<ChordEnd>& ends) {
        const auto& given = given_;
        const std::vector<char> first = end_points(given.front(), given.back(), patch_.first_end_held);
        const std::vector<char> last = end_points(given.back(), given.front(), patch_.last_end_held);
        for (std::size_t c = 0; c < graph_.chords.size(); ++c) {
            const auto [tail, head, increment] = graph_.chords[c];
            const int node = static_cast<int>(c);
            const auto half = [&](int point, const ChordEnd& in, const ChordEnd& out) {
                return Terminal{node, energy_.numerator(frames[point], in, out), energy_.denominator(in, out)};
            };
            // A path that begins or ends at the level of a required vertex begins or ends there.
            const int climb = sign(directed_[c].climb);
            const bool may_begin = first[tail] && requirements_.allows_arc(place(tail), 0, climb);
            const bool may_end = last[head] && requirements_.allows_arc(place(head), climb, 0);
            if (may_begin) graph_.search.sources.push_back(half(tail, {}, starts[c]));
            if (may_end) graph_.search.destinations.push_back(half(head, ends[c], {}));
        }
    }

    /// The arcs: pairs of chords, the second of which starts where the first ends.
    void join() {
        std::vector<Frame> frames;
        for (const GraphPoint& p : graph_.points) {
            beat(frames.size());
            frames.push_back(energy_.frame(p.place));
        }
        std::vector<ChordEnd> starts, ends;
        std::vector<double> enclosed(graph_.chords.size(), 0.0);  // half of what each chord adds to the region term
        std::vector<std::vector<int>> arriving(graph_.points.size());
        for (std::size_t c = 0; c < graph_.chords.size(); ++c) {
            beat(c);
            const Chord& chord = graph_.chords[c];
            const Vec3 along = position(chord.head) - position(chord.tail);
            const int halfedge = ambient_.segments[directed_[c].segment].halfedge;
            const double crease = halfedge >= 0 ? energy_.crease_cost(halfedge) : energy_.plain_crease_cost();
            starts.push_back(Energy::chord_end(frames[chord.tail], along, crease));
            ends.push_back(Energy::chord_end(frames[chord.head], along, crease));
            arriving[chord.head].push_back(static_cast<int>(c));
            if (region_) {
                enclosed[c] = 0.5 * energy_.region_factor() *
                              region_->along(graph_.points[chord.tail].place, graph_.points[chord.head].place);
            }
        }
        const int chords = static_cast<int>(graph_.chords.size()), plain = chords - graph_.crossing;
        const auto node_after = [&](int c) { return c < plain ? graph_.crossing + c : c - plain; };
        WeightedGraph& search = graph_.search;
        search.first_arc.assign(graph_.crossing + 1, 0);
        for (int out = 0; out < chords; ++out) {
            beat(out);
            const int point = graph_.chords[out].tail;
            for (const int in : arriving[point]) {
                if (!joins(in, out, ends[in], starts[out])) continue;
                if (in >= plain && out >= plain) continue;
                search.from.push_back(node_after(in));
                search.f.push_back(energy_.numerator(frames[point], ends[in], starts[out]) + enclosed[in] + enclosed[out]);
                search.g.push_back(energy_.denominator(ends[in], starts[out]));
            }
            search.first_arc.push_back(static_cast<int>(search.from.size()));
        }
        search.matched = patch_.closed;
        for (int i = 0; i < graph_.crossing; ++i) {
            search.sources.push_back({i, 0.0, 0.0});
            search.destinations.push_back({chords + i, 0.0, 0.0});
        }
        if (!patch_.closed) add_open_ends(frames, starts, ends);
    }
};

}  // namespace

ContourGraph make_graph(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow, const Energy& energy,
                        const Options& options, const Wishes& wishes, int steiner, const EdgeForm* region,
                        const Territory& territory, const Beat& beat) {
    check_graph_size(static_cast<double>(std::ranges::count(band.face, 1)), steiner);
    return GraphBuilder(surface, patch, band, flow, energy, options, wishes, steiner, region, territory, beat).build();
}

}  // namespace mrc
