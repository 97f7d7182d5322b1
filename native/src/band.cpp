// SPDX-License-Identifier: GPL-3.0-or-later
#include "band.h"

#include "band_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace mrc {
namespace {

/// The real half-edges around each polygon, in its own direction.
class PolygonHalfedges {
  public:
    explicit PolygonHalfedges(const Patch& patch) {
        first_.push_back(0);
        for (int p = 0; p < patch.polygon_count(); ++p) {
            append(patch, p);
            first_.push_back(static_cast<int>(sides_.size()));
        }
    }
    std::span<const int> operator[](int polygon) const {
        return std::span(sides_).subspan(first_[polygon], first_[polygon + 1] - first_[polygon]);
    }

  private:
    std::vector<int> first_, sides_;

    void append(const Patch& patch, int polygon) {
        // A triangle of the polygon may have no real side; from its first face one is reached all the same.
        const Halfedge start = patch.next_side(patch.mesh.halfedge_handle(PatchMesh::FaceHandle(patch.first_face[polygon])));
        Halfedge h = start;
        do {
            sides_.push_back(h.idx());
            h = patch.next_side(h);
        } while (h != start);
    }
};

/// The order in which polygons compete: of distance, rounded so that equal ones stay equal under rounding; then of position.
/// Gives the place of each.
std::vector<int> polygon_ranks(const Patch& patch, const PolygonHalfedges& sides, const Beat& beat) {
    double length = 0.0;
    for (const int h : contour_halfedges(patch)) length += patch.mesh.calc_edge_length(Halfedge(h));
    using Key = std::tuple<double, double, double, double, int>;
    std::vector<Key> keys;
    for (int p = 0; p < patch.polygon_count(); ++p) {
        beat_at(static_cast<std::size_t>(p), beat);
        double distance = 0.0;
        PatchMesh::Point center(0.0);
        for (const int h : sides[p]) {
            const auto from = patch.mesh.from_vertex_handle(Halfedge(h));
            distance += patch.distance[from.idx()];
            center += patch.mesh.point(from);
        }
        const auto count = static_cast<double>(sides[p].size());
        const double quantum = 1e-9 * length * count;
        keys.emplace_back(std::round(distance / quantum), center[0] / count, center[1] / count, center[2] / count, p);
    }
    std::ranges::sort(keys);
    std::vector<int> ranks(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) ranks[std::get<4>(keys[i])] = static_cast<int>(i);
    return ranks;
}

/// Marks the patch edges that are a barrier, or a wall of the exclusion.
std::vector<char> barrier_edges(const Patch& patch, const Constraints& constraints, const Exclusion& exclusion) {
    std::vector<char> barrier = exclusion.wall;
    barrier.resize(patch.mesh.n_edges(), 0);
    if (constraints.barriers.empty()) return barrier;
    std::unordered_map<int, int> local;
    for (std::size_t v = 0; v < patch.vertex.size(); ++v) local.emplace(patch.vertex[v], static_cast<int>(v));
    for (const auto& [a, b] : constraints.barriers) {
        const auto p = local.find(a), q = local.find(b);
        if (p == local.end() || q == local.end()) continue;
        const auto h = patch.find_halfedge(p->second, q->second);
        if (h.is_valid()) barrier[h.idx() / 2] = 1;
    }
    return barrier;
}

/// Dilates the band round by round, and closes its disk beyond the ends of an open curve.
class Grower {
  public:
    Grower(const Patch& patch, double farthest, const Constraints& constraints, const Exclusion& exclusion, const Beat& beat)
        : patch_(patch),
          beat_(beat),
          mesh_(patch.mesh),
          sides_(patch),
          farthest_(farthest),
          refused_(exclusion.refused),
          front_(patch, barrier_edges(patch, constraints, exclusion)),
          rank_(polygon_ranks(patch, sides_, beat)) {
        band_.face.assign(mesh_.n_faces(), 0);
        band_.side.assign(mesh_.n_vertices(), Side::outside);
        band_.round.assign(mesh_.n_vertices(), -1);
        polygon_in_.assign(patch.polygon_count(), 0);
        refused_.resize(patch.polygon_count(), 0);
        for (const int v : patch.contour) admit(v, Side::contour, 0);
        band_.left.push_back(patch.contour);
        band_.right.push_back(patch.contour);
    }

    Band grow(std::optional<int> width) {
        for (int round = 1; !width || round <= *width; ++round) {
            if (!grow_round(round)) break;
            band_.rounds = round;
            band_.left.push_back(front_.boundary(Side::left, band_.left.back()));
            band_.right.push_back(front_.boundary(Side::right, band_.right.back()));
        }
        if (!patch_.closed) close_ends();
        mark_edges();
        std::ranges::sort(band_.refused);
        return std::move(band_);
    }

  private:
    const Patch& patch_;
    const Beat& beat_;
    const PatchMesh& mesh_;
    PolygonHalfedges sides_;
    double farthest_;            // how far from the contour the third and later rounds may reach
    std::vector<char> refused_;  // of each polygon
    Band band_;
    BandFront front_;
    std::vector<char> polygon_in_;
    std::vector<int> rank_;        // of each polygon in the order of distance
    std::vector<int> candidates_;  // polygons that might enter in the last round

    int from(int h) const { return patch_.from(h); }
    int polygon_of(int h) const {
        const auto face = mesh_.face_handle(Halfedge(h));
        return face.is_valid() ? patch_.polygon[face.idx()] : -1;
    }
    bool inside(int vertex) const { return band_.side[vertex] != Side::outside; }

    void admit(int vertex, Side side, int round) {
        band_.side[vertex] = side;
        band_.round[vertex] = round;
    }

    void enter(int polygon, const Chain& chain, int round) {
        const auto sides = sides_[polygon];
        const int count = static_cast<int>(sides.size());
        for (int i = chain.length; i < count; ++i) {
            const int vertex = from(sides[(chain.first + i) % count]);
            if (!inside(vertex)) admit(vertex, chain.side, round);
        }
        front_.pass(sides, chain);
        polygon_in_[polygon] = 1;
        band_.polygons.push_back(polygon);
        band_.polygon_side.push_back(chain.side);
        for (int f = patch_.first_face[polygon]; f < patch_.first_face[polygon + 1]; ++f) band_.face[f] = 1;
    }

    bool too_far(int polygon) const {
        return std::ranges::any_of(sides_[polygon], [&](int h) { return patch_.distance[from(h)] > farthest_; });
    }

    /// The polygons outside that share a vertex with the boundaries of the round before, and are not too far.
    std::vector<int> candidates(int round) const {
        std::vector<int> found;
        for (const auto* curve : {&band_.left.back(), &band_.right.back()}) {
            for (const int v : *curve) {
                for (const auto face : mesh_.vf_range(PatchMesh::VertexHandle(v))) {
                    const int polygon = patch_.polygon[face.idx()];
                    if (!polygon_in_[polygon]) found.push_back(polygon);
                }
            }
        }
        std::ranges::sort(found);
        found.erase(std::ranges::unique(found).begin(), found.end());
        if (round > 2) std::erase_if(found, [&](int polygon) { return too_far(polygon); });
        return found;
    }

    /// Takes out those that belong to others, and notes the ones that the band has met.
    void leave_to_others(std::vector<int>& polygons) {
        std::erase_if(polygons, [&](int polygon) {
            if (refused_[polygon] == 0) return false;
            if (refused_[polygon] == 1 && std::ranges::any_of(sides_[polygon], [&](int h) { return front_.holds(h); })) {
                refused_[polygon] = 2;  // once is enough
                band_.refused.push_back(polygon);
            }
            return true;
        });
    }

    /// One round of dilation. A polygon that may not enter yet is tried again after each neighbor that does.
    bool grow_round(int round) {
        beat_at(0, beat_);
        std::vector<char> eligible(patch_.polygon_count(), 0);
        using Entry = std::pair<int, int>;  // rank, polygon
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        candidates_ = candidates(round);
        leave_to_others(candidates_);
        for (const int polygon : candidates_) {
            eligible[polygon] = 1;
            queue.emplace(rank_[polygon], polygon);
        }
        bool grown = false;
        while (!queue.empty()) {
            const int polygon = queue.top().second;
            queue.pop();
            beat_at(band_.polygons.size(), beat_);
            if (polygon_in_[polygon]) continue;
            const Chain chain = front_.meeting(sides_[polygon], band_.side);
            if (chain.length == 0 || chain.mixed) continue;
            enter(polygon, chain, round);
            grown = true;
            for (const int h : sides_[polygon]) {
                const int neighbor = polygon_of(opposite(h));
                if (neighbor >= 0 && eligible[neighbor] && !polygon_in_[neighbor]) queue.emplace(rank_[neighbor], neighbor);
            }
        }
        return grown;
    }

    /// While the sides of an open curve grow they stay apart, so that each boundary runs from end to end. Now the last round's
    /// polygons that lie between the two close the gaps beyond the ends.
    void close_ends() {
        std::ranges::sort(candidates_, {}, [&](int polygon) { return rank_[polygon]; });
        for (bool grown = true; grown;) {
            grown = false;
            for (const int polygon : candidates_) {
                if (polygon_in_[polygon]) continue;
                const Chain chain = front_.meeting(sides_[polygon], band_.side);
                if (chain.length == 0) continue;
                enter(polygon, chain, earliest_round(polygon) + 1);
                ++band_.end_polygons;
                band_.polygon_side.back() = Side::contour;
                grown = true;
            }
        }
    }

    int earliest_round(int polygon) const {
        int earliest = std::numeric_limits<int>::max();
        for (const int h : sides_[polygon]) {
            if (inside(from(h))) earliest = std::min(earliest, band_.round[from(h)]);
        }
        return earliest;
    }

    void mark_edges() {
        band_.edge.assign(mesh_.n_edges(), 0);
        for (const int h : contour_halfedges(patch_)) band_.edge[h / 2] = 1;
        for (std::size_t f = 0; f < band_.face.size(); ++f) {
            if (!band_.face[f]) continue;
            beat_at(f, beat_);
            for (const auto e : mesh_.fe_range(PatchMesh::FaceHandle(static_cast<int>(f)))) band_.edge[e.idx()] = 1;
        }
    }
};

}  // namespace

Band grow_band(const Surface& surface, const Patch& patch, const Options& options, const Constraints& constraints,
               const Exclusion& exclusion, const Beat& beat) {
    const double radius = options.band_distance ? surface.average_radius(patch.vertex[patch.contour[0]]) : 0.0;
    const double farthest = options.band_distance ? *options.band_distance * radius : std::numeric_limits<double>::infinity();
    return Grower(patch, farthest, constraints, exclusion, beat).grow(options.width);
}

}  // namespace mrc
