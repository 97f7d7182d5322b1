// SPDX-License-Identifier: GPL-3.0-or-later
#include "label_search.h"

#include <algorithm>
#include <utility>

namespace mrc {

LabelSearch::LabelSearch(const WeightedGraph& graph, const RatioOptions& options, Incumbent& incumbent, Lens& lens)
    : graph_(graph),
      beat_(options.beat),
      most_labels_(options.most_labels),
      counted_(std::ranges::all_of(graph.g, [](double g) { return g == 1.0; })),
      incumbent_(incumbent),
      lens_(lens),
      first_source_(graph.node_count(), -1),
      next_source_(graph.sources.size(), -1) {}

void LabelSearch::run(const std::vector<int>& sources, const std::vector<int>& destinations, const std::vector<Pass>& passes) {
    for (const int i : sources) next_source_[i] = std::exchange(first_source_[graph_.sources[i].node], i);
    for (const int i : destinations) {
        const Terminal& destination = graph_.destinations[i];
        counted_ ? search_counts(passes, destination) : search_all(passes, destination);
    }
    for (const int i : sources) first_source_[graph_.sources[i].node] = -1;
}

LabelSearch::Label LabelSearch::extended(const Label& label, int index, int arc) const {
    const Terminal rest{graph_.from[arc], label.rest.f + graph_.f[arc], label.rest.g + graph_.g[arc]};
    return {rest, arc, index, incumbent_.steps()};
}

/// Walks back from a destination over all worthwhile partial paths, the latest first.
void LabelSearch::search_all(const std::vector<Pass>& passes, const Terminal& destination) {
    if (!lens_.is_open(passes, destination)) return;
    std::vector<Label> labels{first_label(destination)};
    std::vector<int> stack{0};
    const int most = most_labels_ - labels_;
    while (!stack.empty()) {
        const int index = stack.back();
        stack.pop_back();
        const Label label = labels[index];
        const int node = label.rest.node;
        if (beat_ && index % 256 == 0) beat_();
        if (label.steps != incumbent_.steps() && !lens_.is_open(passes, label.rest)) continue;
        if (first_source_[node] >= 0) finish(labels, index);
        for (int a = graph_.first_arc[node]; a < graph_.first_arc[node + 1]; ++a) {
            const Label next = extended(label, index, a);
            if (!lens_.is_open(passes, next.rest)) continue;
            if (static_cast<int>(labels.size()) >= most) return give_up(passes, destination);
            stack.push_back(static_cast<int>(labels.size()));
            labels.push_back(next);
        }
    }
    labels_ += static_cast<int>(labels.size());
}

/// The same in reverse topological order, with one label for each count at a node.
void LabelSearch::search_counts(const std::vector<Pass>& passes, const Terminal& destination) {
    std::vector<Label> labels{first_label(destination)};
    std::vector<std::vector<Count>> at(graph_.node_count());
    at[destination.node].push_back({destination.g, 0});
    for (int n = destination.node; n >= 0; --n) {
        if (beat_) beat_();
        for (const Count& count : at[n]) {
            const Label label = labels[count.label];
            if (!lens_.is_open(passes, label.rest)) continue;
            if (first_source_[n] >= 0) finish(labels, count.label);
            for (int a = graph_.first_arc[n]; a < graph_.first_arc[n + 1]; ++a)
                keep_best(extended(label, count.label, a), labels, at[graph_.from[a]]);
        }
    }
    labels_ += static_cast<int>(labels.size());
}

void LabelSearch::keep_best(const Label& label, std::vector<Label>& labels, std::vector<Count>& here) {
    const auto same = std::ranges::lower_bound(here, label.rest.g, {}, &Count::g);
    if (same == here.end() || same->g != label.rest.g) {
        here.insert(same, {label.rest.g, static_cast<int>(labels.size())});
        labels.push_back(label);
    } else if (label.rest.f < labels[same->label].rest.f) {
        labels[same->label] = label;
    }
}

/// A label at a source is a path, with each of the sources there.
void LabelSearch::finish(const std::vector<Label>& labels, int index) {
    const Terminal& rest = labels[index].rest;
    std::vector<int> nodes;
    for (int i = index; i >= 0; i = labels[i].before) nodes.push_back(labels[i].rest.node);
    for (int i = first_source_[rest.node]; i >= 0; i = next_source_[i])
        incumbent_.offer({nodes, rest.f + graph_.sources[i].f, rest.g + graph_.sources[i].g});
}

/// The pair stays open: its bound is the best that a path on the passes' lines, no shorter than the shortest, could reach.
void LabelSearch::give_up(const std::vector<Pass>& passes, const Terminal& destination) {
    labels_ = most_labels_;
    const double shortest = shortest_length(destination);
    double bound = -std::numeric_limits<double>::infinity();
    for (const Pass& pass : passes)
        bound = std::max(bound, incumbent_.objective().least_on_line(pass.lambda, pass.bound(destination), shortest));
    unresolved_ = std::min(unresolved_, bound);
}

/// The least sum of g from the sources at work to a destination.
double LabelSearch::shortest_length(const Terminal& destination) const {
    std::vector<double> length(graph_.node_count(), std::numeric_limits<double>::infinity());
    for (int n = 0; n < graph_.node_count(); ++n) {
        for (int i = first_source_[n]; i >= 0; i = next_source_[i]) length[n] = std::min(length[n], graph_.sources[i].g);
        for (int a = graph_.first_arc[n]; a < graph_.first_arc[n + 1]; ++a)
            length[n] = std::min(length[n], length[graph_.from[a]] + graph_.g[a]);
    }
    return length[destination.node] + destination.g;
}

}  // namespace mrc
