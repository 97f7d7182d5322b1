// SPDX-License-Identifier: GPL-3.0-or-later
#include "topological_order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace mrc {
namespace {

/// The points in the order of level, rank and number, and the number of each point's level.
struct PointOrder {
    std::vector<int> place, level;  // of each point
};

PointOrder sort_points(const std::vector<GraphPoint>& points) {
    struct Key {
        double level, rank;
        int point;
        auto operator<=>(const Key&) const = default;
    };
    std::vector<Key> keys;
    keys.reserve(points.size());
    for (const GraphPoint& p : points) keys.push_back({p.level, p.rank, static_cast<int>(keys.size())});
    std::ranges::sort(keys);
    PointOrder order{std::vector<int>(keys.size()), std::vector<int>(keys.size())};
    for (int i = 0, level = 0; i < static_cast<int>(keys.size()); ++i) {
        if (i > 0 && keys[i].level > keys[i - 1].level) ++level;
        order.place[keys[i].point] = i;
        order.level[keys[i].point] = level;
    }
    return order;
}

/// Where a chord stands among those that leave points of one level.
struct ChordKey {
    std::uint64_t order;  // climb, tail, head: the ends by their places among the points
    int chord;
    auto operator<=>(const ChordKey&) const = default;
};

ChordKey chord_key(int chord, const DirectedSegment& d, const PointOrder& points) {
    constexpr std::uint64_t most = (1ULL << 31) - 1;
    const auto tail = static_cast<std::uint64_t>(points.place[d.tail]), head = static_cast<std::uint64_t>(points.place[d.head]);
    const std::uint64_t from = d.climb == Climb::falling ? most - tail : tail;
    return {static_cast<std::uint64_t>(d.climb) << 62 | from << 31 | head, chord};
}

/// The chords in buckets, one for each level and a last one for what crosses the cut.
struct Buckets {
    std::vector<ChordKey> keys;
    std::vector<int> end;  // of each bucket
};

Buckets fill_buckets(const std::vector<GraphPoint>& points, const std::vector<DirectedSegment>& directed) {
    const PointOrder order = sort_points(points);
    const std::size_t last = points.size();  // no level has a higher number
    const auto bucket = [&](const DirectedSegment& d) { return d.crosses ? last : static_cast<std::size_t>(order.level[d.tail]); };
    std::vector<int> next(last + 2, 0);
    for (const DirectedSegment& d : directed) ++next[bucket(d) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<ChordKey> keys(directed.size());
    for (int i = 0; i < static_cast<int>(directed.size()); ++i)
        keys[next[bucket(directed[i])]++] = chord_key(i, directed[i], order);
    next.pop_back();
    return {std::move(keys), std::move(next)};
}

}  // namespace

std::vector<int> topological_order(const std::vector<GraphPoint>& points, const std::vector<DirectedSegment>& directed,
                                   const Beat& beat) {
    auto [keys, ends] = fill_buckets(points, directed);
    auto begin = keys.begin();
    for (std::size_t b = 0; b < points.size(); ++b) {
        if (beat && b % 1024 == 0) beat();
        const auto end = keys.begin() + ends[b];
        std::sort(begin, end);
        begin = end;
    }
    const auto across = [&](const ChordKey& key) {
        const DirectedSegment& d = directed[key.chord];
        return std::pair(points[d.tail].rank + points[d.head].rank, key);
    };
    std::sort(begin, keys.end(), [&](const ChordKey& a, const ChordKey& b) { return across(a) < across(b); });
    std::vector<int> order;
    order.reserve(keys.size());
    for (const ChordKey& key : keys) order.push_back(key.chord);
    return order;
}

}  // namespace mrc
