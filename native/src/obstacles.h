// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <string>

namespace mrc {

/// Bands keep to polygons that are shown and whose vertices have one fan each.
bool usable_face(const Surface& surface, int face);

/// What keeps a band from growing on the side of this half-edge, in words; empty: nothing.
std::string obstacle(const Surface& surface, int halfedge);

/// What keeps a contour from running along the real edge ab, in words; empty: nothing. One side that a band may enter is enough.
std::string obstacle(const Surface& surface, int a, int b);

}  // namespace mrc
