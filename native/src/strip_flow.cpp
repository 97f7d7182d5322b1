// SPDX-License-Identifier: GPL-3.0-or-later
#include "strip_flow.h"

#include "segments.h"
#include "start_line.h"
#include "strip.h"
#include "strip_gates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mrc {
namespace {

constexpr double least_slope = 0.01;  // of the flow between two gates, in the strip's mean slope
constexpr double least_edge = 1e-3;   // arc length of an edge, in the strip's mean edge: zero-length edges rise too

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

/// Carries the flow from the contour outwards, strip by strip.
class StripFlow {
  public:
    StripFlow(const Patch& patch, const Band& band, FlowKind kind, const std::vector<double>& fixed, const Beat& beat)
        : patch_(patch),
          mesh_(patch.mesh),
          band_(band),
          kind_(kind),
          fixed_(fixed),
          beat_(beat),
          strips_(strip_boundaries(patch, band)),
          opened_(cut_open(patch, band, strips_)),
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
        return {std::move(value_), opened_.jump};
    }

  private:
    const Patch& patch_;
    const PatchMesh& mesh_;
    const Band& band_;
    const FlowKind kind_;
    const std::vector<double>& fixed_;  // of each vertex: 0 or 1 at the ends of an open curve, below 0 elsewhere
    const Beat& beat_;
    const std::vector<Curve> strips_;
    const OpenedBand opened_;
    std::vector<double> value_;
    std::vector<char> known_;  // of each vertex: true where `value_` is settled
    // Of each vertex: its place on the known and on the next strip, as seen in the band cut open, or `off_strip`.
    std::vector<int> known_index_, next_index_;

    void settle(int vertex, double value) {
        value_[vertex] = value;
        known_[vertex] = 1;
    }

    Strip unroll(const Curve& curve) const {
        Strip strip{curve, {0}, {0.0}, {}, 0.0, patch_.closed};
        std::vector<Halfedge> edges;
        for (const auto& [a, b] : segments(curve, strip.closed)) edges.push_back(patch_.find_halfedge(a, b));
        const auto [first, last] = strip.closed ? std::pair<size_t, size_t>(0, edges.size()) : rising_stretch(curve);
        double total = 0.0;
        for (size_t i = first; i < last; ++i) total += mesh_.calc_edge_length(edges[i]);
        const double least = total > 0.0 ? least_edge * total / static_cast<double>(last - first) : 1.0;
        for (size_t i = 0; i < edges.size(); ++i) {
            const bool rises = first <= i && i < last;
            strip.lap.push_back(strip.lap.back() + opened_.jump[edges[i].idx()]);
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
        const auto first = std::find_if(opened_.line.begin(), opened_.line.end(), [&](int v) { return index[v] != off_strip; });
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
            if (beat_) beat_();
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
                for (; !known_[mesh_.to_vertex_handle(side).idx()]; side = patch_.next_side(side))
                    between.push_back(mesh_.to_vertex_handle(side).idx());
                const double begin = value_[h.from().idx()], end = value_[mesh_.to_vertex_handle(side).idx()];
                const double step = (end - begin) / (static_cast<double>(between.size()) + 1.0);
                for (size_t i = 0; i < between.size(); ++i) settle(between[i], begin + step * (static_cast<double>(i) + 1.0));
            }
        }
    }

    /// Shared vertices first, then the shorter of the gates that cross each other.
    Profile choose_gates(const Strip& known, const Strip& next) const {
        std::vector<Gate> shared;
        for (int k = 0; k < next.size(); ++k) {
            const int v = next.vertices[k];
            if (known_index_[v] != off_strip) shared.push_back({next.arc[k], value_[v] + next.lap[k], 0.0});
        }
        std::vector<Gate> gates;
        if (kind_ == FlowKind::gates) gates = find_gates(patch_, band_, opened_, {known, known_index_}, {next, next_index_});
        if (gates.empty() && next.closed) gates.push_back({start_arc(next, next_index_), 0.0, 0.0});
        std::ranges::stable_sort(gates, {}, &Gate::length);
        Profile profile(shared.empty() ? gates.front() : shared.front(), next.length);
        for (const Gate& gate : shared) profile.insert(gate);
        for (const Gate& gate : gates) profile.offer(gate);
        return profile;
    }
};

}  // namespace

Flow strip_flow(const Patch& patch, const Band& band, FlowKind kind, const std::vector<double>& fixed, const Beat& beat) {
    return StripFlow(patch, band, kind, fixed, beat).run();
}

}  // namespace mrc
