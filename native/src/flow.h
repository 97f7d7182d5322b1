// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "band.h"

#include <vector>

namespace mrc {

/// How far along the contour each point of the band lies: an increment on every edge of the band, antisymmetric, with sum zero
/// around every triangle and total 1 once around the band.
///
/// It is held as a value for each vertex and a whole number for each half-edge, so that periods are exact.
struct Flow {
    std::vector<double> value;  ///< of each patch vertex; 0 outside the band
    std::vector<int> jump;      ///< of each patch half-edge; opposite half-edges have opposite jumps

    double increment(const PatchMesh& mesh, int h) const {
        const auto handle = PatchMesh::HalfedgeHandle(h);
        return value[mesh.to_vertex_handle(handle).idx()] - value[mesh.from_vertex_handle(handle).idx()] + jump[h];
    }
};

/// `harmonic`: the closed 1-form of period 1 that is harmonic with weight 1 on real edges; it depends on no starting line.
/// `gates`, `arc_length`: the distance functions of 4.2.3 along the strip boundaries, tied by gates or not.
/// @throws InvalidInput where no flow exists.
Flow make_flow(const Patch& patch, const Band& band, const Options& options, const Beat& beat = {});

/// The vertices of the piece of mesh border within the band that holds a vertex; empty where the vertex is not on the border.
std::vector<int> border_piece(const Patch& patch, const Band& band, int vertex);

/// The piece of mesh border along which an end of an open curve may slide; empty where the end stays, as with the other end on the
/// same piece, or where it is held.
std::vector<int> sliding_piece(const Patch& patch, const Band& band, const Options& options, int end, int other, bool held);

/// The strip boundaries of 4.2.3 from the rightmost to the leftmost: the contour, the boundaries of every round, and the refined
/// strips between them that cover the vertices left over. Closed lists of patch vertices, or open ones from the first vertex of
/// an open curve to its last; neighbors may share vertices but never cross. Every vertex of the band lies on at least one, except
/// those that only the band's end polygons hold.
std::vector<Curve> strip_boundaries(const Patch& patch, const Band& band);

}  // namespace mrc
