// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

namespace mrc {

/// An undirected segment of the graph: from a to b the flow rises by values[b] - values[a] + jump.
struct Segment {
    int a, b, jump;
    int halfedge;          // of the surface, that it lies on, or -1
    int triangle;          // of the patch, that it lies inside, or -1
    bool walkable = true;  // false on the border of the mesh and where others are: it only says what is level
};

/// The whole and the broken part of a flow value above the cut.
inline int whole(double value, double level) { return static_cast<int>(std::floor(value - level)); }
inline double above(double value, double level) { return value - level - std::floor(value - level); }

/// Below these increments two vertices, and then two points of a refined graph, are level. The second is far below a Steiner step
/// of the flattest edge, 1e-9 / (k + 1): so much of the linear flow is common at least to two chords that cross in a triangle,
/// and no contour may hold both.
constexpr double level_vertices = 1e-9, level_points = 1e-12;

/// Gives points joined by segments with increments below the tolerance one value, their mean, so that being level is transitive:
/// then a segment joins equal values without a jump, or its increment is not below the tolerance. Values and jumps change
/// together.
void merge_levels(std::vector<double>& values, std::vector<Segment>& segments, double tolerance);

/// A level through no point that the fewest segments cross; of those the one in the widest gap.
double cheapest_level(const std::vector<double>& values, const std::vector<Segment>& segments);

}  // namespace mrc
