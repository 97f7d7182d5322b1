// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <optional>
#include <string>

namespace mrc {

/// Bands keep to polygons that are shown and whose vertices have one fan each.
bool usable_face(const Surface& surface, int face);

/// What keeps a band or a contour from somewhere.
struct Obstacle {
    ErrorCode code;
    std::string words;  ///< where that is: "on the border of the mesh"
    std::optional<Element> element;
};

/// What keeps a band from growing on the side of this half-edge.
std::optional<Obstacle> obstacle(const Surface& surface, int halfedge);

/// What keeps a contour from running along the real edge ab. One side that a band may enter is enough.
std::optional<Obstacle> obstacle(const Surface& surface, int a, int b);

}  // namespace mrc
