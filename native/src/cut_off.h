// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <vector>

namespace mrc {

/// What a contour along real edges has beside it.
struct CutOff {
    int left = 0, right = 0;                         ///< triangles on each side, counted up to the limit
    bool left_border = false, right_border = false;  ///< true where the border of the mesh was met on that side
    bool separates = true;                           ///< false where a side that was counted to its end reaches the other
};

/// Counts what a simple contour along real edges cuts off on each side, up to a limit; the work is that of the limit.
CutOff cut_off_by(const Surface& surface, const std::vector<int>& contour, bool closed, int limit);

/// How many triangles the contour found cuts off, where it has slipped off the part that the given one lies on; otherwise 0.
///
/// It has where it cuts off next to nothing of the surface, less than the given contour on the same side, and follows nothing:
/// the ratio of loops around a tip may fall without end as they shrink, and what remains then is the tip. A small part with a
/// boundary of its own, as the floor of a hole, has more salience.
int slipped_off(const Surface& surface, const Contour& given, const Contour& found, double salience);

}  // namespace mrc
