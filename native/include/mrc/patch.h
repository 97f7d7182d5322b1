// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <optional>
#include <vector>

namespace mrc {

struct PatchTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using PatchMesh = OpenMesh::TriMesh_ArrayKernelT<PatchTraits>;

/// The neighbourhood of a contour as a triangle mesh of its own, with maps back to the surface.
///
/// It holds the polygons that a band may enter: not hidden, all of whose vertices are regular, within the asked number of rings,
/// where a ring is the polygons that share a vertex with the ring before. Elements are numbered from the contour outwards.
struct Patch {
    PatchMesh mesh;
    std::vector<int> vertex;         ///< surface vertex of each patch vertex
    std::vector<int> halfedge;       ///< surface half-edge of each patch half-edge, -1 on the patch's border
    std::vector<int> polygon;        ///< local polygon of each patch face; a polygon's faces are consecutive
    std::vector<int> polygon_face;   ///< surface face of each local polygon
    std::vector<int> first_face;     ///< patch faces of local polygon p: first_face[p] up to first_face[p + 1]
    std::vector<char> diagonal;      ///< of each patch edge: true where the triangulation alone put it
    std::vector<double> distance;    ///< of each patch vertex: along the surface from the contour
    std::vector<int> contour;        ///< patch vertices of the contour, in order
    bool closed = true;

    int polygon_count() const { return static_cast<int>(polygon_face.size()); }
    bool diagonal_halfedge(int h) const { return diagonal[h / 2] != 0; }
};

/// @throws InvalidInput where the contour is no simple loop (curve) along real edges with a usable polygon on both sides; it names
/// the elements.
void check_contour(const Surface& surface, const Contour& contour);

/// Cuts out the neighbourhood of a contour along mesh edges.
/// `rings`: how far the patch reaches; none: to the whole connected component.
/// @throws InvalidInput as check_contour.
Patch make_patch(const Surface& surface, const Contour& contour, std::optional<int> rings);

}  // namespace mrc
