// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.h"

#include <mrc/optimize.h>

#include <vector>

namespace mrc_bench {

/// A contour on a surface, with the options of its search.
struct Case {
    mrc::Surface surface;
    mrc::Contour contour;
    mrc::Options options;
};

/// A wavy tube of triangles with a jagged ring halfway up, whose band has about `band_faces` faces. `more_faces` adds another body
/// with this many faces to the mesh, far away; `variant` selects another tube of the same size.
Case tube_case(int band_faces, int refinement, int more_faces = 0, int variant = 0);

/// A tube with several contours, whose bands of about `band_faces` faces are out of each other's reach.
struct Row {
    mrc::Surface surface;
    std::vector<mrc::Contour> contours;
    mrc::Options options;
};
Row contours_in_a_row(int count, int band_faces, int refinement);

/// The arrays of a torus with about this many faces, in regular order.
struct Arrays {
    std::vector<double> positions;
    std::vector<int> triangles;
    mrc::SurfaceArrays view() const { return {positions, {}, triangles, {}, {}}; }
};
Arrays torus_arrays(int faces);

/// One relaxation of the graph from all its sources: a lower bound on the time of any search.
double bare_pass(const mrc::WeightedGraph& graph, double lambda, std::vector<double>& value);

}  // namespace mrc_bench
