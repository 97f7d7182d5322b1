// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

namespace mrc {

/// Closes an open chain of vertices around the limb that it lies on, so that part of a loop drawn by hand is enough.
///
/// The result begins with the chain. The path back to its start is the cheapest along mesh edges after Lee et al., "Intelligent
/// mesh scissoring using 3D snakes" (Pacific Graphics 2004), on completing a contour. An edge costs its length times functions of
/// the distance from the chain, of the normal and of concavity: edges are cheap far from the chain, where the surface faces away
/// from it, and along creases. So the path goes around the limb and not back beside the chain.
/// The work grows with the number of vertices that can be reached at no more than the cost of the closing path, not with the
/// mesh. Reversing the chain gives the same loop, reversed.
/// `progress` is called every few milliseconds with the fraction of the surface's vertices searched so far; where it cancels, the
/// result has no points.
/// @throws InvalidInput where the chain is closed, is not a simple path along mesh edges, has points inside edges, or cannot be
/// closed around anything: on a plane, or where only a way back beside the chain is left, as where the mesh is split there.
Contour close_contour(const Surface& surface, const Contour& chain, const Progress& progress = {});

}  // namespace mrc
