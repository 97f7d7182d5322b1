// SPDX-License-Identifier: GPL-3.0-or-later
#include "strip_flow.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <queue>

namespace mrc {
namespace {

using Curve = std::vector<int>;
using Point = PatchMesh::Point;
using Vertex = PatchMesh::VertexHandle;
using Halfedge = PatchMesh::HalfedgeHandle;

constexpr double least_slope = 0.01;        // of the flow between two gates, in the strip's mean slope
constexpr double least_edge = 1e-3;         // arc length of an edge, in the strip's mean edge: zero-length edges rise too
constexpr double same_length = 1.0 - 1e-9;  // two lengths whose ratio is nearer to 1 differ by rounding only
constexpr int off_strip = std::numeric_limits<int>::min();

Halfedge halfedge(const PatchMesh& mesh, int a, int b) { return Halfedge(mesh.find_halfedge(Vertex(a), Vertex(b)).idx()); }

Curve across(const std::vector<int>& before, int last) {
    Curve path;
    for (int v = last; v >= 0; v = before[v]) path.push_back(v);
    std::reverse(path.begin(), path.end());
    return path;
}

/// A cut as in 4.2.2: the shortest path along real edges across the band, from its right border to its left one.
Curve start_line(const Patch& patch, const Band& band, const Curve& right, const Curve& left) {
    const PatchMesh& mesh = patch.mesh;
    std::vector<double> distance(mesh.n_vertices(), std::numeric_limits<double>::infinity());
    std::vector<int> before(mesh.n_vertices(), -1);
    std::vector<char> goal(mesh.n_vertices(), 0);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const int v : left) goal[v] = 1;
    for (const int v : right) queue.emplace(distance[v] = 0.0, v);
    while (!goal[queue.top().second]) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) continue;
        for (const auto h : mesh.voh_range(Vertex(v))) {
            if (!band.edge[h.idx() / 2] || patch.diagonal_halfedge(h.idx())) continue;
            const int w = mesh.to_vertex_handle(h).idx();
            const double through = d + mesh.calc_edge_length(h);
            if (through >= distance[w]) continue;
            distance[w] = through;
            before[w] = v;
            queue.emplace(through, w);
        }
    }
    return across(before, queue.top().second);
}

/// The band cut open along the start line. A flow's values hold in the opened band; a face behind the line sees the line's own
/// vertices one turn further on. The band of an open curve is open as it is.
struct Cut {
    Curve line;                ///< from right to left
    std::vector<char> behind;  ///< of each half-edge in the band: true where it starts on the line and its face lies behind it
    std::vector<int> jump;     ///< of each half-edge: crossings of the line
};

/// Marks the corners behind the line: at each of its vertices those from the way ahead, or from the left border, round to the way
/// back, or to the right border.
void mark_behind(const Patch& patch, const Band& band, Halfedge left_border, Cut& cut) {
    const PatchMesh& mesh = patch.mesh;
    const auto in_band = [&](Halfedge h) { return mesh.face_handle(h).is_valid() && band.face[mesh.face_handle(h).idx()]; };
    for (size_t k = 0; k < cut.line.size(); ++k) {
        Halfedge h = k + 1 < cut.line.size() ? halfedge(mesh, cut.line[k], cut.line[k + 1]) : left_border;
        const Halfedge stop = k > 0 ? halfedge(mesh, cut.line[k], cut.line[k - 1]) : Halfedge();
        for (; h != stop && in_band(h); h = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h))) cut.behind[h.idx()] = 1;
    }
}

Cut cut_open(const Patch& patch, const Band& band, const std::vector<Curve>& strips) {
    const PatchMesh& mesh = patch.mesh;
    Cut cut{{}, std::vector<char>(mesh.n_halfedges(), 0), std::vector<int>(mesh.n_halfedges(), 0)};
    if (!patch.closed) return cut;
    cut.line = start_line(patch, band, strips.front(), strips.back());
    const Curve& left = strips.back();
    const auto end = std::find(left.begin(), left.end(), cut.line.back());
    const Halfedge border = halfedge(mesh, *end, end == left.begin() ? left.back() : *(end - 1));
    mark_behind(patch, band, border, cut);
    for (const auto f : mesh.faces()) {
        if (!band.face[f.idx()]) continue;
        for (const auto h : mesh.fh_range(f)) {
            cut.jump[h.idx()] = cut.behind[mesh.next_halfedge_handle(h).idx()] - cut.behind[h.idx()];
            cut.jump[h.idx() ^ 1] = -cut.jump[h.idx()];
        }
    }
    // The border's edge lies behind the line also where it is a contour edge without a face.
    cut.jump[border.idx()] = -1;
    cut.jump[border.idx() ^ 1] = 1;
    return cut;
}

/// A strip boundary unrolled: `k` and `k + size()` are the same vertex, one turn apart. One of an open curve has one turn only.
struct Strip {
    Curve vertices;
    std::vector<int> lap;      ///< of each vertex: crossings of the start line since the first one
    std::vector<double> arc;   ///< of each vertex: length from the first one
    std::vector<double> flow;  ///< of each vertex, as it rises along the strip
    double length = 0.0;
    bool closed = true;

    int size() const { return static_cast<int>(vertices.size()); }
    int turn(int k) const { return (k >= 0 ? k : k - size() + 1) / size(); }
    int vertex(int k) const { return vertices[k - turn(k) * size()]; }
    double arc_at(int k) const { return arc[k - turn(k) * size()] + turn(k) * length; }
    double flow_at(int k) const { return flow[k - turn(k) * size()] + turn(k); }
};

/// The point (1 - t) k + t (k + 1) of a strip, and how far it is from the point that looked for it.
struct Foot {
    int k = 0;
    double t = 0.0;
    double distance = 0.0;

    double place() const { return k + t; }
    double arc(const Strip& strip) const { return (1.0 - t) * strip.arc_at(k) + t * strip.arc_at(k + 1); }
    double flow(const Strip& strip) const { return (1.0 - t) * strip.flow_at(k) + t * strip.flow_at(k + 1); }
};

/// A point of a strip whose flow the strip before it settles.
struct Gate {
    double arc = 0.0;
    double flow = 0.0;
    double length = 0.0;
};

/// The flow along one turn of a strip, linear in arc length between its gates.
class Profile {
  public:
    Profile(const Gate& first, double length) : first_(first), length_(length) {
        flow_[first.arc] = first.flow;
        flow_[first.arc + length] = first.flow + 1.0;
    }

    void insert(Gate gate) {
        bring_home(gate);
        flow_.emplace(gate.arc, gate.flow);
    }

    /// Inserts a gate unless it crosses one that is there already.
    void offer(Gate gate) {
        bring_home(gate);
        const auto after = flow_.upper_bound(gate.arc);
        if (after == flow_.end()) return;
        const auto before = std::prev(after);
        const auto rises = [&](double arc, double flow) { return arc > 1e-12 * length_ && flow >= least_slope * arc / length_; };
        const bool fits = rises(gate.arc - before->first, gate.flow - before->second) &&
                          rises(after->first - gate.arc, after->second - gate.flow);
        if (fits) flow_.emplace_hint(after, gate.arc, gate.flow);
    }

    double at(double arc) const {
        Gate point{arc, 0.0, 0.0};
        bring_home(point);
        auto after = flow_.upper_bound(point.arc);
        if (after == flow_.end()) --after;
        const auto before = std::prev(after);
        const double t = (point.arc - before->first) / (after->first - before->first);
        return (1.0 - t) * before->second + t * after->second - point.flow;
    }

  private:
    Gate first_;
    double length_;
    std::map<double, double> flow_;  // by arc

    void bring_home(Gate& gate) const {
        const double turns = std::floor((gate.arc - first_.arc) / length_);
        gate.arc = std::clamp(gate.arc - turns * length_, first_.arc, first_.arc + length_);
        gate.flow -= turns;
    }
};

class StripFlow {
  public:
    StripFlow(const Patch& patch, const Band& band, FlowKind kind, const std::vector<double>& fixed)
        : patch_(patch),
          mesh_(patch.mesh),
          band_(band),
          kind_(kind),
          fixed_(fixed),
          strips_(strip_boundaries(patch, band)),
          cut_(cut_open(patch, band, strips_)),
          value_(mesh_.n_vertices(), 0.0),
          known_(mesh_.n_vertices(), 0),
          known_index_(mesh_.n_vertices(), off_strip),
          next_index_(mesh_.n_vertices(), off_strip) {}

    Flow run() {
        const auto middle = std::find(strips_.begin(), strips_.end(), band_.left.front());
        const Strip contour = measured_contour(*middle);
        spread(contour, std::vector<Curve>(middle + 1, strips_.end()));
        spread(contour, std::vector<Curve>(std::make_reverse_iterator(middle), strips_.rend()));
        for (size_t i = band_.polygons.size() - band_.end_polygons; i < band_.polygons.size(); ++i) fill(band_.polygons[i]);
        return {std::move(value_), cut_.jump};
    }

  private:
    const Patch& patch_;
    const PatchMesh& mesh_;
    const Band& band_;
    const FlowKind kind_;
    const std::vector<double>& fixed_;  // of each vertex: 0 or 1 at the ends of an open curve, below 0 elsewhere
    const std::vector<Curve> strips_;
    const Cut cut_;
    std::vector<double> value_;
    std::vector<char> known_;  // of each vertex: true where `value_` is settled
    // Of each vertex: its place on the known and on the next strip, as seen in the band cut open, or `off_strip`.
    std::vector<int> known_index_, next_index_;

    const Point& point(int vertex) const { return mesh_.point(Vertex(vertex)); }

    void settle(int vertex, double value) {
        value_[vertex] = value;
        known_[vertex] = 1;
    }

    Strip unroll(const Curve& curve) const {
        Strip strip{curve, {0}, {0.0}, {}, 0.0, patch_.closed};
        std::vector<Halfedge> edges;
        for (size_t i = 0; i + !strip.closed < curve.size(); ++i)
            edges.push_back(halfedge(mesh_, curve[i], curve[(i + 1) % curve.size()]));
        const auto [first, last] = strip.closed ? std::pair<size_t, size_t>(0, edges.size()) : rising_stretch(curve);
        double total = 0.0;
        for (size_t i = first; i < last; ++i) total += mesh_.calc_edge_length(edges[i]);
        const double least = total > 0.0 ? least_edge * total / static_cast<double>(last - first) : 1.0;
        for (size_t i = 0; i < edges.size(); ++i) {
            const bool rises = first <= i && i < last;
            strip.lap.push_back(strip.lap.back() + cut_.jump[edges[i].idx()]);
            strip.arc.push_back(strip.arc.back() + (rises ? std::max(least, mesh_.calc_edge_length(edges[i])) : 0.0));
        }
        strip.length = strip.arc.back();
        strip.lap.resize(curve.size());
        strip.arc.resize(curve.size());
        return strip;
    }

    /// Of an open curve's strip: the last vertex held at 0 and the first one after it held at 1.
    std::pair<size_t, size_t> rising_stretch(const Curve& curve) const {
        const auto held_at = [&](int v, double end) { return fixed_[v] == end || (known_[v] && value_[v] == end); };
        size_t first = curve.size() - 2;
        while (!held_at(curve[first], 0.0)) --first;
        size_t last = first + 1;
        while (!held_at(curve[last], 1.0)) ++last;
        return {first, last};
    }

    void set_index(const Strip& strip, std::vector<int>& index) const {
        for (int k = 0; k < strip.size(); ++k) index[strip.vertices[k]] = k - strip.lap[k] * strip.size();
    }

    static void clear_index(const Strip& strip, std::vector<int>& index) {
        for (const int v : strip.vertices) index[v] = off_strip;
    }

    /// Where a strip starts: at the first vertex of the start line on it, as seen in the band cut open.
    double start_arc(const Strip& strip, const std::vector<int>& index) const {
        const auto first = std::find_if(cut_.line.begin(), cut_.line.end(), [&](int v) { return index[v] != off_strip; });
        return strip.arc_at(index[*first]);
    }

    Strip measured_contour(const Curve& curve) {
        Strip contour = unroll(curve);
        set_index(contour, known_index_);
        const double start = contour.closed ? start_arc(contour, known_index_) : 0.0;
        for (int k = 0; k < contour.size(); ++k) {
            contour.flow.push_back((contour.arc[k] - start) / contour.length);
            settle(contour.vertices[k], contour.flow[k] - contour.lap[k]);
        }
        clear_index(contour, known_index_);
        return contour;
    }

    /// Carries the flow outwards over the strips of one side.
    void spread(Strip known, const std::vector<Curve>& curves) {
        set_index(known, known_index_);
        for (const Curve& curve : curves) {
            Strip next = unroll(curve);
            set_index(next, next_index_);
            extend(known, next);
            clear_index(known, known_index_);
            known_index_.swap(next_index_);
            known = std::move(next);
        }
        clear_index(known, known_index_);
    }

    void extend(const Strip& known, Strip& next) {
        const Profile profile = choose_gates(known, next);
        for (int k = 0; k < next.size(); ++k) {
            const int v = next.vertices[k];
            const bool shared = known_index_[v] != off_strip;
            if (!shared) settle(v, profile.at(next.arc[k]) - next.lap[k]);
            next.flow.push_back(value_[v] + next.lap[k]);
        }
    }

    /// Settles the vertices of an end polygon that no strip holds, evenly between the two beside them.
    void fill(int polygon) {
        for (int f = patch_.first_face[polygon]; f < patch_.first_face[polygon + 1]; ++f) {
            for (const auto h : mesh_.fh_range(PatchMesh::FaceHandle(f))) {
                if (patch_.diagonal_halfedge(h.idx()) || !known_[h.from().idx()]) continue;
                Curve between;
                Halfedge side = h;
                for (; !known_[mesh_.to_vertex_handle(side).idx()]; side = next_side(side))
                    between.push_back(mesh_.to_vertex_handle(side).idx());
                const double begin = value_[h.from().idx()], end = value_[mesh_.to_vertex_handle(side).idx()];
                const double step = (end - begin) / (static_cast<double>(between.size()) + 1.0);
                for (size_t i = 0; i < between.size(); ++i) settle(between[i], begin + step * (static_cast<double>(i) + 1.0));
            }
        }
    }

    Halfedge next_side(Halfedge h) const {
        h = mesh_.next_halfedge_handle(h);
        while (patch_.diagonal_halfedge(h.idx())) h = mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(h));
        return h;
    }

    /// Shared vertices first, then the shorter of the gates that cross each other.
    Profile choose_gates(const Strip& known, const Strip& next) const {
        std::vector<Gate> shared;
        for (int k = 0; k < next.size(); ++k) {
            const int v = next.vertices[k];
            if (known_index_[v] != off_strip) shared.push_back({next.arc[k], value_[v] + next.lap[k], 0.0});
        }
        std::vector<Gate> gates;
        if (kind_ == FlowKind::gates) gates = closest_pairs(known, next);
        if (gates.empty() && next.closed) gates.push_back({start_arc(next, next_index_), 0.0, 0.0});
        std::ranges::stable_sort(gates, {}, &Gate::length);
        Profile profile(shared.empty() ? gates.front() : shared.front(), next.length);
        for (const Gate& gate : shared) profile.insert(gate);
        for (const Gate& gate : gates) profile.offer(gate);
        return profile;
    }

    /// The gates of 4.2.3: pairs of points, one on each strip, each the other's closest. One of them is a vertex, since no two
    /// edges with a flat piece of the band between them are closest in their insides only.
    std::vector<Gate> closest_pairs(const Strip& known, const Strip& next) const {
        std::vector<Gate> gates;
        pair_up(known, next, known_index_, next_index_, [&](int k, const Foot& foot) {
            gates.push_back({foot.arc(next), known.flow_at(k), foot.distance});
        });
        pair_up(next, known, next_index_, known_index_, [&](int k, const Foot& foot) {
            gates.push_back({next.arc_at(k), foot.flow(known), foot.distance});
        });
        return gates;
    }

    /// Visits the vertices k of one strip with the points of the other where a gate leads.
    template <class Visit>
    void pair_up(const Strip& strip, const Strip& other, const std::vector<int>& index, const std::vector<int>& other_index,
                 Visit&& visit) const {
        for (int k = 0; k < strip.size(); ++k) {
            const int v = strip.vertices[k];
            if (index[v] != off_strip && other_index[v] != off_strip) continue;
            const auto [first, last] = opposite_stretch(v, strip.lap[k], other, other_index);
            if (first > last) continue;
            const Foot foot = closest(point(v), other, first, last);
            if (const auto vertex = opposite_vertex(strip, k, other, foot)) {
                visit(k, *vertex);
            } else if (closest(position(other, foot), strip, k, k).place() == k) {
                visit(k, foot);
            }
        }
    }

    /// The vertex nearest to the foot of vertex k, where the two are opposite each other: where both feet together miss their
    /// vertices by less than half an edge. The kinks of two curves of edges push the feet off the vertices, to either side where
    /// the curves are regular; without this, rounding would choose the side.
    std::optional<Foot> opposite_vertex(const Strip& strip, int k, const Strip& other, const Foot& foot) const {
        const Foot vertex{foot.k + (foot.t < 0.5 ? 0 : 1), 0.0, 0.0};
        const Point there = position(other, vertex);
        const double missed = std::abs(foot.place() - vertex.k) + std::abs(closest(there, strip, k, k).place() - k);
        if (missed >= 0.5 - 1e-9) return std::nullopt;
        return Foot{vertex.k, 0.0, (there - point(strip.vertices[k])).norm()};
    }

    Point position(const Strip& strip, const Foot& foot) const {
        return point(strip.vertex(foot.k)) * (1.0 - foot.t) + point(strip.vertex(foot.k + 1)) * foot.t;
    }

    /// The stretch of the other strip that a vertex shares polygons with: where the search for its closest point begins. Empty in
    /// a corner where the polygons see nothing of the other strip: no narrows there.
    std::pair<int, int> opposite_stretch(int vertex, int lap, const Strip& other, const std::vector<int>& index) const {
        std::pair<int, int> stretch{std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
        for (const auto h : mesh_.voh_range(Vertex(vertex))) {
            if (!h.face().is_valid() || !band_.face[h.face().idx()]) continue;
            const int polygon = patch_.polygon[h.face().idx()];
            for (int f = patch_.first_face[polygon]; f < patch_.first_face[polygon + 1]; ++f) {
                for (const auto corner : mesh_.fh_range(PatchMesh::FaceHandle(f))) {
                    const int k = index[corner.from().idx()];
                    if (k == off_strip) continue;
                    const int there = k + (lap + cut_.behind[corner.idx()] - cut_.behind[h.idx()]) * other.size();
                    stretch = {std::min(stretch.first, there), std::max(stretch.second, there)};
                }
            }
        }
        return stretch;
    }

    /// The point of a strip closest to x, on a stretch of it or near by. What is closer than a point of the stretch at distance d
    /// is at most 2 d from it; going no further along the strip keeps the search from jumping over folds.
    Foot closest(const Point& x, const Strip& strip, int first, int last) const {
        Foot best{first, 0.0, (x - point(strip.vertex(first))).norm()};
        const auto try_edge = [&](int k) {
            const Point a = point(strip.vertex(k)), side = point(strip.vertex(k + 1)) - a;
            const double square = side.sqrnorm();
            const double t = square > 0.0 ? std::clamp(((x - a) | side) / square, 0.0, 1.0) : 0.0;
            const double distance = (x - a - side * t).norm();
            if (distance < same_length * best.distance) best = {k, t, distance};
        };
        for (int k = first; k < last; ++k) try_edge(k);
        const double reach = 2.0 * best.distance;
        const int end = strip.closed ? first + strip.size() : strip.size() - 1, begin = strip.closed ? last - strip.size() : 0;
        for (int k = last; k < end && strip.arc_at(k) - strip.arc_at(last) < reach; ++k) try_edge(k);
        for (int k = first - 1; k >= begin && strip.arc_at(first) - strip.arc_at(k + 1) < reach; --k) try_edge(k);
        return best;
    }
};

}  // namespace

Flow strip_flow(const Patch& patch, const Band& band, FlowKind kind, const std::vector<double>& fixed) {
    return StripFlow(patch, band, kind, fixed).run();
}

}  // namespace mrc
