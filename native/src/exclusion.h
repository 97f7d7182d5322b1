// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "patch.h"

#include <vector>

namespace mrc {

/// What the other contours of a mesh close to one of them (1.4), by the numbers of its patch. Empty where it is alone.
struct Exclusion {
    std::vector<char> refused;        ///< of each local polygon: it may not enter the band
    std::vector<char> wall;           ///< of each edge: another contour runs along it or crosses it; no band grows across
    std::vector<char> closed_vertex;  ///< of each vertex: shared with another's band or contour, no chord touches it
    std::vector<char> closed_edge;    ///< of each edge: the same for its Steiner points
    std::vector<Contour> own;  ///< the contour as first given and as it lies, with the graph's points: open to it nevertheless
};

}  // namespace mrc
