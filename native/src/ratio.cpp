// SPDX-License-Identifier: GPL-3.0-or-later
#include "ratio.h"

#include "incumbent.h"
#include "label_search.h"
#include "lens.h"
#include "relaxation.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace mrc {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_laps = 4;  // without a better path: where a few more potentials do not help, halving the set does

std::vector<int> first_numbers(std::size_t count) {
    std::vector<int> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

/// The sets of sources that are still to be decided, the last first.
class OpenSets {
  public:
    bool empty() const { return sets_.empty(); }

    void add(std::vector<int> set) {
        if (!set.empty()) sets_.push_back(std::move(set));
    }

    /// In halves; a single pair, by itself, is bounded more tightly than among others.
    void add_split(std::vector<int> set) {
        if (set.size() <= 1) return add(std::move(set));
        const auto middle = set.begin() + static_cast<std::ptrdiff_t>(set.size() / 2);
        sets_.emplace_back(middle, set.end());
        sets_.emplace_back(set.begin(), middle);
    }

    std::vector<int> take_last() {
        std::vector<int> set = std::move(sets_.back());
        sets_.pop_back();
        return set;
    }

  private:
    std::vector<std::vector<int>> sets_;
};

/// Branch and bound over the set of sources, by passes from all sources of a set at once. It decides every pair of source and
/// destination, but for those whose optimum may lie above their lower hull.
class BranchAndBound {
  public:
    BranchAndBound(const WeightedGraph& graph, Incumbent& incumbent, Relaxation& relaxation)
        : graph_(graph), biased_(incumbent.objective().bias > 0.0), incumbent_(incumbent), relaxation_(relaxation) {}

    /// Gives the pairs whose hull is known at some lambda but whose optimum may lie above it, ascending: none without a bias.
    std::vector<int> run() {
        OpenSets open;
        if (!graph_.destinations.empty()) open.add(first_numbers(graph_.sources.size()));
        while (!open.empty()) open.add_split(descend(open.take_last()));
        std::ranges::sort(hulls_);
        return std::move(hulls_);
    }

  private:
    const WeightedGraph& graph_;
    const bool biased_;
    Incumbent& incumbent_;
    Relaxation& relaxation_;
    std::vector<int> hulls_;

    /// Improves the best as long as the set shows a better path of one of its own pairs, and potentials as long as that may rule
    /// out pairs; gives the pairs still undecided.
    std::vector<int> descend(std::vector<int> set) {
        if (set.size() == 1) relaxation_.clear_potential(set[0]);
        for (int laps = 0;;) {
            relaxation_.run(set, incumbent_.lambda());
            std::vector<int> undecided;
            const bool improved = collect(set, undecided);
            laps = improved ? 0 : laps + 1;
            if (undecided.empty() || (!improved && (laps >= most_laps || !lower_potentials(undecided)))) return undecided;
            set = std::move(undecided);
        }
    }

    /// At the lambda of no path, which may be any, potentials would grow until the paths' own sums are lost in their rounding.
    bool lower_potentials(const std::vector<int>& set) {
        if (!graph_.matched || set.size() == 1 || !incumbent_.found()) return false;
        return relaxation_.lower_potentials(set, incumbent_.threshold(relaxation_.last().lambda));
    }

    /// Keeps the pairs whose bound is below the threshold, and takes the best path among those that end where they began.
    bool collect(const std::vector<int>& set, std::vector<int>& undecided) {
        const double before = incumbent_.threshold(relaxation_.last().lambda);
        bool improved = false;
        if (graph_.matched) {
            for (const int i : set) {
                if (consider(i, before, improved)) undecided.push_back(i);
            }
        } else {
            bool open = false;
            for (std::size_t i = 0; i < graph_.destinations.size(); ++i) open |= consider(static_cast<int>(i), before, improved);
            if (open) undecided = set;
        }
        if (!improved && biased_) set_hulls_apart(undecided);
        return improved;
    }

    /// True where the pair of a destination may still beat the best.
    bool consider(int destination, double threshold, bool& improved) {
        const double bound = relaxation_.bound(relaxation_.last(), destination);
        if (bound == infinity || !Incumbent::beats(bound, threshold)) return false;
        const bool own = relaxation_.own(destination);
        improved |= own && incumbent_.offer(relaxation_.path_to(destination));
        // For the plain ratio a pair's own path at this lambda decides it, unless lambda has fallen since.
        return !own || improved || biased_;
    }

    void set_hulls_apart(std::vector<int>& undecided) {
        const auto exact = std::ranges::stable_partition(undecided, [&](int i) { return !relaxation_.own(i); });
        hulls_.insert(hulls_.end(), exact.begin(), exact.end());
        undecided.erase(exact.begin(), exact.end());
    }
};

/// Decides the pairs whose optimum may lie above their lower hull: more lambdas cut off what they can of the lens between hull
/// and best, of a set of pairs at once and then of its halves; what stays open of a single pair is searched by labels.
class HullSweep {
  public:
    HullSweep(const WeightedGraph& graph, const RatioOptions& options, Incumbent& incumbent, Relaxation& relaxation)
        : graph_(graph),
          incumbent_(incumbent),
          relaxation_(relaxation),
          lens_(incumbent),
          label_search_(graph, options, incumbent, lens_) {}

    void run(const std::vector<int>& pairs) {
        OpenSets open;
        open.add(pairs);
        while (!open.empty()) {
            const std::vector<int> set = open.take_last();
            const bool last = set.size() == 1 || !graph_.matched;
            if (last) relaxation_.clear_potential(set[0]);
            std::vector<Pass> passes;
            std::vector<int> ends = narrow(set, last ? 4 : 1, passes);
            if (last) {
                label_search_.run(set, ends, passes);
            } else {
                open.add_split(std::move(ends));
            }
        }
    }

    const LabelSearch& label_search() const { return label_search_; }

  private:
    const WeightedGraph& graph_;
    Incumbent& incumbent_;
    Relaxation& relaxation_;
    Lens lens_;
    LabelSearch label_search_;

    /// Passes at the slope of the best and at so many lambdas on either side, until none leaves a lens open; gives the
    /// destinations of those that it leaves.
    std::vector<int> narrow(const std::vector<int>& set, int sides, std::vector<Pass>& passes) {
        std::vector<int> ends = graph_.matched ? set : first_numbers(graph_.destinations.size());
        cut(set, 0.0, ends, passes);
        double step = sides == 1 ? 1.0 : 0.5;
        for (int i = 0; i < 2 * sides && !ends.empty(); ++i) {
            cut(set, i % 2 == 0 ? -step : step, ends, passes);
            if (i % 2 == 1) step *= 2.0;
        }
        return ends;
    }

    /// A pass at one lambda, so many steps from the slope of the best; drops the ends whose lens it closes.
    void cut(const std::vector<int>& set, double steps, std::vector<int>& ends, std::vector<Pass>& passes) {
        relaxation_.run(graph_.matched ? ends : set, incumbent_.lambda() + steps * lambda_step());
        for (const int end : ends) {
            const bool arrives = relaxation_.own(end) && relaxation_.bound(relaxation_.last(), end) < infinity;
            if (arrives) incumbent_.offer(relaxation_.path_to(end));
        }
        passes.push_back(relaxation_.take_last());
        std::erase_if(ends, [&](int end) { return !lens_.is_open(passes, graph_.destinations[end], relaxation_.potential(end)); });
    }

    /// How far the slope of h changes over a tenth of the length of the best.
    double lambda_step() const {
        const Objective& objective = incumbent_.objective();
        return 2.0 * objective.scale * objective.bias * std::max(incumbent_.path().g, objective.floor) * 0.1;
    }
};

/// The least f / g of an arc.
double least_slope(const WeightedGraph& graph) {
    double least = infinity;
    for (int arc = 0; arc < graph.arc_count(); ++arc) least = std::min(least, graph.f[arc] / graph.g[arc]);
    return least;
}

/// Offers the paths found at slopes below the first one, down to that of a path as long as expected and as good as can be. With a
/// bias the first may be so high that it rewards length: where triangles are long, the search would see nothing but paths to their
/// far ends and back, and none of its pairs' own.
void look_below(const WeightedGraph& graph, const RatioOptions& options, Incumbent& incumbent, Relaxation& relaxation) {
    if (options.objective.bias == 0.0 || !options.guess || graph.arc_count() == 0 || graph.destinations.empty()) return;
    const double first = incumbent.lambda();
    const double last = least_slope(graph) - options.objective.scale * options.objective.bias * options.guess->g;
    for (const double part : {0.5, 1.0}) {
        if (!(last < first)) return;
        relaxation.run(first_numbers(graph.sources.size()), first + part * (last - first));
        for (int i = 0; i < static_cast<int>(graph.destinations.size()); ++i) {
            if (relaxation.bound(relaxation.last(), i) < infinity && relaxation.own(i)) incumbent.offer(relaxation.path_to(i));
        }
    }
}

RatioResult result_of(const Incumbent& incumbent, const Relaxation& relaxation) {
    RatioResult result;
    result.found = incumbent.found();
    result.nodes = incumbent.path().nodes;
    result.numerator = incumbent.path().f;
    result.length = incumbent.path().g;
    result.objective = result.lower_bound = incumbent.value();
    result.passes = relaxation.passes();
    result.steps = incumbent.steps();
    return result;
}

}  // namespace

RatioResult minimum_ratio(const WeightedGraph& graph, const RatioOptions& options) {
    Incumbent incumbent(options);
    Relaxation relaxation(graph, options.beat);
    look_below(graph, options, incumbent, relaxation);
    const std::vector<int> hulls = BranchAndBound(graph, incumbent, relaxation).run();
    if (hulls.empty()) return result_of(incumbent, relaxation);
    // Only now, with the best of all pairs' own paths, what is left: most of it is decided by that.
    HullSweep sweep(graph, options, incumbent, relaxation);
    sweep.run(hulls);
    RatioResult result = result_of(incumbent, relaxation);
    result.labels = sweep.label_search().labels();
    result.lower_bound = std::min(result.objective, sweep.label_search().unresolved());
    return result;
}

}  // namespace mrc
