// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow.h"

#include "segments.h"
#include "sparse_cholesky.h"
#include "strip_flow.h"

#include <algorithm>

namespace mrc {
namespace {

/// The half-edges that a shortest chain of faces crosses on its path out of the band, from the face of half-edge `first` and
/// without crossing the contour. Empty where `first` itself is on the band's border.
std::vector<int> path_out(const Patch& patch, const Band& band, int first) {
    const PatchMesh& mesh = patch.mesh;
    const auto face_of = [&](int h) {
        const auto face = mesh.face_handle(Halfedge(h));
        return face.is_valid() && band.face[face.idx()] ? face.idx() : -1;
    };
    std::vector<char> met(mesh.n_faces(), 0), wall(mesh.n_halfedges(), 0);
    for (const auto& [a, b] : segments(patch.contour, patch.closed)) {
        const int h = patch.find_halfedge(a, b).idx();
        wall[h] = wall[opposite(h)] = 1;
    }
    struct Step {
        int face, through, before;  // the face, the half-edge of the last face that led here, and that step
    };
    std::vector<Step> steps;
    const auto enter = [&](int face, int through, int before) {
        if (met[face]) return;
        met[face] = 1;
        steps.push_back({face, through, before});
    };
    if (face_of(first) >= 0) enter(face_of(first), -1, -1);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        for (const auto h : mesh.fh_range(PatchMesh::FaceHandle(steps[i].face))) {
            if (wall[h.idx()]) continue;
            if (face_of(opposite(h.idx())) >= 0) {
                enter(face_of(opposite(h.idx())), h.idx(), static_cast<int>(i));
                continue;
            }
            std::vector<int> path{h.idx()};
            for (int s = static_cast<int>(i); steps[s].before >= 0; s = steps[s].before) path.push_back(steps[s].through);
            return path;
        }
    }
    return {};
}

/// A closed 1-form of whole numbers with period 1: it counts the crossings of a chain of faces across the band.
std::vector<int> crossing_form(const Patch& patch, const Band& band) {
    std::vector<int> jump(patch.mesh.n_halfedges(), 0);
    const int h = patch.find_halfedge(patch.contour[0], patch.contour[1]).idx();
    const auto cross = [&](int halfedge, int sign) {
        jump[halfedge] += sign;
        jump[opposite(halfedge)] -= sign;
    };
    // The chain runs from right to left; what crosses it from its left to its right runs along with the contour.
    cross(h, 1);
    for (const int leaving : path_out(patch, band, h)) cross(leaving, -1);
    for (const int leaving : path_out(patch, band, opposite(h))) cross(leaving, 1);
    return jump;
}

/// Fixed values: closed, 0 at the contour's first vertex; open, 0 at the first and 1 at the last, and for free ends on the border
/// all along the pieces of mesh border that hold them.
std::vector<double> fixed_values(const Patch& patch, const Band& band, const Options& options) {
    std::vector<double> fixed(patch.vertex.size(), -1.0);
    fixed[patch.contour.front()] = 0.0;
    if (patch.closed) return fixed;
    fixed[patch.contour.back()] = 1.0;
    const int front = patch.contour.front(), back = patch.contour.back();
    for (const int v : sliding_piece(patch, band, options, front, back, patch.first_end_held)) fixed[v] = 0.0;
    for (const int v : sliding_piece(patch, band, options, back, front, patch.last_end_held)) fixed[v] = 1.0;
    return fixed;
}

/// The harmonic flow: of all flows the one of least sum of squared increments over the real edges.
Flow harmonic_flow(const Patch& patch, const Band& band, const Options& options, const Beat& beat) {
    const PatchMesh& mesh = patch.mesh;
    Flow flow{fixed_values(patch, band, options), {}};
    flow.jump = patch.closed ? crossing_form(patch, band) : std::vector<int>(mesh.n_halfedges(), 0);
    std::vector<int> unknown(mesh.n_vertices(), -1);
    int count = 0;
    for (std::size_t v = 0; v < unknown.size(); ++v) {
        if (band.side[v] != Side::outside && flow.value[v] < 0.0) unknown[v] = count++;
    }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    const auto add = [&](int a, int b, int jump) {  // the equation of vertex a: sum over b of (u_a - u_b) = sum of jumps
        if (unknown[a] < 0) return;
        entries.emplace_back(unknown[a], unknown[a], 1.0);
        if (unknown[b] >= 0) entries.emplace_back(unknown[a], unknown[b], -1.0);
        right[unknown[a]] += jump + (unknown[b] >= 0 ? 0.0 : flow.value[b]);
    };
    for (int h = 0; h < static_cast<int>(mesh.n_halfedges()); h += 2) {
        if (!band.edge[h / 2] || patch.diagonal_halfedge(h)) continue;
        const int a = patch.from(h), b = patch.to(h);
        add(a, b, flow.jump[h]);
        add(b, a, flow.jump[opposite(h)]);
    }
    if (beat) beat();
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (beat) beat();
    const SparseCholesky solver(matrix, beat);
    const Eigen::VectorXd solution = solver.solve(right);
    if (beat) beat();
    for (std::size_t v = 0; v < unknown.size(); ++v) {
        if (unknown[v] >= 0) flow.value[v] = solution[unknown[v]];
        if (band.side[v] == Side::outside) flow.value[v] = 0.0;
    }
    return flow;
}

}  // namespace

std::vector<int> border_piece(const Patch& patch, const Band& band, int vertex) {
    const PatchMesh& mesh = patch.mesh;
    std::vector<int> piece{vertex};
    for (std::size_t i = 0; i < piece.size(); ++i) {
        for (const auto h : mesh.voh_range(PatchMesh::VertexHandle(piece[i]))) {
            const int edge = h.idx() / 2, next = mesh.to_vertex_handle(h).idx();
            // The border of the mesh, not merely of the patch.
            if (!band.edge[edge] || patch.diagonal[edge] || !patch.border_edge[edge]) continue;
            if (std::ranges::find(piece, next) == piece.end()) piece.push_back(next);
        }
    }
    if (piece.size() == 1) piece.clear();
    return piece;
}

std::vector<int> sliding_piece(const Patch& patch, const Band& band, const Options& options, int end, int other, bool held) {
    if (held || (options.ends != Ends::border && options.ends != Ends::edges_or_border)) return {};
    std::vector<int> piece = border_piece(patch, band, end);
    if (std::ranges::find(piece, other) != piece.end()) piece.clear();
    return piece;
}

Flow make_flow(const Patch& patch, const Band& band, const Options& options, const Beat& beat) {
    if (options.flow == FlowKind::harmonic) return harmonic_flow(patch, band, options, beat);
    return strip_flow(patch, band, options.flow, fixed_values(patch, band, options), beat);
}

}  // namespace mrc
