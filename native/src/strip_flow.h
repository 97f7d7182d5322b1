// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/flow.h>

namespace mrc {

/// The distance functions of 4.2.3 along the strip boundaries: `gates`, or `arc_length`.
///
/// On the contour the flow is arc length from the start line, a shortest path across the band. From there it passes outwards,
/// strip by strip. A vertex of two strips has one value, so shared vertices come first. `gates` then ties points of neighbouring
/// strips that are closest to each other (vertices, where they are opposite within half an edge), `arc_length` only the strips'
/// starts. Between what is tied the flow follows arc length. It rises strictly along every strip: a tie that leaves less than 1 %
/// of the strip's mean slope beside a shorter tie counts as crossing it and is dropped, and no edge counts for less than a
/// thousandth of its strip's mean edge.
Flow strip_flow(const Surface& surface, const Patch& patch, const Band& band, const Options& options);

}  // namespace mrc
