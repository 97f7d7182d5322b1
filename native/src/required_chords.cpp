// SPDX-License-Identifier: GPL-3.0-or-later
#include "required_chords.h"

#include "element_names.h"

#include <algorithm>
#include <string>
#include <utility>

namespace mrc {
namespace {

class RequiredChords {
  public:
    RequiredChords(const GraphInput& input, const std::vector<GraphPoint>& points, const std::vector<DirectedSegment>& directed)
        : surface_(input.surface),
          patch_(input.patch),
          input_(input),
          ambient_(input.ambient),
          points_(points),
          directed_(directed) {}

    RequiredElements find() {
        for (const int v : input_.constraints.required_vertices) elements_.require(place_of(points_, point_of(v)));
        for (const auto& [a, b] : input_.constraints.required_edges) require_edge(a, b);
        const Ends ends = input_.options.ends;
        if (!patch_.closed && (ends == Ends::edges || ends == Ends::edges_or_border)) require_end_edges();
        return std::move(elements_);
    }

    RequiredElements::Span span(const DirectedSegment& d) const {
        const GraphPoint &tail = points_[d.tail], &head = points_[d.head];
        return {tail.level, head.level, d.crosses, tail.rank, head.rank, d.segment};
    }

  private:
    const Surface& surface_;
    const Patch& patch_;
    const GraphInput& input_;
    const AmbientGraph& ambient_;
    const std::vector<GraphPoint>& points_;
    const std::vector<DirectedSegment>& directed_;
    RequiredElements elements_;

    /// The band's point for a required vertex.
    int point_of(int vertex) const {
        const auto found = ambient_.local.find(vertex);
        if (found != ambient_.local.end()) return ambient_.point_of_vertex[found->second];
        const char* others = input_.exclusion.refused.empty() ? "" : ", which other contours may keep back";
        throw InvalidInput(ErrorCode::outside_band,
                           "required vertex " + std::to_string(vertex) + " lies outside the band" + others +
                               ": widen the band or drop the requirement",
                           {Element::vertex(vertex)});
    }

    void require_edge(int a, int b) {
        const int p = point_of(a), q = point_of(b);
        const Halfedge h = patch_.find_halfedge(ambient_.local.at(a), ambient_.local.at(b));
        const int edge = h.is_valid() ? h.idx() / 2 : -1;
        if (edge < 0 || !input_.band.edge[edge] || patch_.diagonal[edge] || patch_.border_edge[edge]) {
            throw InvalidInput(
                ErrorCode::outside_band,
                "required edge " + edge_name(a, b) + " is not an edge inside the band: widen the band or drop the requirement",
                {Element::edge(a, b)});
        }
        elements_.require(place_of(points_, p));
        elements_.require(place_of(points_, q));
        std::vector<int> own = segments_of_edge(edge);
        if (!std::ranges::all_of(own, [&](int s) { return ambient_.segments[s].walkable; })) {
            throw InvalidInput(ErrorCode::touches_other_contour,
                               "required edge " + edge_name(a, b) + " touches another contour or its band: drop the requirement",
                               {Element::edge(a, b)});
        }
        for (const DirectedSegment& d : directed_) {
            if (std::ranges::find(own, d.segment) != own.end()) elements_.require(span(d), own);
        }
    }

    std::vector<int> segments_of_edge(int edge) const {
        const int halfedge = patch_.edge_halfedge(edge);
        std::vector<int> own;
        for (std::size_t i = 0; i < ambient_.segments.size(); ++i) {
            const int h = ambient_.segments[i].halfedge;
            if (h >= 0 && surface_.edge(h) == surface_.edge(halfedge)) own.push_back(static_cast<int>(i));
        }
        return own;
    }

    bool slides(const SurfacePoint& end, const SurfacePoint& other, bool held) const {
        if (!other.is_vertex()) return false;
        const int own = ambient_.local.at(end.a), others = ambient_.local.at(other.a);
        return !sliding_piece(patch_, input_.band, input_.options, own, others, held).empty();
    }

    /// Open curves with their first and last edge held (4.6). A refined one whose ends are no whole edges holds its end points.
    void require_end_edges() {
        const auto& points = input_.given;
        const SurfacePoint &begin = points.front(), &finish = points.back();
        const auto hold = [&](const SurfacePoint& end, const SurfacePoint& next) {
            if (!end.is_vertex()) return;
            const int other = next.is_vertex() ? next.a : next.a == end.a ? next.b : next.b == end.a ? next.a : -1;
            if (other >= 0 && surface_.real_edge(end.a, other)) require_edge(end.a, other);
        };
        if (!begin.is_vertex() || !slides(begin, finish, patch_.first_end_held)) hold(begin, points[1]);
        if (!finish.is_vertex() || !slides(finish, begin, patch_.last_end_held)) hold(finish, points[points.size() - 2]);
    }
};

}  // namespace

RequiredElements keep_required_chords(const GraphInput& input, const std::vector<GraphPoint>& points,
                                      std::vector<DirectedSegment>& directed) {
    RequiredChords required(input, points, directed);
    RequiredElements elements = required.find();
    if (!elements.empty()) std::erase_if(directed, [&](const DirectedSegment& d) { return !elements.allows(required.span(d)); });
    return elements;
}

}  // namespace mrc
