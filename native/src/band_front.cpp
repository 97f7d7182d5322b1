// SPDX-License-Identifier: GPL-3.0-or-later
#include "band_front.h"

#include "segments.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace mrc {

std::vector<int> contour_halfedges(const Patch& patch) {
    std::vector<int> halfedges;
    for (const auto& [a, b] : segments(patch.contour, patch.closed)) halfedges.push_back(patch.find_halfedge(a, b).idx());
    return halfedges;
}

BandFront::BandFront(const Patch& patch, std::vector<char> barrier)
    : patch_(patch), mesh_(patch.mesh), barrier_(std::move(barrier)), front_(patch.mesh.n_halfedges(), Side::outside) {
    for (const int h : contour_halfedges(patch)) {
        front_[h] = Side::left;
        front_[opposite(h)] = Side::right;
    }
}

Chain BandFront::meeting(std::span<const int> sides, const std::vector<Side>& side) const {
    const int count = static_cast<int>(sides.size());
    Chain chain;
    int fronts = 0, vertices = 0;
    for (int i = 0; i < count; ++i) {
        if (is_blocked(sides[i])) return {};
        vertices += side[from(sides[i])] != Side::outside;
        if (!holds(sides[i])) continue;
        ++fronts;
        const bool starts = !holds(sides[(i + count - 1) % count]);
        if (!starts) continue;
        if (chain.first >= 0) return {};
        chain = {i, 0, front_[sides[i]], false};
    }
    // The chain's own vertices and no others are in the band: so it stays an annulus, and both sides apart.
    if (chain.first < 0 || fronts == count || vertices != fronts + 1) return {};
    for (int i = 0; i < fronts; ++i) chain.mixed |= front_[sides[(chain.first + i) % count]] != chain.side;
    chain.length = fronts;
    return chain;
}

void BandFront::pass(std::span<const int> sides, const Chain& chain) {
    const int count = static_cast<int>(sides.size());
    for (int i = 0; i < count; ++i) {
        const int h = sides[(chain.first + i) % count];
        if (i < chain.length) {
            front_[h] = Side::outside;
        } else {
            front_[opposite(h)] = chain.side;
        }
    }
}

/// Left fronts run along with the contour, right ones against it; those of an open curve begin and end at its ends, which no
/// polygon of one side alone can enclose.
std::vector<int> BandFront::boundary(Side side, const std::vector<int>& last) const {
    const int start = start_of(side, last);
    if (start < 0) return {};
    std::vector<int> curve{start};
    for (int h = front_from(start, side); h >= 0 && to(h) != start; h = front_from(to(h), side)) curve.push_back(to(h));
    if (side == Side::right) std::reverse(curve.begin() + (patch_.closed ? 1 : 0), curve.end());
    return curve;
}

/// The front half-edge that leaves a vertex, or -1.
int BandFront::front_from(int vertex, Side side) const {
    for (const auto h : mesh_.voh_range(PatchMesh::VertexHandle(vertex))) {
        if (front_[h.idx()] == side) return h.idx();
    }
    return -1;
}

int BandFront::start_of(Side side, const std::vector<int>& last) const {
    if (!patch_.closed) return side == Side::left ? patch_.contour.front() : patch_.contour.back();
    for (const int v : last) {
        if (front_from(v, side) >= 0) return v;
    }
    return first_new_vertex(side);
}

/// Where a round left the last boundary altogether: the new boundary's vertex nearest to the contour's first one.
int BandFront::first_new_vertex(Side side) const {
    const auto origin = mesh_.point(PatchMesh::VertexHandle(patch_.contour[0]));
    std::pair<double, int> best{std::numeric_limits<double>::infinity(), -1};
    for (std::size_t h = 0; h < front_.size(); ++h) {
        if (front_[h] != side) continue;
        const int v = from(static_cast<int>(h));
        best = std::min(best, {(mesh_.point(PatchMesh::VertexHandle(v)) - origin).norm(), v});
    }
    return best.second;
}

}  // namespace mrc
