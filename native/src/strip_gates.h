// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "band.h"
#include "start_line.h"
#include "strip.h"

#include <vector>

namespace mrc {

/// A strip, with the place on it of each vertex as seen in the band cut open, or `off_strip`.
struct IndexedStrip {
    const Strip& strip;
    const std::vector<int>& index;
};

/// The gates of 4.2.3 from a strip whose flow is known to the next one: pairs of points, one on each strip, each the other's
/// closest. One of them is a vertex, since no two edges with a flat piece of the band between them are closest in their insides
/// only.
std::vector<Gate> find_gates(const Patch& patch, const Band& band, const OpenedBand& opened, const IndexedStrip& known,
                             const IndexedStrip& next);

}  // namespace mrc
