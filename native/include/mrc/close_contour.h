// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

namespace mrc {

/// Closes an open chain of vertices around the limb that it lies on, so that part of a loop drawn by hand is enough.
///
/// The result begins with the chain. The path back to its start is the cheapest along mesh edges after Lee et al., "Intelligent
/// mesh scissoring using 3D snakes" (Pacific Graphics 2004), on completing a contour: length times functions of the distance from
/// the chain, of the normal and of concavity, cheap far from the chain, where the surface faces away from it, and along creases. So
/// it goes around the limb and not back beside the chain. The formulas, and what differs from theirs, are in the source.
/// The work grows with the vertices that cost no more than the closing path, not with the mesh.
/// Reversing the chain gives the same loop, reversed.
/// `progress` is called every few milliseconds with the fraction of the surface's vertices that is searched; where it cancels, the
/// result has no points.
/// @throws InvalidInput where the chain is none (`checked_contour`), has points inside edges, or nothing leads round, as on a
/// plane.
Contour close_contour(const Surface& surface, const Contour& chain, const Progress& progress = {});

}  // namespace mrc
