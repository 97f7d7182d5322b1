// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "incumbent.h"
#include "lens.h"
#include "relaxation.h"

#include <limits>
#include <vector>

namespace mrc {

/// The search for paths above the lower hull, one by one: labels are partial paths, extended backwards from a destination as long
/// as the bounds of all passes allow them to beat the best.
///
/// Where all arcs have length 1, lengths are counts, and of the partial paths from a node with the same count only the best
/// matters. That is Karp's recurrence [7] (A.3), kept to what the passes allow.
class LabelSearch {
  public:
    LabelSearch(const WeightedGraph& graph, const RatioOptions& options, Incumbent& incumbent, Lens& lens);

    /// Offers the incumbent what is better on a path from any of these sources to any of these destinations. A pair has no
    /// potential.
    void run(const std::vector<int>& sources, const std::vector<int>& destinations, const std::vector<Pass>& passes);

    /// Partial paths met so far.
    int labels() const { return labels_; }
    /// The least bound of the pairs given up.
    double unresolved() const { return unresolved_; }

  private:
    struct Label {
        Terminal rest;    // the path's node, and its weights from there on
        int arc, before;  // the path goes on through `arc` and then as label `before` does
        int steps;        // how often the best had been replaced when the path was found worthwhile
    };
    struct Count {
        double g;
        int label;
    };

    const WeightedGraph& graph_;
    const Beat& beat_;
    const int most_labels_;
    const bool counted_;  // every arc has length 1
    Incumbent& incumbent_;
    Lens& lens_;
    std::vector<int> first_source_;  // of each node: a source there of the set at work, or -1
    std::vector<int> next_source_;   // of each source of that set: another one at its node, or -1; above the hull each counts
    int labels_ = 0;
    double unresolved_ = std::numeric_limits<double>::infinity();

    void search_all(const std::vector<Pass>& passes, const Terminal& destination);
    void search_counts(const std::vector<Pass>& passes, const Terminal& destination);
    Label first_label(const Terminal& destination) const { return {destination, -1, -1, incumbent_.steps()}; }
    Label extended(const Label& label, int index, int arc) const;
    static void keep_best(const Label& label, std::vector<Label>& labels, std::vector<Count>& here);
    void finish(const std::vector<Label>& labels, int index);
    void give_up(const std::vector<Pass>& passes, const Terminal& destination);
    double shortest_length(const Terminal& destination) const;
};

}  // namespace mrc
