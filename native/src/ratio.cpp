// SPDX-License-Identifier: GPL-3.0-or-later
#include "ratio.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mrc {

double Objective::value(double F, double L) const { return F / (scale * L) + bias * std::max(L, floor); }

// h(L) = scale L (value - bias max(L, floor))
double Objective::slope(double value, double L) const { return scale * (value - bias * (L > floor ? 2.0 * L : floor)); }

double Objective::peak(double value, double lambda) const {
    const double beyond = 0.5 * (scale * value - lambda) / (scale * bias);  // where the parabola has slope lambda
    return std::max(beyond, floor);
}

double Objective::threshold(double value, double lambda) const {
    if (bias == 0.0) return scale * value > lambda ? std::numeric_limits<double>::infinity() : 0.0;
    const double L = peak(value, lambda);
    return std::max(0.0, scale * L * (value - bias * L) - lambda * L);
}

double Objective::least_on_line(double lambda, double height, double shortest) const {
    double L = shortest;
    if (height > 0.0) L = std::max({L, floor, std::sqrt(height / (scale * bias))});
    return value(lambda * L + height, L);
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_laps = 4;  // without a better path: where a few more potentials do not help, halving the set does

/// One relaxation: the least f - lambda g from a set of sources to every node.
struct Pass {
    double lambda = 0.0;
    std::vector<double> value;
    std::vector<int> last_arc;  // -1 at a source
    std::vector<int> origin;    // the source it came from
};

class Search {
  public:
    Search(const WeightedGraph& graph, const RatioOptions& options)
        : graph_(graph), objective_(options.objective), most_labels_(options.most_labels), beat_(options.beat) {
        start_.assign(graph.node_count(), -1);
        same_node_.assign(graph.sources.size(), -1);
        potential_.assign(graph.sources.size(), 0.0);
        counted_ = std::ranges::all_of(graph.g, [](double g) { return g == 1.0; });
        const Terminal guess = options.guess.value_or(Terminal{-1, 0.0, 1.0});
        lambda_ = objective_.slope(objective_.value(guess.f, guess.g), guess.g);
    }

    RatioResult run() {
        std::vector<int> all(graph_.sources.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
        std::vector<std::vector<int>> open;
        if (!all.empty() && !graph_.destinations.empty()) open.push_back(std::move(all));
        while (!open.empty()) {
            split(descend(take_last(open)), open);
        }
        // Only now, with the best of all pairs' own paths, what is left: most of it is decided by that.
        std::ranges::sort(hulls_);
        search_above_hulls();
        result_.lower_bound = std::min(result_.objective, unresolved_);
        return std::move(result_);
    }

  private:
    const WeightedGraph& graph_;
    const Objective objective_;
    const int most_labels_;
    const Beat& beat_;
    std::vector<int> start_;         // of each node, a source there of the set at work
    std::vector<int> same_node_;     // of each source of that set, another one on its node: above the hull each counts
    std::vector<double> potential_;  // of each pair
    Pass pass_;
    double lambda_;
    std::vector<int> hulls_;        // the pairs whose hull is known at some lambda but whose optimum may lie above it
    bool counted_;                  // every arc has length 1, so that L is a count (appendix A)
    double unresolved_ = infinity;  // least bound of the pairs given up
    RatioResult result_;

    /// What a pair's F - lambda L must be below to matter.
    double threshold(double lambda) const { return result_.found ? objective_.threshold(result_.objective, lambda) : infinity; }

    static std::vector<int> take_last(std::vector<std::vector<int>>& sets) {
        std::vector<int> set = std::move(sets.back());
        sets.pop_back();
        return set;
    }

    /// In halves; a single pair, by itself, is bounded more tightly than among others.
    static void split(std::vector<int> set, std::vector<std::vector<int>>& sets) {
        if (set.size() <= 1) {
            if (!set.empty()) sets.push_back(std::move(set));
            return;
        }
        const auto middle = set.begin() + static_cast<std::ptrdiff_t>(set.size() / 2);
        sets.emplace_back(middle, set.end());
        sets.emplace_back(set.begin(), middle);
    }

    /// Improves the best as long as the set shows a better path of one of its own pairs, and potentials as long as that may rule out
    /// pairs; gives the pairs still undecided.
    std::vector<int> descend(std::vector<int> set) {
        if (set.size() == 1) potential_[set[0]] = 0.0;
        for (int laps = 0;;) {
            relax(set, lambda_);
            std::vector<int> undecided;
            const bool improved = collect(set, undecided);
            laps = improved ? 0 : laps + 1;
            if (undecided.empty() || (!improved && (laps >= most_laps || !lower_potentials(undecided)))) return undecided;
            set = std::move(undecided);
        }
    }

    /// What goes from one pair's source to another pair's destination bounds both, though neither may go there. A potential, added
    /// at a pair's source and taken off at its destination, leaves the pair's own paths as they are and moves those between pairs.
    /// Potentials under which no path at all undercuts the threshold are shortest distances where each lap costs the threshold less,
    /// by Bellman and Ford: a source starts where the last lap left its destination. They exist where no closed walk of several laps
    /// is too cheap; such a walk crosses itself, and laps that exchange their ends where they cross are contours of their own.
    /// At the lambda of no path, which may be any, potentials would grow until the paths' own sums are lost in their rounding.
    bool lower_potentials(const std::vector<int>& set) {
        if (!graph_.matched || set.size() == 1 || !result_.found) return false;
        const double least = threshold(pass_.lambda);
        bool lowered = false;
        for (const int i : set) {
            const double change = bound_at(pass_, i) - least;
            if (change >= 0.0) continue;
            potential_[i] += change;
            lowered = true;
        }
        return lowered;
    }

    double bound_at(const Pass& pass, int destination) const {
        const Terminal& end = graph_.destinations[destination];
        const double potential = graph_.matched ? potential_[destination] : 0.0;
        return pass.value[end.node] + (end.f - pass.lambda * end.g) - potential;
    }

    /// Rounding may leave a bound below its threshold by a hair.
    static bool beats(double bound, double threshold) {
        return threshold == infinity ? bound < infinity : bound < threshold - 1e-14 * (1.0 + std::abs(threshold));
    }

    /// Whether the last pass's path to a destination starts where it should: then its bound is a path of the pair.
    bool own(int destination) const {
        return !graph_.matched || pass_.origin[graph_.destinations[destination].node] == destination;
    }

    /// Keeps the pairs whose bound is below the threshold, and takes the best path among those that end where they began.
    bool collect(const std::vector<int>& set, std::vector<int>& undecided) {
        const double before = threshold(pass_.lambda);
        bool improved = false, open = false;
        const auto consider = [&](int destination) {
            const double bound = bound_at(pass_, destination);
            if (bound == infinity || !beats(bound, before)) return false;
            improved |= own(destination) && take(graph_.destinations[destination]);
            // For the plain ratio a pair's own path at this lambda decides it, unless lambda has fallen since.
            return !own(destination) || improved || objective_.bias > 0.0;
        };
        if (graph_.matched) {
            for (const int i : set) {
                if (consider(i)) undecided.push_back(i);
            }
        } else {
            for (std::size_t i = 0; i < graph_.destinations.size(); ++i) open |= consider(static_cast<int>(i));
            if (open) undecided = set;
        }
        if (!improved && objective_.bias > 0.0) {
            const auto exact = std::ranges::stable_partition(undecided, [&](int i) { return !own(i); });
            hulls_.insert(hulls_.end(), exact.begin(), exact.end());
            undecided.erase(exact.begin(), exact.end());
        }
        return improved;
    }

    /// Reads the path that ends here in the last pass; keeps it where it is the best so far.
    bool take(const Terminal& end) {
        std::vector<int> nodes{end.node};
        double f = end.f, g = end.g;
        for (int a = pass_.last_arc[end.node]; a >= 0; a = pass_.last_arc[nodes.back()]) {
            f += graph_.f[a];
            g += graph_.g[a];
            nodes.push_back(graph_.from[a]);
        }
        const Terminal& source = graph_.sources[pass_.origin[end.node]];
        std::ranges::reverse(nodes);
        return offer(std::move(nodes), f + source.f, g + source.g);
    }

    bool offer(std::vector<int> nodes, double f, double g) {
        const double value = objective_.value(f, g);
        if (result_.found && !(value < result_.objective)) return false;
        result_.found = true;
        result_.nodes = std::move(nodes);
        result_.numerator = f;
        result_.length = g;
        result_.objective = value;
        lambda_ = objective_.slope(value, g);
        ++result_.steps;
        return true;
    }

    /// One pass in topological order (Bellman and Ford's relaxation is linear there) from a set of sources.
    void relax(const std::vector<int>& set, double lambda) {
        Pass& pass = pass_;
        ++result_.passes;
        if (beat_) beat_();
        pass.lambda = lambda;
        pass.value.resize(graph_.node_count());
        pass.last_arc.resize(graph_.node_count());
        pass.origin.resize(graph_.node_count());
        const auto value = [&](int i) { return graph_.sources[i].f - lambda * graph_.sources[i].g + potential_[i]; };
        for (const int i : set) {
            int& start = start_[graph_.sources[i].node];
            if (start < 0 || value(i) < value(start)) start = i;
        }
        for (int n = 0; n < graph_.node_count(); ++n) relax_node(n, pass, start_[n] >= 0 ? value(start_[n]) : infinity);
        for (const int i : set) start_[graph_.sources[i].node] = -1;
    }

    void relax_node(int n, Pass& pass, double best) const {
        int arc = -1;
        for (int a = graph_.first_arc[n]; a < graph_.first_arc[n + 1]; ++a) {
            const double reached = pass.value[graph_.from[a]] + (graph_.f[a] - pass.lambda * graph_.g[a]);
            if (reached < best) {
                best = reached;
                arc = a;
            }
        }
        pass.value[n] = best;
        pass.last_arc[n] = arc;
        pass.origin[n] = arc >= 0 ? pass.origin[graph_.from[arc]] : start_[n];
    }

    // ---- above the lower hull: only where there is a bias ----

    std::vector<int> ends_of(const std::vector<int>& set) const {
        if (graph_.matched) return set;
        std::vector<int> all(graph_.destinations.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
        return all;
    }

    /// Decides the pairs whose hulls are known: more lambdas cut off what they can of the lens between hull and best, of a set of
    /// pairs at once and then of its halves; what stays open of a single pair is searched by labels.
    void search_above_hulls() {
        std::vector<std::vector<int>> open;
        if (!hulls_.empty()) open.push_back(hulls_);
        while (!open.empty()) {
            const std::vector<int> set = take_last(open);
            const bool last = set.size() == 1 || !graph_.matched;
            if (last) potential_[set[0]] = 0.0;
            std::vector<Pass> passes;
            std::vector<int> ends = narrow(set, last ? 4 : 1, passes);
            if (last) {
                search_lens(set, ends, passes);
            } else {
                split(std::move(ends), open);
            }
        }
    }

    /// Passes at the slope of the best and at so many lambdas on either side, until none leaves a lens open; gives the destinations
    /// of those that it leaves.
    std::vector<int> narrow(const std::vector<int>& set, int sides, std::vector<Pass>& passes) {
        std::vector<int> ends = ends_of(set);
        const auto cut = [&](double step) {
            relax(graph_.matched ? ends : set, lambda_ + step * lens_slope());
            for (const int end : ends) {
                if (own(end) && bound_at(pass_, end) < infinity) take(graph_.destinations[end]);
            }
            passes.push_back(std::move(pass_));
            std::erase_if(ends, [&](int end) { return !is_open(passes, end); });
        };
        cut(0.0);
        double step = sides == 1 ? 1.0 : 0.5;
        for (int i = 0; i < 2 * sides && !ends.empty(); ++i) {
            cut(i % 2 == 0 ? -step : step);
            if (i % 2 == 1) step *= 2.0;
        }
        return ends;
    }

    void search_lens(const std::vector<int>& set, const std::vector<int>& ends, const std::vector<Pass>& passes) {
        for (const int i : set) same_node_[i] = std::exchange(start_[graph_.sources[i].node], i);
        for (const int end : ends) counted_ ? search_counts(passes, end) : search_labels(passes, end);
        for (const int i : set) start_[graph_.sources[i].node] = -1;
    }

    /// How fast the slope of h changes over the length of the best.
    double lens_slope() const {
        return 2.0 * objective_.scale * objective_.bias * std::max(result_.length, objective_.floor) * 0.1;
    }

    struct Line {
        double slope, height;
    };
    mutable std::vector<Line> lines_;  // scratch of one label
    // What decided the last lenses is tried first: a path's lens is much like that of the path that it continues.
    mutable std::size_t closing_ = 0;   // the pass that closed one
    mutable double open_length_ = 0.0;  // where one was open

    struct Label {
        int node, arc, before;  // the path goes on through `arc` and then as label `before` does
        int steps;              // how often the best had improved when the path was found worth while
        double f, g;
    };

    /// Walks back from a destination over all partial paths that every pass's bound allows to beat the best.
    void search_labels(const std::vector<Pass>& passes, int destination) {
        const Terminal& end = graph_.destinations[destination];
        std::vector<Label> labels{{end.node, -1, -1, result_.steps, end.f, end.g}};
        std::vector<int> stack{0};
        if (!worth_while(passes, labels[0])) return;
        const int most = most_labels_ - result_.labels;
        while (!stack.empty()) {
            const int index = stack.back();
            stack.pop_back();
            const Label label = labels[index];
            if (beat_ && index % 256 == 0) beat_();
            if (label.steps != result_.steps && !worth_while(passes, label)) continue;
            if (start_[label.node] >= 0) finish_label(labels, index);
            for (int a = graph_.first_arc[label.node]; a < graph_.first_arc[label.node + 1]; ++a) {
                const Label next{graph_.from[a], a, index, result_.steps, label.f + graph_.f[a], label.g + graph_.g[a]};
                if (!worth_while(passes, next)) continue;
                if (static_cast<int>(labels.size()) >= most) return give_up(passes, destination);
                stack.push_back(static_cast<int>(labels.size()));
                labels.push_back(next);
            }
        }
        result_.labels += static_cast<int>(labels.size());
    }

    /// The same where lengths are counts: of the partial paths from a node with the same count only the best matters, which is Karp's
    /// recurrence (A.3), kept to what the passes allow.
    void search_counts(const std::vector<Pass>& passes, int destination) {
        const Terminal& end = graph_.destinations[destination];
        std::vector<Label> labels{{end.node, -1, -1, result_.steps, end.f, end.g}};
        std::vector<std::vector<Count>> at(graph_.node_count());
        at[end.node].push_back({end.g, 0});
        for (int n = end.node; n >= 0; --n) {
            if (beat_) beat_();
            for (const Count& count : at[n]) {
                const Label label = labels[count.label];
                if (!worth_while(passes, label)) continue;
                if (start_[n] >= 0) finish_label(labels, count.label);
                for (int a = graph_.first_arc[n]; a < graph_.first_arc[n + 1]; ++a) {
                    keep_best({graph_.from[a], a, count.label, result_.steps, label.f + graph_.f[a], label.g + graph_.g[a]}, labels,
                              at[graph_.from[a]]);
                }
            }
        }
        result_.labels += static_cast<int>(labels.size());
    }

    struct Count {
        double g;
        int label;
    };

    static void keep_best(const Label& label, std::vector<Label>& labels, std::vector<Count>& here) {
        const auto same = std::ranges::lower_bound(here, label.g, {}, &Count::g);
        if (same == here.end() || same->g != label.g) {
            here.insert(same, {label.g, static_cast<int>(labels.size())});
            labels.push_back(label);
        } else if (label.f < labels[same->label].f) {
            labels[same->label] = label;
        }
    }

    /// True where some path on from here may beat the best: where a part of h lies above all passes' lines.
    bool worth_while(const std::vector<Pass>& passes, const Label& label) const {
        return is_open(passes, [&](const Pass& pass) { return pass.value[label.node] + (label.f - pass.lambda * label.g); });
    }

    /// The same for all paths of a pair.
    bool is_open(const std::vector<Pass>& passes, int destination) const {
        return is_open(passes, [&](const Pass& pass) { return bound_at(pass, destination); });
    }

    template <class Bound>
    bool is_open(const std::vector<Pass>& passes, Bound&& bound_of) const {
        const auto closes = [&](const Pass& pass, double bound) { return !beats(bound, threshold(pass.lambda)); };
        if (closing_ < passes.size() && closes(passes[closing_], bound_of(passes[closing_]))) return false;
        lines_.resize(passes.size());
        for (std::size_t i = 0; i < passes.size(); ++i) {
            lines_[i] = {passes[i].lambda, bound_of(passes[i])};
            if (closes(passes[i], lines_[i].height)) {
                closing_ = i;
                return false;
            }
        }
        return lens_is_open();
    }

    /// The lens between h and the lines, which is convex, is open where it is at the peak above a line or where two lines meet.
    bool lens_is_open() const {
        if (!result_.found) return true;
        // At the origin, which no path reaches, h is 0; the best may have improved so far since the passes that no peak is beyond it.
        if (std::ranges::all_of(lines_, [](const Line& line) { return line.height < 0.0; })) return true;
        const auto open_at = [&](double L) {
            const double h = objective_.scale * L * (result_.objective - objective_.bias * std::max(L, objective_.floor));
            const bool open =
                L > 0.0 && std::ranges::all_of(lines_, [&](const Line& line) { return line.slope * L + line.height < h; });
            if (open) open_length_ = L;
            return open;
        };
        if (open_at(open_length_)) return true;
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (open_at(objective_.peak(result_.objective, lines_[i].slope))) return true;
            for (std::size_t j = 0; j < i; ++j) {
                if (open_at((lines_[i].height - lines_[j].height) / (lines_[j].slope - lines_[i].slope))) return true;
            }
        }
        return objective_.floor > 0.0 && open_at(objective_.floor);
    }

    void finish_label(const std::vector<Label>& labels, int index) {
        const Label& label = labels[index];
        std::vector<int> nodes;
        for (int i = index; i >= 0; i = labels[i].before) nodes.push_back(labels[i].node);
        for (int i = start_[label.node]; i >= 0; i = same_node_[i])
            offer(nodes, label.f + graph_.sources[i].f, label.g + graph_.sources[i].g);
    }

    /// The pair stays open: its bound is the best that a path on the passes' lines, no shorter than the shortest, could reach.
    void give_up(const std::vector<Pass>& passes, int destination) {
        result_.labels = most_labels_;
        const double shortest = shortest_length(destination);
        double bound = -infinity;
        for (const Pass& pass : passes)
            bound = std::max(bound, objective_.least_on_line(pass.lambda, bound_at(pass, destination), shortest));
        unresolved_ = std::min(unresolved_, bound);
    }

    /// The least sum of g from the sources that are set to a destination.
    double shortest_length(int destination) const {
        std::vector<double> length(graph_.node_count(), infinity);
        for (int n = 0; n < graph_.node_count(); ++n) {
            for (int i = start_[n]; i >= 0; i = same_node_[i]) length[n] = std::min(length[n], graph_.sources[i].g);
            for (int a = graph_.first_arc[n]; a < graph_.first_arc[n + 1]; ++a)
                length[n] = std::min(length[n], length[graph_.from[a]] + graph_.g[a]);
        }
        return length[graph_.destinations[destination].node] + graph_.destinations[destination].g;
    }
};

}  // namespace

RatioResult minimum_ratio(const WeightedGraph& graph, const RatioOptions& options) { return Search(graph, options).run(); }

}  // namespace mrc
