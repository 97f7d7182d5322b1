// SPDX-License-Identifier: GPL-3.0-or-later
#include "directed_segments.h"

#include <cmath>

namespace mrc {
namespace {

void direct_level_segment(const Surface& surface, const std::vector<GraphPoint>& points, const Segment& s, int segment,
                          std::vector<DirectedSegment>& directed) {
    const double difference = points[s.b].rank - points[s.a].rank;
    const double length = (surface.position(points[s.b].place) - surface.position(points[s.a].place)).norm();
    if (std::abs(difference) <= 1e-9 * length) return;
    const int low = difference > 0.0 ? s.a : s.b, high = difference > 0.0 ? s.b : s.a;
    directed.push_back({low, high, 0.0, segment, false, Climb::rising});
    directed.push_back({high, low, 0.0, segment, false, Climb::falling});
}

}  // namespace

std::vector<DirectedSegment> direct_segments(const Surface& surface, const AmbientGraph& ambient,
                                             const std::vector<GraphPoint>& points, bool closed, double level) {
    const std::vector<double>& values = ambient.values;
    std::vector<DirectedSegment> directed;
    directed.reserve(ambient.segments.size());
    for (int i = 0; i < static_cast<int>(ambient.segments.size()); ++i) {
        const Segment& s = ambient.segments[i];
        if (!s.walkable) continue;
        const int crossings = closed ? s.jump + whole(values[s.b], level) - whole(values[s.a], level) : 0;
        const double increment = points[s.b].level - points[s.a].level + crossings;
        if (increment == 0.0) {
            direct_level_segment(surface, points, s, i, directed);
            continue;
        }
        if (closed && std::abs(increment) >= 1.0) continue;  // no closed contour holds a chord that goes all around the band
        const int tail = increment > 0.0 ? s.a : s.b, head = increment > 0.0 ? s.b : s.a;
        directed.push_back({tail, head, std::abs(increment), i, crossings != 0, Climb::along});
    }
    return directed;
}

}  // namespace mrc
