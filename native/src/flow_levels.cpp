// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_levels.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace mrc {
namespace {

constexpr double least_gap = 1e-9;  // between points, for a level that passes between them

/// Union-find over points whose values differ by whole numbers: value(p) and value(root(p)) + offset(p) are one flow value.
class LiftedClasses {
  public:
    explicit LiftedClasses(std::size_t count) : parent_(count), offset_(count, 0) {
        for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<int>(i);
    }

    std::pair<int, int> find(int p) {
        int root = p, sum = 0;
        for (; parent_[root] != root; root = parent_[root]) sum += offset_[root];
        for (int rest = sum; parent_[p] != p;) {
            const int next = parent_[p], step = offset_[p];
            parent_[p] = root;
            offset_[p] = rest;
            rest -= step;
            p = next;
        }
        return {root, sum};
    }

    /// States that the flow at b, lifted by `jump`, is that at a.
    void unite(int a, int b, int jump) {
        const auto [root_a, offset_a] = find(a);
        const auto [root_b, offset_b] = find(b);
        if (root_a == root_b) return;
        parent_[root_b] = root_a;
        offset_[root_b] = offset_a - jump - offset_b;
    }

  private:
    std::vector<int> parent_;
    std::vector<int> offset_;
};

// Offsets: lifted(p) = value(p) - offset(p) is comparable within a class. For a level segment value(b) + jump = value(a).
void merge_classes(LiftedClasses& classes, std::vector<double>& values, std::vector<Segment>& segments) {
    std::vector<double> sums(values.size(), 0.0);
    std::vector<int> counts(values.size(), 0), offsets(values.size(), 0), roots(values.size(), 0);
    for (std::size_t p = 0; p < values.size(); ++p) {
        const auto [root, offset] = classes.find(static_cast<int>(p));
        roots[p] = root;
        offsets[p] = offset;
        sums[root] += values[p] - offset;
        ++counts[root];
    }
    for (std::size_t p = 0; p < values.size(); ++p) {
        if (counts[roots[p]] > 1) values[p] = sums[roots[p]] / counts[roots[p]];
    }
    for (Segment& s : segments) {
        const auto offset = [&](int p) { return counts[roots[p]] > 1 ? offsets[p] : 0; };
        s.jump += offset(s.b) - offset(s.a);
    }
}

}  // namespace

void merge_levels(std::vector<double>& values, std::vector<Segment>& segments, double tolerance) {
    // A mean lies away from the values that it replaces, and so may come near to a neighbor's.
    for (bool merged = true; merged;) {
        merged = false;
        LiftedClasses classes(values.size());
        for (const Segment& s : segments) {
            if (std::abs(values[s.b] - values[s.a] + s.jump) >= tolerance) continue;
            classes.unite(s.a, s.b, s.jump);
            merged |= values[s.a] != values[s.b];
        }
        if (merged) merge_classes(classes, values, segments);
    }
}

double cheapest_level(const std::vector<double>& values, const std::vector<Segment>& segments) {
    std::vector<int> change(values.size(), 0);  // of the number of crossings, as the level passes the point
    int crossings = 0;                          // of level 0
    for (const Segment& s : segments) {
        const double increment = values[s.b] - values[s.a] + s.jump;
        const int sign = increment > 0.0 ? 1 : increment < 0.0 ? -1 : 0;
        change[s.a] += sign;
        change[s.b] -= sign;
        crossings += std::abs(s.jump + whole(values[s.b], 0.0) - whole(values[s.a], 0.0));
    }
    std::vector<std::pair<double, int>> order;
    for (std::size_t p = 0; p < values.size(); ++p) order.emplace_back(above(values[p], 0.0), static_cast<int>(p));
    std::ranges::sort(order);
    double best_level = 0.0;
    std::pair<int, double> best{static_cast<int>(segments.size()) + 1, 0.0};
    for (std::size_t i = 0; i < order.size(); ++i) {
        crossings += change[order[i].second];
        const double next = i + 1 < order.size() ? order[i + 1].first : 1.0 + order[0].first;
        const double gap = next - order[i].first;
        if (gap < least_gap) continue;
        const std::pair<int, double> candidate{crossings, -gap};
        if (candidate < best) {
            best = candidate;
            best_level = order[i].first + 0.5 * gap;
        }
    }
    return best_level;
}

}  // namespace mrc
