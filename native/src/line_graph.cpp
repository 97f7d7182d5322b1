// SPDX-License-Identifier: GPL-3.0-or-later
#include "line_graph.h"

#include <numeric>
#include <utility>

namespace mrc {
namespace {

/// A chord that ends in the current point, with what its arcs have in common.
struct Arrival {
    ChordEnd end;
    double enclosed;  // half of what it adds to the region term
    int node, tail;
    int triangle;  // that it lies inside, or -2
    int after;     // the place in the given contour that comes next, or -2
    Climb climb;
    bool crosses;
};

class Joiner {
  public:
    Joiner(const Surface& surface, const Chords& chords, const Energy& energy, const EdgeForm* region, const Beat& beat)
        : chords_(chords), energy_(energy), region_(region), beat_(beat) {
        positions_.reserve(chords.points.size());
        frames_.reserve(chords.points.size());
        for (const GraphPoint& p : chords.points) {
            if (beat_ && frames_.size() % 1024 == 0) beat_();
            positions_.push_back(surface.position(p.place));
            frames_.push_back(energy.frame(p.place));
        }
        sort_arriving();
    }

    WeightedGraph join() {
        graph_.first_arc.reserve(count() + chords_.crossing + 1);
        graph_.first_arc.assign(chords_.crossing + 1, 0);
        reserve();
        for (int out = 0; out < count(); ++out) {
            if (beat_ && out % 1024 == 0) beat_();
            if (chords_.chords[out].tail != point_) gather(chords_.chords[out].tail);
            add_arcs(out);
            graph_.first_arc.push_back(graph_.arc_count());
        }
        return std::move(graph_);
    }

  private:
    const Chords& chords_;
    const Energy& energy_;
    const EdgeForm* region_;
    const Beat& beat_;
    WeightedGraph graph_;
    std::vector<Vec3> positions_;  // of the points
    std::vector<Frame> frames_;
    std::vector<int> first_arriving_, arriving_;  // the chords that end in each point, ascending
    int point_ = -1;                              // the current point, where arcs are
    std::vector<Arrival> arrivals_;
    std::vector<int> from_;  // scratch: the arcs into one chord
    std::vector<double> f_, g_;

    int count() const { return static_cast<int>(chords_.chords.size()); }
    int plain() const { return count() - chords_.crossing; }
    int node_after(int chord) const { return chord < plain() ? chords_.crossing + chord : chord - plain(); }

    void sort_arriving() {
        first_arriving_.assign(chords_.points.size() + 1, 0);
        for (const Chord& c : chords_.chords) ++first_arriving_[c.head + 1];
        std::partial_sum(first_arriving_.begin(), first_arriving_.end(), first_arriving_.begin());
        arriving_.resize(chords_.chords.size());
        std::vector<int> next(first_arriving_.begin(), first_arriving_.end() - 1);
        for (int c = 0; c < count(); ++c) arriving_[next[chords_.chords[c].head]++] = c;
    }

    /// Room for an arc between all pairs of chords that meet: about half of them are pruned, but no arc is ever moved.
    void reserve() {
        std::size_t pairs = 0;
        for (const Chord& c : chords_.chords) pairs += first_arriving_[c.tail + 1] - first_arriving_[c.tail];
        graph_.from.reserve(pairs);
        graph_.f.reserve(pairs);
        graph_.g.reserve(pairs);
    }

    ChordEnd end_of(int chord) const {
        const Chord& c = chords_.chords[chord];
        const double crease = energy_.crease_cost(chords_.sites[chord].halfedge);
        return energy_.chord_end(frames_[point_], positions_[c.head] - positions_[c.tail], crease);
    }

    double enclosed(const Chord& c) const {
        if (!region_) return 0.0;
        return 0.5 * energy_.region_factor() * region_->along(chords_.points[c.tail].place, chords_.points[c.head].place);
    }

    void gather(int point) {
        point_ = point;
        arrivals_.clear();
        for (int i = first_arriving_[point]; i < first_arriving_[point + 1]; ++i) arrivals_.push_back(arrival(arriving_[i]));
        from_.resize(arrivals_.size());
        f_.resize(arrivals_.size());
        g_.resize(arrivals_.size());
    }

    Arrival arrival(int chord) const {
        const Chord& c = chords_.chords[chord];
        const ChordSite& site = chords_.sites[chord];
        const int after = site.given < 0 ? -2 : (site.given + 1) % chords_.given_count;
        return {end_of(chord), enclosed(c), node_after(chord), c.tail, site.triangle < 0 ? -2 : site.triangle,
                after,         site.climb,  chord >= plain()};
    }

    /// Which pairs join is as good as random, so that no branch depends on it: every arc is written, and kept or written over.
    void add_arcs(int out) {
        if (arrivals_.empty()) return;
        const Chord c = chords_.chords[out];
        const ChordSite site = chords_.sites[out];
        const ArcWeights weights = energy_.weights(frames_[point_]);
        const ChordEnd start = end_of(out);
        const double enclosed_out = enclosed(c);
        const bool crosses = out >= plain(), required = !chords_.required_elements.empty();
        int* from = from_.data();
        double *f = f_.data(), *g = g_.data();
        for (const Arrival& in : arrivals_) {
            *from = in.node;
            *f = weights.numerator(in.end, start) + in.enclosed + enclosed_out;
            *g = weights.denominator(in.end, start);
            const bool returns = (in.tail == c.head) | (in.crosses & crosses);
            const bool follows = joins(in, site, weights.turns_too_much(in.end, start));
            const std::ptrdiff_t kept = (!returns) & follows & (!required || allowed(sign(in.climb), sign(site.climb)));
            from += kept, f += kept, g += kept;
        }
        graph_.from.insert(graph_.from.end(), from_.data(), from);
        graph_.f.insert(graph_.f.end(), f_.data(), f);
        graph_.g.insert(graph_.g.end(), g_.data(), g);
    }

    static bool joins(const Arrival& in, const ChordSite& out, bool turns_too_much) {
        // A contour passes a level by one monotone chain: it does not rise and fall.
        const bool folds = (static_cast<int>(in.climb) & static_cast<int>(out.climb)) == 0;
        // Two chords inside one triangle are never better than one (3.2).
        const bool pruned = (in.triangle == out.triangle) | turns_too_much;
        const bool given = in.after == out.given;
        return (!folds) & (given | (!pruned));
    }

    bool allowed(int climb_in, int climb_out) const {
        const GraphPoint& p = chords_.points[point_];
        return chords_.required_elements.allows_arc({p.level, p.rank, point_}, climb_in, climb_out);
    }
};

}  // namespace

WeightedGraph make_line_graph(const Surface& surface, const Chords& chords, const Energy& energy, const EdgeForm* region,
                              const Beat& beat) {
    return Joiner(surface, chords, energy, region, beat).join();
}

}  // namespace mrc
