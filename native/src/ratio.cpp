// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/ratio.h>

#include <algorithm>
#include <cmath>

namespace mrc {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class Search {
  public:
    Search(const WeightedGraph& graph, const RatioOptions& options)
        : graph_(graph), value_(graph.node_count()), last_arc_(graph.node_count()), origin_(graph.node_count()), lambda_(options.below) {
        start_.assign(graph.node_count(), -1);
        if (lambda_ == infinity) lambda_ = above_all();
    }

    RatioResult run() {
        std::vector<std::vector<int>> open;
        std::vector<int> all(graph_.sources.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
        if (!all.empty() && !graph_.destinations.empty()) open.push_back(std::move(all));
        while (!open.empty()) {
            std::vector<int> set = std::move(open.back());
            open.pop_back();
            set = descend(std::move(set));
            // A pair alone is always decided, so what is split here gets smaller.
            const auto middle = set.begin() + static_cast<std::ptrdiff_t>(set.size() / 2);
            if (middle != set.end()) open.emplace_back(middle, set.end());
            if (middle != set.begin()) open.emplace_back(set.begin(), middle);
        }
        result_.lower_bound = lambda_;
        return std::move(result_);
    }

  private:
    const WeightedGraph& graph_;
    std::vector<double> value_;
    std::vector<int> last_arc_, origin_, start_;
    double lambda_;
    RatioResult result_;

    /// A lambda above every path's ratio: at it, every path is negative.
    double above_all() const {
        double most = 0.0;
        for (int a = 0; a < graph_.arc_count(); ++a) most = std::max(most, graph_.f[a] / graph_.g[a]);
        for (const auto* ends : {&graph_.sources, &graph_.destinations}) {
            for (const Terminal& t : *ends) most = std::max(most, t.g > 0.0 ? t.f / t.g : 0.0);
        }
        return most + 1.0 + std::abs(most);
    }

    double weight(double f, double g) const { return f - lambda_ * g; }

    /// Lowers lambda as long as the set shows a better path of one of its own pairs; gives the pairs that are still undecided.
    std::vector<int> descend(std::vector<int> set) {
        for (;;) {
            relax(set);
            std::vector<int> undecided;
            const bool improved = collect(set, undecided);
            if (undecided.empty() || !improved) return undecided;
            set = std::move(undecided);
        }
    }

    /// Keeps the pairs whose bound is negative, and takes the best path among those that end where they began.
    bool collect(const std::vector<int>& set, std::vector<int>& undecided) {
        bool improved = false;
        const double before = lambda_;
        const auto consider = [&](int destination) {
            const Terminal& end = graph_.destinations[destination];
            if (value_[end.node] == infinity || value_[end.node] + (end.f - before * end.g) >= 0.0) return;
            if (graph_.matched && origin_[end.node] != destination) {
                undecided.push_back(destination);
                return;
            }
            improved |= take(end);
            // The pair may have a better path still at a lower lambda. At the same lambda its own path shows that the bound is
            // negative by rounding alone.
            if (improved) undecided.push_back(destination);
        };
        if (graph_.matched) {
            for (const int i : set) consider(i);
        } else {
            for (std::size_t i = 0; i < graph_.destinations.size(); ++i) consider(static_cast<int>(i));
            undecided = improved ? set : std::vector<int>{};
        }
        return improved;
    }

    /// Reads the path that ends here; keeps it where its ratio is below lambda.
    bool take(const Terminal& end) {
        std::vector<int> nodes{end.node};
        double f = end.f, g = end.g;
        for (int a = last_arc_[end.node]; a >= 0; a = last_arc_[nodes.back()]) {
            f += graph_.f[a];
            g += graph_.g[a];
            nodes.push_back(graph_.from[a]);
        }
        const Terminal& source = graph_.sources[origin_[end.node]];
        f += source.f;
        g += source.g;
        const double ratio = f / g;
        if (!(ratio < lambda_)) return false;
        std::ranges::reverse(nodes);
        result_.nodes = std::move(nodes);
        result_.numerator = f;
        result_.length = g;
        result_.ratio = lambda_ = ratio;
        result_.found = true;
        ++result_.steps;
        return true;
    }

    /// One pass over the graph in topological order (Bellman and Ford's relaxation is linear there) from a set of sources.
    void relax(const std::vector<int>& set) {
        ++result_.passes;
        for (const int i : set) {
            const int node = graph_.sources[i].node;
            if (start_[node] < 0 || source_value(i) < source_value(start_[node])) start_[node] = i;
        }
        for (int n = 0; n < graph_.node_count(); ++n) relax_node(n);
        for (const int i : set) start_[graph_.sources[i].node] = -1;
    }

    double source_value(int source) const { return weight(graph_.sources[source].f, graph_.sources[source].g); }

    void relax_node(int n) {
        double best = infinity;
        int arc = -1, origin = start_[n];
        if (origin >= 0) best = source_value(origin);
        for (int a = graph_.first_arc[n]; a < graph_.first_arc[n + 1]; ++a) {
            const double reached = value_[graph_.from[a]] + weight(graph_.f[a], graph_.g[a]);
            if (reached < best) {
                best = reached;
                arc = a;
            }
        }
        value_[n] = best;
        last_arc_[n] = arc;
        origin_[n] = arc >= 0 ? origin_[graph_.from[arc]] : origin;
    }
};

}  // namespace

RatioResult minimum_ratio(const WeightedGraph& graph, const RatioOptions& options) { return Search(graph, options).run(); }

}  // namespace mrc
