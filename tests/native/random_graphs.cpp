// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_graphs.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mrc_test {
namespace {

using mrc::WeightedGraph;

struct Arc {
    int from, to;
};

/// The graph of these arcs, each from a node to a later one; their weights come afterwards.
WeightedGraph graph_of(int nodes, const std::vector<Arc>& arcs) {
    WeightedGraph graph;
    for (int n = 0; n < nodes; ++n) {
        graph.first_arc.push_back(graph.arc_count());
        for (const Arc& arc : arcs) {
            if (arc.to == n) graph.from.push_back(arc.from);
        }
    }
    graph.first_arc.push_back(graph.arc_count());
    graph.f.resize(graph.from.size());
    graph.g.resize(graph.from.size());
    return graph;
}

class Maker {
  public:
    Maker(const GraphKind& kind, unsigned seed, bool matched) : kind_(kind), seed_(seed), matched_(matched), random_(seed) {}

    WeightedGraph make() {
        graph_ = shape();
        graph_.matched = matched_;
        for (int a = 0; a < graph_.arc_count(); ++a) {
            graph_.f[a] = random_f();
            graph_.g[a] = random_g();
        }
        if (kind_.shape != Shape::layers) set_terminals();
        const bool own = kind_.own_weights || !matched_;
        for (auto* ends : {&graph_.sources, &graph_.destinations}) {
            for (mrc::Terminal& end : *ends) end = own ? mrc::Terminal{end.node, random_f(), random_g()} : mrc::Terminal{end.node};
        }
        return std::move(graph_);
    }

  private:
    const GraphKind& kind_;
    const unsigned seed_;
    const bool matched_;
    std::mt19937 random_;
    WeightedGraph graph_;
    int pairs_ = 0;

    int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

    WeightedGraph shape() {
        pairs_ = 1 + below(5);
        switch (kind_.shape) {
            case Shape::layers:
                return layered_graph(seed_, matched_);
            case Shape::mesh:
                return mesh(0.4, 1, 1);
            case Shape::sparse_mesh:
                return mesh(0.12, 1, 1);
            case Shape::multi_mesh:
                return mesh(0.4, 3, 1);
            case Shape::islands:
                return mesh(0.7, 1, 3);
            case Shape::chains:
                return chains();
            case Shape::stars:
                return stars();
        }
        return {};
    }

    WeightedGraph mesh(double density, int most_parallel, int islands) {
        const int nodes = 2 * pairs_ + below(8);
        std::vector<int> island(nodes);
        for (int& i : island) i = below(islands);
        std::vector<Arc> arcs;
        for (int to = 0; to < nodes; ++to) {
            for (int from = 0; from < to; ++from) {
                if (island[from] != island[to] || between(0.0, 1.0) > density) continue;
                arcs.insert(arcs.end(), 1 + below(most_parallel), Arc{from, to});
            }
        }
        return graph_of(nodes, arcs);
    }

    WeightedGraph chains() {
        const int nodes = pairs_ * (30 + below(40));
        std::vector<Arc> arcs;
        for (int n = pairs_; n < nodes; ++n) arcs.push_back({n - pairs_, n});
        for (int extra = 0; extra < 8; ++extra) {
            const int to = 1 + below(nodes - 1);
            arcs.push_back({below(to), to});
        }
        return graph_of(nodes, arcs);
    }

    WeightedGraph stars() {
        std::vector<Arc> arcs;
        for (int from = 0; from < pairs_; ++from) {
            for (int to = 0; to < pairs_; ++to) {
                if (below(3) > 0) arcs.push_back({from, pairs_ + to});
            }
        }
        return graph_of(2 * pairs_, arcs);
    }

    void set_terminals() {
        const int nodes = graph_.node_count();
        for (int i = 0; i < pairs_; ++i) {
            const bool anywhere = kind_.terminals == Terminals::anywhere;
            const int first = anywhere ? below(nodes) : i, second = anywhere ? below(nodes) : nodes - pairs_ + i;
            graph_.sources.push_back({std::min(first, second)});
            graph_.destinations.push_back({std::max(first, second)});
        }
    }

    double random_f() {
        switch (kind_.weights) {
            case Weights::integer:
                return below(5) - 2.0;
            case Weights::alike:
                return static_cast<int>(seed_ % 3) - 1.0;
            case Weights::one_sign:
                return (static_cast<int>(seed_ % 3) - 1.0) * below(2) * between(0.1, 1.0);
            default:
                return between(-1.0, 1.0);
        }
    }

    double random_g() {
        switch (kind_.weights) {
            case Weights::integer:
                return 1.0 + below(2);
            case Weights::alike:
                return 1.0;
            case Weights::scattered:
                return std::pow(10.0, between(-6.0, 6.0));
            default:
                return between(0.1, 2.0);
        }
    }
};

}  // namespace

WeightedGraph layered_graph(unsigned seed, bool matched, int width, int layers) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> weight(-1.0, 1.0), length(0.1, 2.0), chance(0.0, 1.0);
    WeightedGraph graph;
    graph.matched = matched;
    const int ends = 1 + static_cast<int>(random() % static_cast<unsigned>(width));
    std::vector<int> last;
    last.reserve(ends);
    const auto add_node = [&](const std::vector<int>& before) {
        const int node = static_cast<int>(graph.first_arc.size());
        graph.first_arc.push_back(static_cast<int>(graph.from.size()));
        for (const int p : before) {
            if (chance(random) > 0.6) continue;
            graph.from.push_back(p);
            graph.f.push_back(weight(random));
            graph.g.push_back(length(random));
        }
        return node;
    };
    for (int i = 0; i < ends; ++i) last.push_back(add_node({}));
    for (const int s : last) graph.sources.push_back({s, matched ? 0.0 : weight(random), matched ? 0.0 : length(random)});
    std::vector<int> all = last;
    for (int layer = 0; layer < layers; ++layer) {
        std::vector<int> next;
        next.reserve(width);
        for (int i = 0; i < width; ++i) next.push_back(add_node(layer % 2 ? all : last));
        all.insert(all.end(), next.begin(), next.end());
        last = next;
    }
    for (int i = 0; i < ends; ++i) {
        graph.destinations.push_back({add_node(last), matched ? 0.0 : weight(random), matched ? 0.0 : length(random)});
    }
    graph.first_arc.push_back(static_cast<int>(graph.from.size()));
    return graph;
}

WeightedGraph random_graph(const GraphKind& kind, unsigned seed, bool matched) { return Maker(kind, seed, matched).make(); }

}  // namespace mrc_test
