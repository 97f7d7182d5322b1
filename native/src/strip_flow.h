// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flow.h"

namespace mrc {

/// The distance functions of 4.2.3 along the strip boundaries: `gates`, or `arc_length`.
///
/// On the contour the flow is arc length from the start line, a shortest path across the band. From there it passes outwards,
/// strip by strip. A vertex of two strips has one value, so shared vertices come first. `gates` then ties points of neighboring
/// strips that are closest to each other (vertices, where they are opposite within half an edge), `arc_length` only the strips'
/// starts. Between what is tied the flow follows arc length. It rises strictly along every strip: a tie that leaves less than 1 %
/// of the strip's mean slope beside a shorter tie counts as crossing it and is dropped, and no edge counts for less than a
/// thousandth of its strip's mean edge.
///
/// Around an open curve the strips run from its first vertex, at 0, to its last, at 1, each passing around either end. So what
/// lies behind an end rises away from the first vertex, and towards the last one, as everywhere else; there is no start line. A
/// strip that runs along the piece of mesh border at 0 rises from the last vertex that it has there, and likewise up to the first
/// one at 1. What only the band's end polygons hold lies evenly between the vertices of strips beside it.
/// `fixed`: of each patch vertex, 0 or 1 where an end holds it, below 0 elsewhere; only open curves need it.
Flow strip_flow(const Patch& patch, const Band& band, FlowKind kind, const std::vector<double>& fixed, const Beat& beat = {});

}  // namespace mrc
