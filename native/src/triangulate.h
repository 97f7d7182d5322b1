// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/errors.h>
#include <mrc/types.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mrc {

/// Cuts polygons into triangles, given as triples of corner numbers with the polygon's winding. Only the corners' positions
/// count, so that equal polygons are cut alike wherever they lie in a mesh. One object serves many polygons and reuses its
/// memory.
class Triangulator {
  public:
    /// The n - 2 triangles of a polygon of n corners; valid until the next call. Of a triangle, no corner need be given.
    ///
    /// Quads are cut along the diagonal inside them (in the plane of Newell's normal), convex ones along the shorter, and at a
    /// tie at the first corner. Larger polygons are cut by clipping ears; where a polygon, or what is left of one, has no ear
    /// because it is degenerate, it becomes a fan.
    std::span<const std::array<int, 3>> operator()(std::span<const Vec3> corners);

  private:
    std::vector<std::array<int, 3>> triangles_;
    std::vector<Eigen::Vector2d> flat_;  ///< the corners in the plane
    std::vector<int> next_, previous_;   ///< the ring of the corners not yet clipped
    std::vector<int> blunt_;             ///< corners that are not convex at the start: only these can lie in an ear

    void clip_ears(const Vec3& normal, std::span<const Vec3> corners);
    bool convex(int corner) const;
    bool ear(int corner, double margin) const;
    void clip(int corner);
    void fan(int corner, int count);
};

/// Tells the sides of a polygon from the diagonals of its triangulation, pairs the diagonals, and finds what is wrong. One object
/// serves many polygons and reuses its memory.
///
/// A triangulation is n - 2 triangles that hold each of the n sides once, in the polygon's direction, and every other edge twice,
/// in opposite directions. That suffices: they form a surface with the polygon as its one border and Euler characteristic 1,
/// which is a disk.
class PolygonSides {
  public:
    explicit PolygonSides(int vertex_count) : vertex_count_(vertex_count) {}

    /// Reads the n - 2 triangles of a polygon, of which the first has the given id. False: they are no triangulation, see
    /// fault().
    bool read(std::span<const int> polygon, std::span<const std::array<int, 3>> triangles, int first_triangle);

    /// Calls visit(a, b) for the two half-edges of each diagonal of the polygon read last, a < b.
    template <class Visit>
    void for_each_diagonal(Visit&& visit) const {
        for (size_t i = 0; i < diagonals_.size(); i += 2) {
            const auto [a, b] = std::minmax(diagonals_[i].halfedge, diagonals_[i + 1].halfedge);
            visit(a, b);
        }
    }

    /// What is wrong with the polygon read last, in words.
    const std::string& fault() const { return fault_; }

  private:
    struct Diagonal {
        int low, high;  ///< corners
        bool rising;
        int halfedge;
    };
    int vertex_count_;
    std::vector<int> corner_;  ///< of the vertices of the polygon read last; of others, anything
    std::vector<uint8_t> seen_;
    std::vector<Diagonal> diagonals_;
    std::string fault_;

    bool read_plain(std::span<const int> polygon, std::span<const std::array<int, 3>> triangles, int first_triangle);
    bool read_side(std::span<const int> polygon, int a, int b, int halfedge);
    bool holds(std::span<const int> polygon, int vertex) const;
    bool pair_diagonals(std::span<const int> polygon);
};

}  // namespace mrc
