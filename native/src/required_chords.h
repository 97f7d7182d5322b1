// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "directed_segments.h"
#include "graph_input.h"
#include "required_elements.h"

#include <vector>

namespace mrc {

inline RequiredElements::Place place_of(const std::vector<GraphPoint>& points, int point) {
    return {points[point].level, points[point].rank, point};
}

/// Deletes the chords that no contour through the required elements can hold (4.4), among which are an open curve's first and
/// last edge where these are held. Gives the elements, which also rule out arcs.
/// @throws InvalidInput for elements that no contour of the band can hold.
RequiredElements keep_required_chords(const GraphInput& input, const std::vector<GraphPoint>& points,
                                      std::vector<DirectedSegment>& directed);

}  // namespace mrc
