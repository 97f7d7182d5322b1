// SPDX-License-Identifier: GPL-3.0-or-later
#include "contour_optimization.h"

#include "contour_scales.h"
#include "cut_off.h"
#include "distances.h"
#include "number_text.h"
#include "required_elements.h"
#include "trace_contour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mrc {
namespace {

constexpr const char* no_neighbour =
    "no simple contour along mesh edges lies beside the given one, so that no band can grow from it";

std::string numbered(const std::vector<int>& contours) {
    std::string words = contours.size() == 1 ? "contour " : "contours ";
    for (std::size_t i = 0; i < contours.size(); ++i) words += (i ? ", " : "") + std::to_string(contours[i]);
    return words;
}

std::vector<Element> elements_required_by(const Constraints& constraints) {
    std::vector<Element> elements;
    for (const int v : constraints.required_vertices) elements.push_back(Element::vertex(v));
    for (const auto& [a, b] : constraints.required_edges) elements.push_back(Element::edge(a, b));
    return elements;
}

/// Says how far along the flow contours with the required elements get.
Infeasible infeasible(const ContourGraph& graph, const Constraints& constraints, const std::vector<int>& held_back_by) {
    const WeightedGraph& search = graph.search;
    std::vector<char> reached(search.node_count(), 0);
    for (const Terminal& s : search.sources) reached[s.node] = 1;
    const GraphPoint* farthest = nullptr;
    for (int n = 0; n < search.node_count(); ++n) {
        for (int a = search.first_arc[n]; a < search.first_arc[n + 1]; ++a) reached[n] |= reached[search.from[a]];
        const int chord = search.matched ? graph.chord_of(n) : n;
        const GraphPoint& head = graph.points[graph.chords[chord].head];
        const bool source = search.matched && n < graph.crossing;
        if (reached[n] && !source && (!farthest || head.level > farthest->level)) farthest = &head;
    }
    const std::size_t required = constraints.required_vertices.size() + constraints.required_edges.size();
    const std::string end = farthest ? "stops at vertex " + std::to_string(farthest->place.a) : "cannot even begin";
    const std::string others = held_back_by.empty() ? "" : ", with " + numbered(held_back_by) + " in the way";
    return Infeasible("no contour of the band has all " + std::to_string(required) + " required elements: the search " + end +
                          others + ". Widen the band, raise max_turn or drop a requirement",
                      farthest ? std::vector{Element::vertex(farthest->place.a)} : elements_required_by(constraints));
}

}  // namespace

ContourOptimization::ContourOptimization(const Surface& surface, const Contour& contour, const Options& options,
                                         const Constraints& constraints, const std::optional<Scales>& scales, const Beat& beat)
    : surface_(surface),
      options_(options),
      phase_options_(options),
      constraints_(&constraints),
      given_(contour),
      stopwatch_(result_.statistics.seconds),
      feasible_(has_required_elements(contour, constraints)) {
    context_ = stopwatch_.time("curvature", [&] {
        return std::make_unique<SearchContext>(surface, contour, options, constraints.attractors, scales, beat);
    });
    if (constraints_->has_region() && options_.region_weight != 0.0) {
        enclosed_ = enclosed_change(surface_, *constraints_->region_density, context_->scales.given, given_, beat);
    }
    const Measure first = measure(surface_, context_->energy, given_, options_.refinement, enclosed_);
    result_.scales = context_->scales;
    result_.contour = given_;
    result_.ratio = result_.initial_ratio = first.ratio;
    result_.objective = result_.initial_objective = first.objective;
    result_.lower_bound = first.objective;
    result_.salience = first.salience;
}

void ContourOptimization::begin_phase(int steiner) {
    steiner_ = steiner;
    // Without a width, the regular phase searches the whole surface, and the refined one a band around its result.
    if (steiner > 0 && !options_.width) phase_options_.width = Options().width;
    current_ = measure(surface_, context_->energy, result_.contour, steiner, enclosed_);
    result_.ratio = current_.ratio;
    result_.objective = result_.lower_bound = current_.objective;
    result_.gap = 0.0;
    best_found_ = result_.status == Status::unchanged ? std::numeric_limits<double>::infinity() : current_.objective;
    if (feasible_) result_.history.push_back(current_.objective);
    moving_ = true;
}

void ContourOptimization::cut_out(const Beat& beat) {
    ++result_.statistics.iterations;
    moving_ = moved_ = false;
    patch_.reset();
    if (has_neighbor_along_edges(surface_, result_.contour)) {
        patch_ = stopwatch_.time("patch", [&] { return make_patch(surface_, result_.contour, phase_options_.width, beat); });
    } else if (result_.status == Status::unchanged) {
        because(Reason::no_neighbour, no_neighbour);
    }
}

void ContourOptimization::grow(Partition* partition, int number, const Beat& beat) {
    result_.held_back_by.clear();
    if (!patch_) return;
    exclusion_ = {};
    if (partition) {
        result_.held_back_by = partition->entangled_with(number, result_.contour);
        if (!result_.held_back_by.empty()) {
            patch_.reset();
            if (result_.status == Status::unchanged)
                because(Reason::shared_faces, "no band can grow: its faces are also crossed by " + numbered(result_.held_back_by));
            return;
        }
        exclusion_ = partition->exclusion(number, *patch_);
        exclusion_.own = {expressed(given_, steiner_), expressed(result_.contour, steiner_)};
    }
    band_ = stopwatch_.time("band", [&] { return grow_band(surface_, *patch_, phase_options_, *constraints_, exclusion_, beat); });
}

void ContourOptimization::search(Partition* partition, int number, const Beat& beat) {
    if (!patch_) return;
    if (partition) {
        partition->close(number, *patch_, exclusion_);
        result_.held_back_by = partition->held_back_by(number, *patch_, band_);
    }
    const Flow flow = stopwatch_.time("flow", [&] { return make_flow(*patch_, band_, options_, beat); });
    if (beat) beat();
    stopwatch_.time("curvature", [&] { prepare_curvature(*patch_, beat); });
    const std::optional<EdgeForm> region = make_region_form(*patch_, flow, beat);
    const ContourGraph graph = stopwatch_.time("graph", [&] {
        return make_graph(surface_, *patch_, band_, flow, context_->energy, options_, *constraints_, steiner_,
                          region ? &*region : nullptr, exclusion_, beat);
    });
    const RatioResult best = stopwatch_.time("ratio", [&] { return minimum_ratio(graph.search, search_options(beat)); });
    count(graph, best);
    if (!feasible_ && !best.found) throw infeasible(graph, *constraints_, result_.held_back_by);
    const double before = feasible_ ? result_.objective : std::numeric_limits<double>::infinity();
    if (best.found) accept(trace_contour(graph, *patch_, best.nodes), region);
    searched_ |= best.found;
    // The graph's objective and the measured one may differ by rounding.
    result_.lower_bound = best.found ? std::min(best.lower_bound, result_.objective) : result_.objective;
    result_.gap = result_.objective - result_.lower_bound;
    result_.history.push_back(result_.objective);
    explain(best);
    moved_ = below(result_.objective, before);
    moving_ = moved_;  // also from where nothing is concave: it may be closer to where something is
}

/// Evaluates the curvature of all vertices of the band at once.
void ContourOptimization::prepare_curvature(const Patch& patch, const Beat& beat) const {
    std::vector<int> vertices;
    for (std::size_t v = 0; v < patch.vertex.size(); ++v) {
        if (band_.side[v] != Side::outside) vertices.push_back(patch.vertex[v]);
    }
    context_->field.prepare(vertices, beat);
}

Result ContourOptimization::finish() {
    if (!feasible_)
        throw Infeasible("the given contour lacks required elements, and " +
                             (result_.reason.empty() ? "no iteration was asked for" : result_.reason),
                         elements_required_by(*constraints_));
    if (searched_ && featureless()) explain_featureless();
    // An improvement along mesh edges may be none with the Steiner points of a last phase that found nothing.
    const bool lost = result_.status == Status::improved && !below(result_.objective, result_.initial_objective);
    if (result_.status == Status::improved && (lost || (searched_ && featureless()))) keep_given();
    if (lost) because(Reason::none_refined, "no better contour was found across faces");
    keep_on_part();
    result_.length = contour_length(surface_, result_.contour);
    result_.statistics.rings = rings_between(surface_, given_, result_.contour);
    result_.non_manifold = irregular_vertices();
    return result_;
}

/// Those of the faces beside the last band.
std::vector<int> ContourOptimization::irregular_vertices() const {
    std::vector<int> found;
    for (std::size_t v = 0; patch_ && v < patch_->vertex.size(); ++v) {
        if (band_.side[v] == Side::outside) continue;
        for (const int h : surface_.outgoing(patch_->vertex[v])) {
            for (const int w : surface_.face(surface_.halfedge_face(h))) {
                if (!surface_.regular(w)) found.push_back(w);
            }
        }
    }
    std::ranges::sort(found);
    found.erase(std::ranges::unique(found).begin(), found.end());
    return found;
}

void ContourOptimization::settle_where_given() {
    result_.contour = given_;
    result_.held_back_by.clear();
    patch_.reset();
    moving_ = moved_ = false;
}

Result ContourOptimization::cancelled() const {
    Result result;
    result.contour = given_;
    result.length = contour_length(surface_, given_);
    result.status = Status::cancelled;
    result.reason_code = Reason::cancelled;
    result.reason = "cancelled";
    result.ratio = result.initial_ratio = result_.initial_ratio;
    result.objective = result.initial_objective = result.lower_bound = result_.initial_objective;
    result.history = {result_.initial_objective};
    result.scales = result_.scales;
    return result;
}

/// True where objective a is below b by more than rounding.
bool ContourOptimization::below(double a, double b) const {
    const double unit = options_.length_bias == 0.0 ? context_->energy.unit() : 1.0;
    return std::isinf(b) ? a < b : a < b - 1e-12 * std::max({unit, std::abs(a), std::abs(b)});
}

/// The current contour gives the solver its first lambda.
RatioOptions ContourOptimization::search_options(const Beat& beat) const {
    RatioOptions options;
    options.beat = beat;
    options.objective = context_->energy.objective();
    options.guess = Terminal{-1, current_.numerator, current_.length};
    return options;
}

std::optional<EdgeForm> ContourOptimization::make_region_form(const Patch& patch, const Flow& flow, const Beat& beat) const {
    if (!constraints_->has_region() || options_.region_weight == 0.0) return std::nullopt;
    return region_form(surface_, patch, band_, flow, *constraints_->region_density, enclosed_, beat);
}

void ContourOptimization::accept(const Contour& found, const std::optional<EdgeForm>& region) {
    const double enclosed = region ? region->along(found) : 0.0;
    const Measure measured = measure(surface_, context_->energy, found, steiner_, enclosed);
    if (!below(best_found_, measured.objective)) result_.salience = measured.salience;
    best_found_ = std::min(best_found_, measured.objective);
    if (feasible_ && !below(measured.objective, result_.objective)) return;
    result_.contour = found;
    result_.ratio = measured.ratio;
    result_.objective = measured.objective;
    if (result_.status != Status::constrained) result_.status = feasible_ ? Status::improved : Status::constrained;
    feasible_ = true;
    current_ = measured;
    enclosed_ = enclosed;
}

/// True where the best contour is not concave enough to move to (min_salience).
bool ContourOptimization::featureless() const {
    return result_.salience < options_.min_salience.value_or(-std::numeric_limits<double>::infinity());
}

/// Returns to the given contour from one that has slipped off the part, where nothing asks for it: no attractor, no region.
void ContourOptimization::keep_on_part() {
    if (result_.status != Status::improved || !constraints_->attractors.empty() || constraints_->has_region()) return;
    const int triangles = slipped_off(surface_, given_, result_.contour, result_.salience);
    if (triangles == 0) return;
    keep_given();
    because(Reason::slipped_off, "the best contour found follows nothing concave and cuts off only " + std::to_string(triangles) +
                                     (triangles == 1 ? " triangle" : " triangles") + ": it has slipped onto a tip");
}

void ContourOptimization::explain_featureless() {
    because(Reason::not_salient, "there is nothing concave to find here: the best contour's salience is " +
                                     number_text(result_.salience) + ", below " + number_text(options_.min_salience.value_or(0.0)));
}

void ContourOptimization::because(Reason code, std::string words) {
    result_.reason_code = code;
    result_.reason = std::move(words);
}

/// Returns to the given contour. The certificate stays that of the best found, unless the given contour is even better.
void ContourOptimization::keep_given() {
    result_.contour = given_;
    result_.status = Status::unchanged;
    result_.ratio = result_.initial_ratio;
    result_.objective = result_.initial_objective;
    const double best = std::min(result_.lower_bound + result_.gap, result_.initial_objective);
    result_.lower_bound = std::min(result_.lower_bound, result_.initial_objective);
    result_.gap = best - result_.lower_bound;
}

void ContourOptimization::explain(const RatioResult& best) {
    because(Reason::none, {});
    if (result_.status != Status::unchanged) return;
    if (band_.polygons.empty()) {
        because(Reason::no_room, "nothing can grow around the contour: its faces touch it all round");
    } else if (!best.found) {
        because(Reason::against_flow, "no contour in the band runs along with the flow");
    } else {
        because(Reason::already_best, "the given contour is already the best in its band");
    }
    if (!result_.held_back_by.empty()) result_.reason += ", and " + numbered(result_.held_back_by) + " kept the band back";
}

void ContourOptimization::count(const ContourGraph& graph, const RatioResult& best) {
    Statistics& s = result_.statistics;
    s.faces = static_cast<int>(band_.polygons.size());
    s.cut = graph.crossing;
    s.nodes = static_cast<int>(graph.chords.size());
    s.arcs = graph.search.arc_count();
    s.linear_steps = best.steps;
    s.passes = best.passes;
}

}  // namespace mrc
