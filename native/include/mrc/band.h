// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/options.h>
#include <mrc/surface.h>

#include <cstdint>
#include <vector>

namespace mrc {

/// The faces that a search starts with, and where each lies as one walks along the contour.
struct BandFaces {
    std::vector<int> faces;  ///< ascending
    /// Of each face: 1 left of the contour, -1 right of it. A face lies on the side from which the band reached it, so also a face
    /// that touches the contour on both sides has one. 0: beyond an end of an open contour, where its two sides meet.
    std::vector<int8_t> sides;
};

/// The faces that `optimize` searches first (4.2.1), without searching them.
/// `progress` is called every few milliseconds; where it cancels, the result is empty.
/// @throws InvalidInput as `optimize` does.
BandFaces band(const Surface& surface, const Contour& contour, const Options& options = {}, const Progress& progress = {});

}  // namespace mrc
