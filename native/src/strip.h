// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "patch.h"

#include <limits>
#include <vector>

namespace mrc {

/// In a vertex's place on a strip: it is not on that strip.
constexpr int off_strip = std::numeric_limits<int>::min();

/// A strip boundary unrolled: `k` and `k + size()` are the same vertex, one turn apart. One of an open curve has one turn only.
struct Strip {
    std::vector<int> vertices;
    std::vector<int> lap;      ///< of each vertex: crossings of the start line since the first one
    std::vector<double> arc;   ///< of each vertex: length from the first one
    std::vector<double> flow;  ///< of each vertex, as it rises along the strip
    double length = 0.0;
    bool closed = true;

    int size() const { return static_cast<int>(vertices.size()); }
    int turn(int k) const { return (k >= 0 ? k : k - size() + 1) / size(); }
    int vertex(int k) const { return vertices[k - turn(k) * size()]; }
    double arc_at(int k) const { return arc[k - turn(k) * size()] + turn(k) * length; }
    double flow_at(int k) const { return flow[k - turn(k) * size()] + turn(k); }
};

/// The point (1 - t) k + t (k + 1) of a strip, and how far it is from the point that looked for it.
struct Foot {
    int k = 0;
    double t = 0.0;
    double distance = 0.0;

    double place() const { return k + t; }
    double arc(const Strip& strip) const { return (1.0 - t) * strip.arc_at(k) + t * strip.arc_at(k + 1); }
    double flow(const Strip& strip) const { return (1.0 - t) * strip.flow_at(k) + t * strip.flow_at(k + 1); }
};

/// A point of a strip whose flow the strip before it settles.
struct Gate {
    double arc = 0.0;
    double flow = 0.0;
    double length = 0.0;
};

}  // namespace mrc
