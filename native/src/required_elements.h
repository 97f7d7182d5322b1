// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/constraints.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mrc {

/// Hard constraints (4.4) as deletions, exact for rising and level chords alike.
///
/// A contour meets every flow level once, so it passes a vertex exactly where no chord steps over the vertex's level and no arc
/// runs through that level elsewhere. Levels are compared exactly: the points of a class share one value.
class RequiredElements {
  public:
    /// A place on the flow: its level above the cut, in [0, 1), and its rank across.
    struct Place {
        double level, rank;
        int point;
    };
    /// A chord's interval of the flow, from tail to head, and its ends' ranks. One that crosses the cut wraps around.
    struct Span {
        double tail_level, head_level;
        bool wraps;
        double tail_rank, head_rank;
        int segment;

        bool level() const { return tail_level == head_level && !wraps; }
    };

    void require(const Place& place) { places_.push_back(place); }
    /// A chord's own segments stay, and all others that overlap its interval go.
    void require(const Span& span, std::vector<int> segments) { spans_.push_back({span, std::move(segments)}); }

    bool empty() const { return places_.empty() && spans_.empty(); }
    bool allows(const Span& chord) const {
        for (const Place& p : places_) {
            if (chord.level() ? p.level == chord.tail_level && passes(p.rank, chord) : inside(p.level, chord)) return false;
        }
        for (const Required& r : spans_) {
            if (r.owns(chord.segment)) continue;
            if (r.span.level() ? level_overlap(r.span, chord) : overlap(r.span, chord)) return false;
        }
        return true;
    }

    /// The arc through `place` from one chord to the next; climbs are 1 rising, -1 falling, 0 along the flow.
    bool allows_arc(const Place& place, int climb_in, int climb_out) const {
        for (const Place& p : places_) {
            if (p.level != place.level || p.point == place.point) continue;
            if (place.rank == p.rank) return false;
            const bool before = place.rank < p.rank;
            if (climb_in == 0 && climb_out == 0) return false;
            // A rising chain must not leave the level before the vertex, nor enter it behind; mirrored for a falling one.
            if (climb_out == 0 && before == (climb_in > 0)) return false;
            if (climb_in == 0 && before != (climb_out > 0)) return false;
        }
        return true;
    }

  private:
    struct Required {
        Span span;
        std::vector<int> segments;
        bool owns(int segment) const {
            for (const int s : segments) {
                if (s == segment) return true;
            }
            return false;
        }
    };
    std::vector<Place> places_;
    std::vector<Required> spans_;

    static bool inside(double level, const Span& s) {
        return s.wraps ? level > s.tail_level || level < s.head_level : level > s.tail_level && level < s.head_level;
    }
    static bool passes(double rank, const Span& chord) { return (rank - chord.tail_rank) * (rank - chord.head_rank) < 0.0; }
    static bool overlap(const Span& a, const Span& b) {
        if (b.level()) return inside(b.tail_level, a);
        if (a.wraps && b.wraps) return true;
        if (a.wraps) return b.head_level > a.tail_level || b.tail_level < a.head_level;
        if (b.wraps) return overlap(b, a);
        return std::max(a.tail_level, b.tail_level) < std::min(a.head_level, b.head_level);
    }
    static bool level_overlap(const Span& required, const Span& chord) {
        if (!chord.level() || chord.tail_level != required.tail_level) return false;
        const auto [low, high] = std::minmax(required.tail_rank, required.head_rank);
        const auto [first, last] = std::minmax(chord.tail_rank, chord.head_rank);
        return first < high && last > low;
    }
};

/// True where the contour has all required elements.
bool has_required_elements(const Contour& contour, const Constraints& constraints);

}  // namespace mrc
