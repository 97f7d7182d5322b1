// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/options.h>
#include <mrc/surface.h>

#include <cstdint>
#include <vector>

namespace mrc {

/// The faces that a search starts with, and on which side of the contour each lies.
struct BandFaces {
    std::vector<int> faces;  ///< ascending
    /// Of each face: 1 left of the contour, -1 right of it, 0 beyond an end of an open contour, where the two sides meet. A face
    /// that touches the contour on both sides belongs to the side from which the band reached it.
    std::vector<int8_t> sides;
};

/// The faces that `optimize` searches first (4.2.1), without searching them.
/// `progress` is called every few milliseconds; where it cancels, the result is empty.
/// @throws InvalidInput as `optimize` does.
BandFaces band(const Surface& surface, const Contour& contour, const Options& options = {}, const Progress& progress = {});

}  // namespace mrc
