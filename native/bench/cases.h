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

/// A wavy tube of triangles with a jagged ring half way up, whose band has about so many faces. `more_faces`: of another body that is
/// part of the mesh and far away. `variant`: another tube of the same size.
Case tube_case(int band_faces, int refinement, int more_faces = 0, int variant = 0);

/// A tube with room for so many contours, each with a band of about so many faces out of reach of the others'.
struct Row {
    mrc::Surface surface;
    std::vector<mrc::Contour> contours;
    mrc::Options options;
};
Row contours_in_a_row(int count, int band_faces, int refinement);

/// The arrays of a torus of about so many triangles, in file order.
struct Arrays {
    std::vector<double> positions;
    std::vector<int> triangles;
    mrc::SurfaceArrays view() const { return {positions, {}, triangles, {}, {}}; }
};
Arrays torus_arrays(int faces);

/// One relaxation of the graph from all its sources: what any search takes at least.
double bare_pass(const mrc::WeightedGraph& graph, double lambda, std::vector<double>& value);

}  // namespace mrc_bench
