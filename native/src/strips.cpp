// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow.h"

#include "segments.h"

#include <algorithm>

namespace mrc {
namespace {

/// Replays the growth of one side of the band, in layers whose outer borders are the strip boundaries.
///
/// Polygons enter in the band's order, but each one as early as two rules allow: never in a layer before an older polygon that it
/// touches, and, where it swallows a vertex, only in the layer after the one in which that vertex came. By the first rule each
/// polygon meets what it met when the band grew, so every layer ends in a simple curve, and that curve encloses the one before;
/// by the second every vertex is on such a curve. A new round opens a new layer, so the boundaries of the rounds are among them.
/// An edge cannot cross a curve of edges and no vertex lies between two neighboring strips: hence the ends of every edge are on
/// the same strip or on neighboring ones. Around an open curve all strips run from its first vertex to its last.
class SideReplay {
  public:
    /// `curves`: the boundary after each round, running so that the side lies to the left; the first is the contour.
    SideReplay(const Patch& patch, const std::vector<Curve>& curves);

    /// Lets a polygon of the band enter; one of the other side is passed over.
    void enter(int polygon);

    /// The border of each layer, running along with the contour.
    std::vector<Curve> strips() const;

  private:
    const Patch& patch_;
    const int first_;                           // vertex of the contour
    std::vector<int> next_;                     // of each vertex of the contour: the vertex after it, or -1
    std::vector<int> last_round_;               // of each half-edge: the last round whose boundary it runs along, or -1
    std::vector<int> polygon_layer_;            // 0: not entered
    std::vector<int> arrival_;                  // of each vertex: the layer in which it came, 0 on the contour, -1 before it came
    std::vector<int> latest_;                   // of each vertex: the last layer of a polygon at it
    std::vector<int> stays_;                    // of each vertex: the last polygon after whose entrance it was still on the border
    std::vector<std::vector<int>> new_border_;  // of each layer: the half-edges that its polygons show outwards, in order
    int round_ = 0;
    int base_ = 0;  // the first layer of the current round

    int from(int h) const { return patch_.from(h); }
    int to(int h) const { return patch_.to(h); }
    bool meets_band(int h) const;
    void split_sides(int polygon, std::vector<int>& inner, std::vector<int>& outer) const;
    int find_layer(int polygon, const std::vector<int>& inner, const std::vector<int>& outer);
    Curve walk(const std::vector<int>& next, int start) const;
};

SideReplay::SideReplay(const Patch& patch, const std::vector<Curve>& curves)
    : patch_(patch),
      first_(curves[0].front()),
      next_(patch.mesh.n_vertices(), -1),
      last_round_(patch.mesh.n_halfedges(), -1),
      polygon_layer_(patch.polygon_count(), 0),
      arrival_(patch.mesh.n_vertices(), -1),
      latest_(patch.mesh.n_vertices(), 0),
      stays_(patch.mesh.n_vertices(), -1),
      new_border_(1) {
    for (const int v : curves[0]) arrival_[v] = 0;
    for (size_t r = 0; r < curves.size(); ++r) {
        for (const auto& [a, b] : segments(curves[r], patch.closed)) {
            last_round_[patch.find_halfedge(a, b).idx()] = static_cast<int>(r);
            if (r == 0) next_[a] = b;
        }
    }
}

/// True for a polygon's half-edge that the band has reached from below, on this side.
bool SideReplay::meets_band(int h) const {
    if (last_round_[h] >= 0) return true;
    const auto below = patch_.mesh.face_handle(Halfedge(opposite(h)));
    return below.is_valid() && polygon_layer_[patch_.polygon[below.idx()]] > 0 && last_round_[opposite(h)] < 0;
}

void SideReplay::split_sides(int polygon, std::vector<int>& inner, std::vector<int>& outer) const {
    for (int f = patch_.first_face[polygon]; f < patch_.first_face[polygon + 1]; ++f)
        for (const auto h : patch_.mesh.fh_range(PatchMesh::FaceHandle(f)))
            if (!patch_.diagonal_halfedge(h.idx())) (meets_band(h.idx()) ? inner : outer).push_back(h.idx());
}

int SideReplay::find_layer(int polygon, const std::vector<int>& inner, const std::vector<int>& outer) {
    for (const int h : inner) {
        if (last_round_[h] < round_) continue;
        round_ = last_round_[h] + 1;
        base_ = static_cast<int>(new_border_.size());
    }
    for (const int h : outer) stays_[from(h)] = stays_[to(h)] = polygon;
    int layer = base_;
    for (const int h : inner)
        for (const int v : {from(h), to(h)}) layer = std::max({layer, latest_[v], stays_[v] == polygon ? 0 : arrival_[v] + 1});
    return layer;
}

void SideReplay::enter(int polygon) {
    std::vector<int> inner, outer;
    split_sides(polygon, inner, outer);
    if (inner.empty()) return;
    const int layer = find_layer(polygon, inner, outer);
    polygon_layer_[polygon] = layer;
    new_border_.resize(std::max<size_t>(new_border_.size(), layer + 1));
    new_border_[layer].insert(new_border_[layer].end(), outer.begin(), outer.end());
    for (const int h : inner) latest_[from(h)] = latest_[to(h)] = layer;
    for (const int h : outer) {
        for (const int v : {from(h), to(h)}) {
            latest_[v] = layer;
            if (arrival_[v] < 0) arrival_[v] = layer;
        }
    }
}

Curve SideReplay::walk(const std::vector<int>& next, int start) const {
    Curve curve;
    for (int v = start; v >= 0 && (curve.empty() || v != start); v = next[v]) curve.push_back(v);
    return curve;
}

std::vector<Curve> SideReplay::strips() const {
    std::vector<Curve> result;
    std::vector<int> next = next_;
    for (size_t layer = 1; layer < new_border_.size(); ++layer) {
        for (const int h : new_border_[layer]) next[to(h)] = from(h);
        result.push_back(walk(next, patch_.closed ? to(new_border_[layer].back()) : first_));
    }
    return result;
}

std::vector<Curve> side_strips(const Patch& patch, const Band& band, const std::vector<Curve>& curves) {
    SideReplay replay(patch, curves);
    for (size_t i = 0; i + band.end_polygons < band.polygons.size(); ++i) replay.enter(band.polygons[i]);
    return replay.strips();
}

/// The right side is the left side of the contour run backwards.
std::vector<Curve> backwards(std::vector<Curve> curves) {
    for (Curve& curve : curves) std::reverse(curve.begin(), curve.end());
    return curves;
}

}  // namespace

std::vector<Curve> strip_boundaries(const Patch& patch, const Band& band) {
    std::vector<Curve> strips = backwards(side_strips(patch, band, backwards(band.right)));
    std::reverse(strips.begin(), strips.end());
    strips.push_back(band.left.front());
    for (Curve& strip : side_strips(patch, band, band.left)) strips.push_back(std::move(strip));
    return strips;
}

}  // namespace mrc
