// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "graph_input.h"
#include "line_graph.h"

namespace mrc {

/// Gives the graph of an open curve its sources and destinations: any chord that leaves the first end may begin a path, and any
/// that reaches the last may end it, each with the outer half that eq. 3.3 leaves out. The end is the curve's own or, where it
/// may move, any point of the piece of mesh border within the band that holds it (4.6).
void add_open_ends(const GraphInput& input, const Chords& chords, WeightedGraph& search);

}  // namespace mrc
