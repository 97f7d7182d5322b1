// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include "beat.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace mrc {

struct PatchTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using PatchMesh = OpenMesh::TriMesh_ArrayKernelT<PatchTraits>;
using Halfedge = PatchMesh::HalfedgeHandle;
using Curve = std::vector<int>;  ///< patch vertices in order, each joined to the next by an edge

/// The two half-edges of patch edge e are 2 e and 2 e + 1.
inline int opposite(int halfedge) { return halfedge ^ 1; }

/// The neighborhood of a contour as a triangle mesh of its own, with maps back to the surface.
///
/// It holds the polygons that a band may enter: not hidden, all of whose vertices are regular, within the asked number of rings,
/// where a ring is the polygons that share a vertex with the ring before. Elements are numbered from the contour outwards.
struct Patch {
    PatchMesh mesh;
    std::vector<int> vertex;        ///< surface vertex of each patch vertex
    std::vector<int> halfedge;      ///< surface half-edge of each patch half-edge, -1 on the patch's border
    std::vector<int> polygon;       ///< local polygon of each patch face; a polygon's faces are consecutive
    std::vector<int> polygon_face;  ///< surface face of each local polygon
    std::vector<int> first_face;    ///< patch faces of local polygon p: first_face[p] up to first_face[p + 1]
    std::vector<char> diagonal;     ///< of each patch edge: true where only the triangulation adds it
    std::vector<char> border_edge;  ///< of each patch edge: true on the border of the mesh, where no contour runs
    std::vector<double> distance;   ///< of each patch vertex: along the surface from the contour as given
    Contour given;                  ///< the contour as given
    std::vector<int> contour;       ///< patch vertices of the contour, or of the nearest simple one along mesh edges, in order
    bool closed = true;
    bool first_end_held = false,
         last_end_held = false;  ///< of an open curve: another contour shares the end, which therefore stays

    int polygon_count() const { return static_cast<int>(polygon_face.size()); }
    bool diagonal_halfedge(int h) const { return diagonal[h / 2] != 0; }
    int from(int h) const { return mesh.from_vertex_handle(Halfedge(h)).idx(); }
    int to(int h) const { return mesh.to_vertex_handle(Halfedge(h)).idx(); }
    /// The half-edge from vertex a to vertex b; invalid where there is none.
    Halfedge find_halfedge(int a, int b) const {
        return mesh.find_halfedge(PatchMesh::VertexHandle(a), PatchMesh::VertexHandle(b));
    }
    /// The real half-edge that follows one around its polygon.
    Halfedge next_side(Halfedge h) const {
        h = mesh.next_halfedge_handle(h);
        while (diagonal_halfedge(h.idx())) h = mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(h));
        return h;
    }
    /// A surface half-edge of a patch edge.
    int edge_halfedge(int e) const { return std::max(halfedge[2 * e], halfedge[2 * e + 1]); }
};

/// The contour with its ends of edges written as vertices.
/// @throws InvalidInput where it is no simple loop (curve) on the surface's edges and across its faces, with a usable polygon on
/// one side at least, and not on the border; it names the elements.
Contour checked_contour(const Surface& surface, const Contour& contour);

/// True where a refined contour has a simple contour along mesh edges beside it, from which a band can grow.
bool has_neighbor_along_edges(const Surface& surface, const Contour& contour);

/// Cuts out the neighborhood of a contour that `checked_contour` gave.
/// @throws InvalidInput where it has no neighbor along edges.
/// `rings`: how far the patch reaches; none: to the whole connected component.
Patch make_patch(const Surface& surface, const Contour& contour, std::optional<int> rings, const Beat& beat = {});

}  // namespace mrc
