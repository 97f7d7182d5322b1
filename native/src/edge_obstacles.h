// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <optional>
#include <string>

namespace mrc {

/// Bands keep to visible polygons whose vertices have one fan each.
bool usable_face(const Surface& surface, int face);

/// The reason why no band can grow, or no contour can run, at some place.
struct Obstacle {
    ErrorCode code;
    std::string words;  ///< where that is: "on the border of the mesh"
    std::optional<Element> element;
};

/// Why no band can grow on the side of this half-edge; nothing where one can.
std::optional<Obstacle> obstacle(const Surface& surface, int halfedge);

/// Why no contour can run along the real edge ab; nothing where one can: one side that a band may enter is enough.
std::optional<Obstacle> obstacle(const Surface& surface, int a, int b);

}  // namespace mrc
