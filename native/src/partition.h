// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "band.h"
#include "exclusion.h"
#include "patch.h"

#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mrc {

/// Divides a surface among contours that move at the same time, so that none can cross or touch another (1.4).
///
/// A polygon belongs to the contour that runs through it, or else to the nearest of those whose patches hold it, by the sum of
/// its vertices' distances; in a tie to none. So two bands have at most vertices and edges in common, and these are closed to
/// both. A contour's own points, as first given and as it lies now, are open to it and closed to all others, so that it can
/// always stay or go back. Nothing here depends on the order of the contours.
class Partition {
  public:
    explicit Partition(const Surface& surface) : surface_(surface) {}

    /// Where a contour lies; called for the given one and for the current one.
    void occupy(int contour, const Contour& where);
    /// The polygons that a contour's band might enter.
    void claim(int contour, const Patch& patch);
    /// The other contours that run through the same faces as this one: it cannot move without passing them.
    std::vector<int> entangled_with(int contour, const Contour& where) const;
    /// `refused` and `wall`, once all have occupied and claimed.
    Exclusion exclusion(int contour, const Patch& patch) const;

    /// The vertices and edges of a contour's band.
    void enclose(int contour, const Patch& patch, const Band& band);
    /// `closed_vertex` and `closed_edge`, once all bands are enclosed.
    void close(int contour, const Patch& patch, Exclusion& exclusion) const;

    /// The contours that keep the band from growing or the contour from using its vertices, ascending.
    std::vector<int> held_back_by(int contour, const Patch& patch, const Band& band) const;
    /// True where another contour passes a vertex.
    bool shares(int contour, int vertex) const;

  private:
    using Owners = std::unordered_map<int, std::vector<int>>;  // of elements of the surface
    using Claims = std::unordered_map<int, std::vector<std::pair<int, double>>>;

    const Surface& surface_;
    Owners vertices_, edges_, faces_;    // that the contours occupy
    Owners band_vertices_, band_edges_;  // that the bands hold
    Claims claims_;                      // contour and distance, of each face

    static void add(Owners& owners, int element, int contour);
    static std::span<const int> owners_of(const Owners& owners, int element);
    static bool has_other(std::span<const int> owners, int contour);
    std::vector<int> refusing(int contour, int face) const;
    int edge_of(const Patch& patch, int e) const;
};

}  // namespace mrc
