// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "band.h"

#include <span>
#include <vector>

namespace mrc {

/// The one connected chain of front half-edges in which a polygon meets the band; of length 0 where it may not enter.
struct Chain {
    int first = -1, length = 0;  ///< in the polygon's sides
    Side side = Side::outside;
    bool mixed = false;  ///< has edges of both sides' fronts
};

/// The boundary of the growing band: the half-edges of outer polygons whose other side is in the band, with their side of the
/// contour.
class BandFront {
  public:
    /// `barrier`: of each patch edge, true where no band grows across.
    BandFront(const Patch& patch, std::vector<char> barrier);

    bool holds(int h) const { return front_[h] != Side::outside && !barrier_[h / 2]; }

    /// Where a polygon, given by its sides, meets the band: the entry rule of 4.2.1. `side`: of each patch vertex.
    Chain meeting(std::span<const int> sides, const std::vector<Side>& side) const;

    /// Moves on past a polygon that enters.
    void pass(std::span<const int> sides, const Chain& chain);

    /// The boundary curve of one side, from the last one's first vertex that is still on it.
    std::vector<int> boundary(Side side, const std::vector<int>& last) const;

  private:
    const Patch& patch_;
    const PatchMesh& mesh_;
    std::vector<char> barrier_;
    std::vector<Side> front_;  // of each half-edge; outside: not on the front

    int from(int h) const { return patch_.from(h); }
    int to(int h) const { return patch_.to(h); }
    /// The band lies on the other side of a barrier: both sides of one never enter.
    bool is_blocked(int h) const { return front_[h] != Side::outside && barrier_[h / 2]; }
    int front_from(int vertex, Side side) const;
    int start_of(Side side, const std::vector<int>& last) const;
    int first_new_vertex(Side side) const;
};

/// The half-edges of the contour's edges on its left, from its first vertex on.
std::vector<int> contour_halfedges(const Patch& patch);

}  // namespace mrc
