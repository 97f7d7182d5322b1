// SPDX-License-Identifier: GPL-3.0-or-later
#include "start_line.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace mrc {
namespace {

using Vertex = PatchMesh::VertexHandle;

Curve across(const std::vector<int>& before, int last) {
    Curve path;
    for (int v = last; v >= 0; v = before[v]) path.push_back(v);
    std::reverse(path.begin(), path.end());
    return path;
}

/// A cut as in 4.2.2: the shortest path along real edges across the band, from its right border to its left one.
Curve start_line(const Patch& patch, const Band& band, const Curve& right, const Curve& left) {
    const PatchMesh& mesh = patch.mesh;
    std::vector<double> distance(mesh.n_vertices(), std::numeric_limits<double>::infinity());
    std::vector<int> before(mesh.n_vertices(), -1);
    std::vector<char> goal(mesh.n_vertices(), 0);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const int v : left) goal[v] = 1;
    for (const int v : right) queue.emplace(distance[v] = 0.0, v);
    while (!goal[queue.top().second]) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) continue;
        for (const auto h : mesh.voh_range(Vertex(v))) {
            if (!band.edge[h.idx() / 2] || patch.diagonal_halfedge(h.idx())) continue;
            const int w = mesh.to_vertex_handle(h).idx();
            const double through = d + mesh.calc_edge_length(h);
            if (through >= distance[w]) continue;
            distance[w] = through;
            before[w] = v;
            queue.emplace(through, w);
        }
    }
    return across(before, queue.top().second);
}

/// Marks the corners behind the line: at each of its vertices those from the next edge of the line, or the left border, around to
/// the edge before, or the right border.
void mark_behind(const Patch& patch, const Band& band, Halfedge left_border, OpenedBand& cut) {
    const PatchMesh& mesh = patch.mesh;
    const auto in_band = [&](Halfedge h) { return mesh.face_handle(h).is_valid() && band.face[mesh.face_handle(h).idx()]; };
    for (size_t k = 0; k < cut.line.size(); ++k) {
        Halfedge h = k + 1 < cut.line.size() ? patch.find_halfedge(cut.line[k], cut.line[k + 1]) : left_border;
        const Halfedge stop = k > 0 ? patch.find_halfedge(cut.line[k], cut.line[k - 1]) : Halfedge();
        for (; h != stop && in_band(h); h = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h))) cut.behind[h.idx()] = 1;
    }
}

}  // namespace

OpenedBand cut_open(const Patch& patch, const Band& band, const std::vector<Curve>& strips) {
    const PatchMesh& mesh = patch.mesh;
    OpenedBand cut{{}, std::vector<char>(mesh.n_halfedges(), 0), std::vector<int>(mesh.n_halfedges(), 0)};
    if (!patch.closed) return cut;
    cut.line = start_line(patch, band, strips.front(), strips.back());
    const Curve& left = strips.back();
    const auto end = std::find(left.begin(), left.end(), cut.line.back());
    const Halfedge border = patch.find_halfedge(*end, end == left.begin() ? left.back() : *(end - 1));
    mark_behind(patch, band, border, cut);
    for (const auto f : mesh.faces()) {
        if (!band.face[f.idx()]) continue;
        for (const auto h : mesh.fh_range(f)) {
            cut.jump[h.idx()] = cut.behind[mesh.next_halfedge_handle(h).idx()] - cut.behind[h.idx()];
            cut.jump[opposite(h.idx())] = -cut.jump[h.idx()];
        }
    }
    // The border's edge lies behind the line also where it is a contour edge without a face.
    cut.jump[border.idx()] = -1;
    cut.jump[opposite(border.idx())] = 1;
    return cut;
}

}  // namespace mrc
