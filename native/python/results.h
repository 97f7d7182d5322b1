// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "arrays.h"

#include <mrc/optimize.h>

#include <vector>

namespace mrc_python {

/// What `optimize` gives to Python: the result, and what the surface says about its contour.
struct PyResult {
    mrc::Result result;
    std::vector<mrc::Vec3> positions;
    std::vector<int> segment_faces;
};

PyResult describe(const mrc::Surface& surface, mrc::Result result);

/// Vertex ids; -1 for points between vertices.
Integers contour_vertices(const mrc::Contour& contour);
/// Points as (a, b) and t: they lie at (1 - t) a + t b.
Integers edge_vertices(const mrc::Contour& contour);
Doubles edge_parameters(const mrc::Contour& contour);

}  // namespace mrc_python
