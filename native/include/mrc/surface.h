// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/errors.h>
#include <mrc/types.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mrc {

/// The arrays that a surface is made from; they are copied, so the caller may change them afterwards.
struct SurfaceArrays {
    std::span<const double> positions;       ///< x, y, z of each vertex
    std::span<const int32_t> face_offsets;   ///< one more than there are faces; empty: every face is a triangle
    std::span<const int32_t> face_vertices;  ///< face i is face_vertices[face_offsets[i] .. face_offsets[i + 1])
    std::span<const int32_t> triangles;      ///< n - 2 vertex triples for a face of n, in face order; empty: the surface makes them
    std::span<const int32_t> hidden_faces;   ///< ids of faces that no band enters
};

/// Which edges a look-up finds: sides of polygons alone, or diagonals as well.
enum class EdgeKind { real, any };

/// A validated, immutable mesh of polygons with its triangulation and adjacency.
///
/// Half-edge 3 t + c runs from corner c of triangle t to the next corner. An edge is *real* where it is a side of a polygon and a
/// *diagonal* where only the triangulation put it. Borders, edges of three faces or of disagreeing winding, and vertices with
/// more than one fan are legal: they merely stop a band.
///
/// Several threads may use a surface and its copies at once: nothing that they see changes after the constructor.
///
/// @throws InvalidInput for indices out of range, positions that are not finite or beyond 1e50, faces with fewer than three or
/// with repeated vertices, and triangles that do not triangulate their faces. The message names the elements.
class Surface {
  public:
    static constexpr int border = -1;     ///< twin of a half-edge with no other face
    static constexpr int irregular = -2;  ///< twin on an edge of three faces or of disagreeing winding

    explicit Surface(const SurfaceArrays& arrays);

    int vertex_count() const { return static_cast<int>(positions_.size()); }
    int face_count() const { return static_cast<int>(face_offsets_.size()) - 1; }
    int triangle_count() const { return static_cast<int>(triangles_.size()); }
    int halfedge_count() const { return 3 * triangle_count(); }
    int edge_count() const { return edge_count_; }  ///< real edges and diagonals

    const Vec3& position(int vertex) const { return positions_[vertex]; }
    Vec3 position(const SurfacePoint& p) const { return (1.0 - p.t) * positions_[p.a] + p.t * positions_[p.b]; }

    /// The polygon's vertices in order.
    std::span<const int> face(int face) const;
    bool hidden(int face) const { return hidden_[face] != 0; }
    /// A polygon of n vertices holds the n - 2 triangles from first_triangle(face) up to first_triangle(face + 1).
    int first_triangle(int face) const { return face_offsets_[face] - 2 * face; }

    const std::array<int, 3>& triangle(int triangle) const { return triangles_[triangle]; }
    int triangle_face(int triangle) const { return triangle_faces_[triangle]; }

    static int next(int halfedge) { return halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1; }
    static int previous(int halfedge) { return halfedge % 3 == 0 ? halfedge + 2 : halfedge - 1; }
    int from(int halfedge) const { return triangles_[halfedge / 3][halfedge % 3]; }
    int to(int halfedge) const { return from(next(halfedge)); }
    /// The half-edge on the other side, or `border`, or `irregular`.
    int twin(int halfedge) const { return twins_[halfedge]; }
    int edge(int halfedge) const { return edges_[halfedge]; }
    bool diagonal(int halfedge) const { return diagonal_[halfedge] != 0; }
    int halfedge_face(int halfedge) const { return triangle_faces_[halfedge / 3]; }

    /// The half-edges that start at a vertex, ascending.
    std::span<const int> outgoing(int vertex) const;
    /// True where the faces around the vertex form one fan, open or closed, of edges with agreeing winding.
    bool regular(int vertex) const { return regular_[vertex] != 0; }

    /// A half-edge from a to b, or `no_element`: the first by index where there are several.
    int find_halfedge(int a, int b, EdgeKind kind = EdgeKind::real) const;
    /// A half-edge between a and b, from a to b if possible, or `no_element`.
    int find_edge(int a, int b, EdgeKind kind = EdgeKind::real) const {
        const int forward = find_halfedge(a, b, kind);
        return forward >= 0 ? forward : find_halfedge(b, a, kind);
    }
    /// True where a and b are the ends of a real edge, in whichever direction its faces run.
    bool real_edge(int a, int b) const { return find_edge(a, b) >= 0; }

    /// The area-weighted mean distance of the face centroids of a vertex's connected component from the component's centroid. The
    /// first call computes it for all components; several threads may call it at once.
    double average_radius(int vertex) const;

    /// Calls visit(neighbor, edge) for the real edges at a vertex; an irregular edge may be visited more than once.
    template <class Visit>
    void for_each_real_edge(int vertex, Visit&& visit) const {
        for (const int h : outgoing(vertex)) {
            if (!diagonal(h)) visit(to(h), edge(h));
            const int incoming = previous(h);
            if (twin(incoming) < 0 && !diagonal(incoming)) visit(from(incoming), edge(incoming));
        }
    }

  private:
    std::vector<Vec3> positions_;
    std::vector<int> face_offsets_;
    std::vector<int> face_vertices_;  // empty where all faces are triangles: triangles_ holds them
    std::vector<std::array<int, 3>> triangles_;
    std::vector<int> triangle_faces_, twins_, edges_, outgoing_offsets_, outgoing_;
    std::vector<uint8_t> diagonal_, regular_, hidden_;
    int edge_count_ = 0;
    struct Components;
    std::shared_ptr<Components> components_;

    void copy_and_validate(const SurfaceArrays& arrays);
    void triangulate(const SurfaceArrays& arrays);
    void cut_polygons();
    void pair_diagonals();
    void connect();
    void sort_outgoing();
    void number_edges();
    void classify_vertices();
    size_t fan_size(int start) const;
};

}  // namespace mrc
