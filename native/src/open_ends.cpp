// SPDX-License-Identifier: GPL-3.0-or-later
#include "open_ends.h"

#include "required_chords.h"

#include <algorithm>
#include <vector>

namespace mrc {
namespace {

/// The points at which an open curve may end.
std::vector<char> end_points(const GraphInput& input, const SurfacePoint& end, const SurfacePoint& other, bool held) {
    const AmbientGraph& ambient = input.ambient;
    const Patch& patch = input.patch;
    std::vector<char> allowed(ambient.point_count(), 0);
    if (const int point = ambient.point_at(patch, end); point >= 0) allowed[point] = 1;
    if (!end.is_vertex() || !other.is_vertex()) return allowed;
    const int own = ambient.local.at(end.a), others = ambient.local.at(other.a);
    for (const int v : sliding_piece(patch, input.band, input.options, own, others, held)) {
        allowed[ambient.point_of_vertex[v]] = 1;
        for (const auto h : patch.mesh.voh_range(PatchMesh::VertexHandle(v))) {
            const int first = patch.border_edge[h.idx() / 2] ? ambient.first_point_of_edge[h.idx() / 2] : -1;
            for (int i = 0; first >= 0 && i < ambient.steiner; ++i) allowed[first + i] = 1;
        }
    }
    return allowed;
}

class OpenEnds {
  public:
    OpenEnds(const GraphInput& input, const Chords& chords) : surface_(input.surface), energy_(input.energy), chords_(chords) {}

    /// A path that begins or ends at the level of a required vertex begins or ends there.
    bool may_begin(int chord) const { return allows(chords_.chords[chord].tail, 0, sign(chords_.sites[chord].climb)); }
    bool may_end(int chord) const { return allows(chords_.chords[chord].head, sign(chords_.sites[chord].climb), 0); }

    Terminal source(int chord) const {
        const Frame frame = energy_.frame(place(chords_.chords[chord].tail));
        return half(chord, frame, {}, chord_end(chord, frame));
    }
    Terminal destination(int chord) const {
        const Frame frame = energy_.frame(place(chords_.chords[chord].head));
        return half(chord, frame, chord_end(chord, frame), {});
    }

  private:
    const Surface& surface_;
    const Energy& energy_;
    const Chords& chords_;

    const SurfacePoint& place(int point) const { return chords_.points[point].place; }

    bool allows(int point, int climb_in, int climb_out) const {
        return chords_.required_elements.allows_arc(place_of(chords_.points, point), climb_in, climb_out);
    }
    ChordEnd chord_end(int chord, const Frame& frame) const {
        const Chord& c = chords_.chords[chord];
        return energy_.chord_end(frame, surface_.position(place(c.head)) - surface_.position(place(c.tail)),
                                 energy_.crease_cost(chords_.sites[chord].halfedge));
    }
    Terminal half(int node, const Frame& frame, const ChordEnd& in, const ChordEnd& out) const {
        const ArcWeights weights = energy_.weights(frame);
        return {node, weights.numerator(in, out), weights.denominator(in, out)};
    }
};

}  // namespace

void add_open_ends(const GraphInput& input, const Chords& chords, WeightedGraph& search) {
    const SurfacePoint &begin = input.given.front(), &end = input.given.back();
    const std::vector<char> first = end_points(input, begin, end, input.patch.first_end_held);
    const std::vector<char> last = end_points(input, end, begin, input.patch.last_end_held);
    const OpenEnds ends(input, chords);
    for (int c = 0; c < static_cast<int>(chords.chords.size()); ++c) {
        if (first[chords.chords[c].tail] && ends.may_begin(c)) search.sources.push_back(ends.source(c));
        if (last[chords.chords[c].head] && ends.may_end(c)) search.destinations.push_back(ends.destination(c));
    }
}

}  // namespace mrc
