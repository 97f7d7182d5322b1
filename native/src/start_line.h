// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "band.h"
#include "patch.h"

#include <vector>

namespace mrc {

/// The band cut open along the start line. A flow's values hold in the opened band; a face behind the line sees the line's own
/// vertices one turn further on. The band of an open curve is open as it is.
struct OpenedBand {
    std::vector<int> line;     ///< from right to left
    std::vector<char> behind;  ///< of each half-edge in the band: true where it starts on the line and its face lies behind it
    std::vector<int> jump;     ///< of each half-edge: crossings of the line
};

/// Cuts a band open along the shortest path across it. `strips`: its strip boundaries, from right to left.
OpenedBand cut_open(const Patch& patch, const Band& band, const std::vector<Curve>& strips);

}  // namespace mrc
