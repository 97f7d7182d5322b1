// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ambient_graph.h"
#include "exclusion.h"

namespace mrc {

/// Closes the segments where another contour lies or may come to (1.4), but for the contour's own points and segments.
void exclude_segments(const Surface& surface, const Patch& patch, const Exclusion& exclusion, AmbientGraph& ambient);

}  // namespace mrc
