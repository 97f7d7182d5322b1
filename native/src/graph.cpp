// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph.h"

#include "ambient_graph.h"
#include "graph_size_limit.h"
#include "line_graph.h"
#include "required_elements.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace mrc {
namespace {

using Halfedge = PatchMesh::HalfedgeHandle;

struct DirectedSegment {
    int tail, head;
    double increment;
    int segment;
    bool crosses;  // the level, at most once
    Climb climb;
};

class GraphBuilder {
  public:
    GraphBuilder(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow, const Energy& energy,
                 const Options& options, const Constraints& constraints, int steiner, const EdgeForm* region,
                 const Exclusion& exclusion, const Beat& beat)
        : surface_(surface),
          patch_(patch),
          band_(band),
          energy_(energy),
          options_(options),
          constraints_(constraints),
          region_(region),
          exclusion_(exclusion),
          beat_(beat),
          given_(expressed(patch.given, steiner).points),
          ambient_(make_ambient_graph(patch, band, flow, steiner)) {}

    ContourGraph build() {
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
    const Constraints& constraints_;
    const EdgeForm* region_;
    const Exclusion& exclusion_;
    const Beat& beat_;
    const std::vector<SurfacePoint> given_;  // the given contour with the graph's own points along edges
    AmbientGraph ambient_;
    ContourGraph graph_;
    std::vector<DirectedSegment> directed_;
    RequiredElements required_elements_;
    std::vector<ChordSite> sites_;  // of the chords

    void choose_level() {
        if (patch_.closed) graph_.level = cheapest_level(ambient_.values, ambient_.segments);
        for (std::size_t p = 0; p < ambient_.places.size(); ++p) {
            const double level = patch_.closed ? above(ambient_.values[p], graph_.level) : ambient_.values[p];
            graph_.points.push_back({ambient_.places[p], level, ambient_.ranks[p]});
        }
    }

    /// Where another contour lies or may come to is closed, but for the contour's own points and segments.
    void keep_off_others() {
        if (exclusion_.closed_vertex.empty()) return;
        std::vector<char> closed = closed_points();
        std::set<std::pair<int, int>> own_segments;
        for (const Contour& own : exclusion_.own) {
            std::vector<int> points;
            points.reserve(own.points.size());
            for (const SurfacePoint& p : own.points) points.push_back(ambient_.point_at(patch_, p));
            for (std::size_t i = 0; i < points.size(); ++i) {
                const int a = points[i], b = points[(i + 1) % points.size()];
                if (a >= 0) closed[a] = 0;
                if (b >= 0 && (own.closed || i + 1 < points.size())) own_segments.insert(std::minmax(a, b));
            }
        }
        std::set<int> walls;  // by the surface's edges
        for (int e = 0; e < static_cast<int>(exclusion_.wall.size()); ++e) {
            // Both ends of an edge between two bands may be points that the given contours share: neither runs along it.
            if (exclusion_.wall[e] || exclusion_.closed_edge[e]) walls.insert(surface_.edge(patch_.edge_halfedge(e)));
        }
        for (Segment& s : ambient_.segments) {
            const bool crossed = s.halfedge >= 0 && walls.contains(surface_.edge(s.halfedge));
            if ((closed[s.a] || closed[s.b] || crossed) && !own_segments.contains(std::minmax(s.a, s.b))) s.walkable = false;
        }
    }

    std::vector<char> closed_points() const {
        std::vector<char> closed(ambient_.point_count(), 0);
        for (std::size_t v = 0; v < patch_.vertex.size(); ++v) {
            if (ambient_.point_of_vertex[v] >= 0) closed[ambient_.point_of_vertex[v]] = exclusion_.closed_vertex[v];
        }
        for (std::size_t e = 0; e < exclusion_.closed_edge.size(); ++e) {
            const int first = ambient_.first_point_of_edge[e];
            for (int i = 0; first >= 0 && i < ambient_.steiner; ++i) closed[first + i] = exclusion_.closed_edge[e];
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
                    {forward ? s.a : s.b, forward ? s.b : s.a, std::abs(increment), index(s), crossings != 0, Climb::along});
            }
        }
    }

    void orient_level(const Segment& s) {
        const double difference = graph_.points[s.b].rank - graph_.points[s.a].rank;
        const double length = (position(s.b) - position(s.a)).norm();
        if (std::abs(difference) <= 1e-9 * length) return;
        const int low = difference > 0.0 ? s.a : s.b, high = difference > 0.0 ? s.b : s.a;
        directed_.push_back({low, high, 0.0, index(s), false, Climb::rising});
        directed_.push_back({high, low, 0.0, index(s), false, Climb::falling});
    }

    RequiredElements::Place place(int point) const { return {graph_.points[point].level, graph_.points[point].rank, point}; }
    RequiredElements::Span span(const DirectedSegment& d) const {
        const GraphPoint &tail = graph_.points[d.tail], &head = graph_.points[d.head];
        return {tail.level, head.level, d.crosses, tail.rank, head.rank, d.segment};
    }

    /// The band's vertex for a required one.
    int required_point(int vertex) const {
        const auto found = ambient_.local.find(vertex);
        if (found != ambient_.local.end()) return ambient_.point_of_vertex[found->second];
        const char* others = exclusion_.refused.empty() ? "" : ", which other contours may keep back";
        throw InvalidInput("required vertex " + std::to_string(vertex) + " lies outside the band" + others +
                           ": widen the band or drop the requirement");
    }

    /// Deletes the chords that no contour through the required elements can hold (4.4).
    void require() {
        for (const int v : constraints_.required_vertices) required_elements_.require(place(required_point(v)));
        for (const auto& [a, b] : constraints_.required_edges) require_edge(a, b);
        if (!patch_.closed && options_.ends == Ends::edges) require_end_edges();
        if (required_elements_.empty()) return;
        std::erase_if(directed_, [&](const DirectedSegment& d) { return !required_elements_.allows(span(d)); });
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
        required_elements_.require(place(p));
        required_elements_.require(place(q));
        std::vector<int> own = segments_of_edge(edge);
        if (!std::ranges::all_of(own, [&](int s) { return ambient_.segments[s].walkable; })) {
            throw InvalidInput("required edge (" + std::to_string(a) + ", " + std::to_string(b) +
                               ") touches another contour or its band: drop the requirement");
        }
        for (const DirectedSegment& d : directed_) {
            if (std::ranges::find(own, d.segment) != own.end()) required_elements_.require(span(d), own);
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

    /// The points in the order of level, rank and number, and the number of each point's level.
    struct Places {
        std::vector<int> place, level;  // of each point
    };

    Places sort_points() const {
        struct Key {
            double level, rank;
            int point;
            auto operator<=>(const Key&) const = default;
        };
        std::vector<Key> keys;
        keys.reserve(graph_.points.size());
        for (const GraphPoint& p : graph_.points) keys.push_back({p.level, p.rank, static_cast<int>(keys.size())});
        std::ranges::sort(keys);
        Places places{std::vector<int>(keys.size()), std::vector<int>(keys.size())};
        for (int i = 0, level = 0; i < static_cast<int>(keys.size()); ++i) {
            if (i > 0 && keys[i].level > keys[i - 1].level) ++level;
            places.place[keys[i].point] = i;
            places.level[keys[i].point] = level;
        }
        return places;
    }

    /// Where a chord stands among those that leave points of one level: level chords first, each kind by rank in its own direction.
    struct ChordKey {
        std::uint64_t order;  // climb, tail, head: the ends by their places among the points
        int chord;
        auto operator<=>(const ChordKey&) const = default;
    };

    ChordKey chord_key(int chord, const Places& places) const {
        constexpr std::uint64_t most = (1ULL << 31) - 1;
        const DirectedSegment& d = directed_[chord];
        const auto tail = static_cast<std::uint64_t>(places.place[d.tail]), head = static_cast<std::uint64_t>(places.place[d.head]);
        const std::uint64_t from = d.climb == Climb::falling ? most - tail : tail;
        return {static_cast<std::uint64_t>(d.climb) << 62 | from << 31 | head, chord};
    }

    /// The topological order: by the flow at the tail, in buckets of one level each; last what crosses the cut, by rank.
    std::vector<ChordKey> sorted_keys() const {
        const Places places = sort_points();
        const std::size_t last = graph_.points.size();  // no level has a higher number
        const auto bucket = [&](const DirectedSegment& d) {
            return d.crosses ? last : static_cast<std::size_t>(places.level[d.tail]);
        };
        std::vector<int> next(last + 2, 0);
        for (const DirectedSegment& d : directed_) ++next[bucket(d) + 1];
        std::partial_sum(next.begin(), next.end(), next.begin());
        std::vector<ChordKey> keys(directed_.size());
        for (int i = 0; i < static_cast<int>(directed_.size()); ++i) keys[next[bucket(directed_[i])]++] = chord_key(i, places);
        auto begin = keys.begin();
        for (std::size_t b = 0; b < last; ++b) {
            beat(b);
            const auto end = keys.begin() + next[b];  // by now
            std::sort(begin, end);
            begin = end;
        }
        const auto across = [&](const ChordKey& key) {
            const DirectedSegment& d = directed_[key.chord];
            return std::pair(graph_.points[d.tail].rank + graph_.points[d.head].rank, key);
        };
        std::sort(begin, keys.end(), [&](const ChordKey& a, const ChordKey& b) { return across(a) < across(b); });
        return keys;
    }

    void sort_chords() {
        const std::vector<ChordKey> keys = sorted_keys();
        graph_.chords.reserve(keys.size());
        sites_.reserve(keys.size());
        for (const ChordKey& key : keys) {
            const DirectedSegment& d = directed_[key.chord];
            const Segment& s = ambient_.segments[d.segment];
            graph_.chords.push_back({d.tail, d.head, d.increment});
            sites_.push_back({s.halfedge, s.triangle, -1, d.climb});
            graph_.crossing += d.crosses;
        }
        directed_ = std::vector<DirectedSegment>();  // the arcs are to come, which need the room
        ambient_.segments = std::vector<Segment>();
    }

    /// The places of the chords that the given contour runs along.
    void find_given() {
        const std::size_t count = given_.size();
        std::vector<int> place(graph_.points.size(), -1);
        for (std::size_t i = 0; i < count; ++i) {
            const int p = ambient_.point_at(patch_, given_[i]);
            if (p >= 0) place[p] = static_cast<int>(i);
        }
        for (std::size_t c = 0; c < graph_.chords.size(); ++c) {
            const int tail = place[graph_.chords[c].tail], head = place[graph_.chords[c].head];
            const bool follows = head == tail + 1 || (patch_.closed && head == 0 && tail + 1 == static_cast<int>(count));
            if (tail >= 0 && head >= 0 && follows) sites_[c].given = tail;
        }
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
    void add_open_ends() {
        const auto& given = given_;
        const std::vector<char> first = end_points(given.front(), given.back(), patch_.first_end_held);
        const std::vector<char> last = end_points(given.back(), given.front(), patch_.last_end_held);
        for (int c = 0; c < static_cast<int>(graph_.chords.size()); ++c) {
            const auto [tail, head, increment] = graph_.chords[c];
            // A path that begins or ends at the level of a required vertex begins or ends there.
            const int climb = sign(sites_[c].climb);
            if (first[tail] && required_elements_.allows_arc(place(tail), 0, climb)) {
                const Frame frame = energy_.frame(graph_.points[tail].place);
                graph_.search.sources.push_back(half(c, frame, {}, chord_end(c, frame)));
            }
            if (last[head] && required_elements_.allows_arc(place(head), climb, 0)) {
                const Frame frame = energy_.frame(graph_.points[head].place);
                graph_.search.destinations.push_back(half(c, frame, chord_end(c, frame), {}));
            }
        }
    }

    ChordEnd chord_end(int chord, const Frame& frame) const {
        const Chord& c = graph_.chords[chord];
        return energy_.chord_end(frame, position(c.head) - position(c.tail), energy_.crease_cost(sites_[chord].halfedge));
    }
    Terminal half(int node, const Frame& frame, const ChordEnd& in, const ChordEnd& out) const {
        const ArcWeights weights = energy_.weights(frame);
        return {node, weights.numerator(in, out), weights.denominator(in, out)};
    }

    void join() {
        graph_.search = make_line_graph(
            surface_, {graph_.points, graph_.chords, sites_, graph_.crossing, static_cast<int>(given_.size()), required_elements_},
            energy_, region_, beat_);
        graph_.search.matched = patch_.closed;
        for (int i = 0; i < graph_.crossing; ++i) {
            graph_.search.sources.push_back({i, 0.0, 0.0});
            graph_.search.destinations.push_back({static_cast<int>(graph_.chords.size()) + i, 0.0, 0.0});
        }
        if (!patch_.closed) add_open_ends();
    }
};

}  // namespace

ContourGraph make_graph(const Surface& surface, const Patch& patch, const Band& band, const Flow& flow, const Energy& energy,
                        const Options& options, const Constraints& constraints, int steiner, const EdgeForm* region,
                        const Exclusion& exclusion, const Beat& beat) {
    check_graph_size(static_cast<double>(std::ranges::count(band.face, 1)), steiner);
    return GraphBuilder(surface, patch, band, flow, energy, options, constraints, steiner, region, exclusion, beat).build();
}

}  // namespace mrc
