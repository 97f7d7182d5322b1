// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/optimize.h>

#include "memory.h"

#include <mrc/contour.h>
#include <mrc/ratio.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

namespace mrc {
namespace {

/// @throws InvalidInput where the scales are those of another surface, or no numbers.
void check_scales(const Surface& surface, const Scales& scales) {
    for (const SurfacePoint& p : scales.given.points) {
        if (std::max(p.a, p.b) >= surface.vertex_count()) {
            throw InvalidInput("the scales belong to another surface: their contour has vertex " +
                               std::to_string(std::max(p.a, p.b)) + ", and this surface has " +
                               std::to_string(surface.vertex_count()) + " vertices");
        }
    }
    for (const double value : {scales.h, scales.K, scales.kappa_0, scales.L0}) {
        if (!(std::isfinite(value) && value > 0.0)) {
            throw InvalidInput("lengths and curvatures near the contour leave the range of numbers: scale the mesh");
        }
    }
}

/// Scales, curvature and energy, made once for a call.
struct Setting {
    Setting(const Surface& surface, const Contour& contour, const Options& options, const std::vector<Attractor>& attractors,
            const Scales* given)
        : field(surface, given ? given->h : mean_edge_length(surface, contour), options),
          scales(given ? *given : contour_scales(surface, field, mean_edge_length(surface, contour), contour, options)),
          energy(surface, field, scales, options, attractors) {
        check_scales(surface, scales);
    }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;

    CurvatureField field;
    Scales scales;
    Energy energy;
};

class Stopwatch {
  public:
    explicit Stopwatch(std::map<std::string, double>& seconds) : seconds_(seconds) {}

    template <class Stage>
    auto time(const char* name, Stage&& stage) {
        const auto start = std::chrono::steady_clock::now();
        auto result = stage();
        seconds_[name] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return result;
    }

  private:
    std::map<std::string, double>& seconds_;
};

constexpr const char* no_neighbour =
    "no simple contour along mesh edges lies beside the given one, so that no band can grow from it";

/// How far along the flow contours with the required elements get, in words.
std::string where_it_stops(const ContourGraph& graph, const Wishes& wishes) {
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
    std::ostringstream message;
    message << "no contour of the band has all " << wishes.required_vertices.size() + wishes.required_edges.size()
            << " required elements: the search ";
    if (farthest) {
        message << "stops at vertex " << farthest->place.a;
    } else {
        message << "cannot even begin";
    }
    message << ". Widen the band, raise max_turn or drop a requirement";
    return message.str();
}

class Optimization {
  public:
    Optimization(const Surface& surface, const Contour& contour, const Options& options, const Wishes& wishes, const Scales* scales,
                 const Progress& progress)
        : surface_(surface),
          options_(options),
          wishes_(wishes),
          progress_(progress),
          stopwatch_(result_.statistics.seconds),
          given_(contour),
          feasible_(meets(contour, wishes)) {
        setting_ = stopwatch_.time("curvature",
                                   [&] { return std::make_unique<Setting>(surface, contour, options, wishes.attractors, scales); });
    }

    Result run() {
        if (!wishes_.region_density.empty() && options_.region_weight != 0.0) {
            enclosed_ = enclosed_change(surface_, wishes_.region_density, setting_->scales.given, given_);
        }
        const Measure first = mrc::measure(surface_, setting_->energy, given_, options_.refinement, enclosed_);
        result_.scales = setting_->scales;
        result_.contour = given_;
        result_.ratio = result_.initial_ratio = first.ratio;
        result_.objective = result_.initial_objective = first.objective;
        result_.lower_bound = first.objective;
        result_.salience = first.salience;
        if (options_.regular_iterations > 0 && !run_phase(options_.regular_iterations, 0)) return cancelled();
        if (!run_phase(options_.iterations, options_.refinement)) return cancelled();
        if (!feasible_)
            throw Infeasible("the given contour lacks required elements, and " +
                             (result_.reason.empty() ? "no iteration was asked for" : result_.reason));
        if (searched_ && featureless()) explain_featureless();
        // What was won along mesh edges may be lost with the Steiner points of a last phase that found nothing.
        const bool lost = result_.status == Status::improved && below(result_.initial_objective, result_.objective);
        if (result_.status == Status::improved && (lost || (searched_ && featureless()))) keep_given();
        if (lost) result_.reason = "no better contour was found across faces";
        if (!report(1.0)) return cancelled();
        return std::move(result_);
    }

  private:
    const Surface& surface_;
    const Options& options_;
    const Wishes& wishes_;
    const Progress& progress_;
    Result result_;
    Stopwatch stopwatch_;
    const Contour given_;
    bool feasible_;  // the contour reached so far has all required elements
    std::unique_ptr<Setting> setting_;
    Measure current_;        // of the contour reached so far
    int steiner_ = 0;        // k of the iterations under way
    bool searched_ = false;  // some iteration found a contour
    double enclosed_ = 0.0;  // the change of the region term's integral so far

    /// True where objective a is below b by more than rounding.
    bool below(double a, double b) const {
        const double unit = options_.length_bias == 0.0 ? setting_->energy.unit() : 1.0;
        return std::isinf(b) ? a < b : a < b - 1e-12 * std::max({unit, std::abs(a), std::abs(b)});
    }

    bool report(double share) const { return !progress_ || progress_(share); }

    /// A cancelled call changes nothing.
    Result cancelled() {
        Result result;
        result.contour = given_;
        result.status = Status::cancelled;
        result.reason = "cancelled";
        result.ratio = result.initial_ratio = result_.initial_ratio;
        result.objective = result.initial_objective = result.lower_bound = result_.initial_objective;
        result.history = {result_.initial_objective};
        result.scales = result_.scales;
        return result;
    }

    /// Iterations with one k, measured with its Steiner points: a segment of the history. False: cancelled.
    bool run_phase(int iterations, int steiner) {
        steiner_ = steiner;
        current_ = mrc::measure(surface_, setting_->energy, result_.contour, steiner, enclosed_);
        result_.ratio = current_.ratio;
        result_.objective = result_.lower_bound = current_.objective;
        result_.gap = 0.0;
        if (feasible_) result_.history.push_back(current_.objective);
        for (int i = 0; i < iterations; ++i) {
            if (!report(share_done())) return false;
            if (!iterate()) break;
        }
        return true;
    }

    double share_done() const {
        return static_cast<double>(result_.statistics.iterations) / (options_.regular_iterations + options_.iterations);
    }

    /// One iteration; false where the contour did not move.
    bool iterate() {
        const Contour& current = result_.contour;
        ++result_.statistics.iterations;
        if (!has_neighbour_along_edges(surface_, current)) {
            if (result_.status == Status::unchanged) result_.reason = no_neighbour;
            return false;
        }
        const Patch patch = stopwatch_.time("patch", [&] { return make_patch(surface_, current, options_.width); });
        const Band band = stopwatch_.time("band", [&] { return grow_band(surface_, patch, options_, wishes_); });
        const Flow flow = stopwatch_.time("flow", [&] { return make_flow(patch, band, options_); });
        const std::optional<EdgeForm> region = make_region_form(patch, band, flow);
        const ContourGraph graph = stopwatch_.time("graph", [&] {
            return make_graph(surface_, patch, band, flow, setting_->energy, options_, wishes_, steiner_,
                              region ? &*region : nullptr);
        });
        const RatioResult best = stopwatch_.time("ratio", [&] { return minimum_ratio(graph.search, search_options()); });
        count(band, graph, best);
        if (!feasible_ && !best.found) throw Infeasible(where_it_stops(graph, wishes_));
        const double before = feasible_ ? result_.objective : std::numeric_limits<double>::infinity();
        result_.lower_bound = best.found ? std::min(best.lower_bound, before) : before;
        searched_ |= best.found;
        if (best.found) accept(trace_contour(graph, patch, flow, best.nodes), region);
        result_.gap = std::max(0.0, result_.objective - result_.lower_bound);
        result_.history.push_back(result_.objective);
        explain(band, best);
        return below(result_.objective, before) && !featureless();
    }

    /// The search begins at what the current contour suggests.
    RatioOptions search_options() const {
        RatioOptions options;
        options.objective = setting_->energy.objective();
        options.guess = Terminal{-1, current_.numerator, current_.length};
        return options;
    }

    std::optional<EdgeForm> make_region_form(const Patch& patch, const Band& band, const Flow& flow) const {
        if (wishes_.region_density.empty() || options_.region_weight == 0.0) return std::nullopt;
        return region_form(surface_, patch, band, flow, wishes_.region_density, enclosed_);
    }

    void accept(const Contour& found, const std::optional<EdgeForm>& region) {
        const double enclosed = region ? region->along(found) : 0.0;
        const Measure measured = mrc::measure(surface_, setting_->energy, found, steiner_, enclosed);
        result_.salience = measured.salience;
        if (feasible_ && !below(measured.objective, result_.objective)) return;
        result_.contour = found;
        result_.ratio = measured.ratio;
        result_.objective = measured.objective;
        if (result_.status != Status::constrained) result_.status = feasible_ ? Status::improved : Status::constrained;
        feasible_ = true;
        current_ = measured;
        enclosed_ = enclosed;
    }

    /// Nothing concave was found to go to (min_salience).
    bool featureless() const { return options_.min_salience && result_.salience < *options_.min_salience; }

    void explain_featureless() {
        std::ostringstream reason;
        reason << "there is nothing concave to find here: the best contour's salience is " << result_.salience << ", below "
               << *options_.min_salience;
        result_.reason = reason.str();
    }

    /// Puts the given contour back; the certificate stays that of the best found.
    void keep_given() {
        result_.contour = given_;
        result_.status = Status::unchanged;
        result_.ratio = result_.initial_ratio;
        result_.objective = result_.initial_objective;
    }

    void explain(const Band& band, const RatioResult& best) {
        result_.reason.clear();
        if (result_.status != Status::unchanged) return;
        if (band.polygons.empty()) {
            result_.reason = "nothing can grow around the contour: its faces touch it all round";
        } else if (!best.found) {
            result_.reason = "no contour in the band runs along with the flow";
        } else {
            result_.reason = "the given contour is already the best in its band";
        }
    }

    void count(const Band& band, const ContourGraph& graph, const RatioResult& best) {
        Statistics& s = result_.statistics;
        s.faces = static_cast<int>(band.polygons.size());
        s.cut = graph.crossing;
        s.nodes = static_cast<int>(graph.chords.size());
        s.arcs = graph.search.arc_count();
        s.linear_steps = best.steps;
        s.passes = best.passes;
    }
};

/// The contour, once all input is checked; a band has at least as many triangles as its contour has segments.
Contour checked_input(const Surface& surface, const Contour& contour, const Options& options, const Wishes& wishes,
                      const Scales* scales) {
    options.check();
    wishes.check(surface);
    Contour checked = checked_contour(surface, contour);
    check_graph_size(static_cast<double>(checked.points.size()), options.refinement);
    if (!checked.closed && !wishes.region_density.empty()) {
        throw InvalidInput("the region term needs a closed contour: an open one encloses nothing");
    }
    if (scales) check_scales(surface, *scales);
    return checked;
}

double whole_mean_edge_length(const Surface& surface) {
    double sum = 0.0;
    int count = 0;
    for (int h = 0; h < surface.halfedge_count(); ++h) {
        if (surface.diagonal(h) || surface.twin(h) > h) continue;
        sum += (surface.position(surface.to(h)) - surface.position(surface.from(h))).norm();
        ++count;
    }
    if (!(sum > 0.0)) throw InvalidInput("every edge of the surface has length 0: there is nothing to measure");
    return sum / count;
}

}  // namespace

Result optimize(const Surface& surface, const Contour& contour, const Options& options, const Wishes& wishes, const Scales* scales,
                const Progress& progress) {
    const Contour checked = checked_input(surface, contour, options, wishes, scales);
    check_barriers(surface, checked, wishes);
    if (!checked.closed && !wishes.region_density.empty())
        throw InvalidInput("the region term needs a closed contour: an open one encloses nothing");
    return Optimization(surface, checked, options, wishes, scales, progress).run();
}

Measure measure(const Surface& surface, const Contour& contour, const Options& options, const Wishes& wishes,
                const Scales* scales) {
    const Contour checked = checked_input(surface, contour, options, wishes, scales);
    const Setting setting(surface, checked, options, wishes.attractors, scales);
    const bool region = scales && !wishes.region_density.empty() && options.region_weight != 0.0;
    return measure(surface, setting.energy, checked, options.refinement,
                   region ? enclosed_change(surface, wishes.region_density, scales->given, checked) : 0.0);
}

std::vector<VertexCurvature> curvature(const Surface& surface, const Options& options, const Scales* scales) {
    options.check();
    std::vector<VertexCurvature> result;
    if (surface.face_count() == 0) return std::vector<VertexCurvature>(surface.vertex_count());
    const CurvatureField field(surface, scales ? scales->h : whole_mean_edge_length(surface), options);
    for (int v = 0; v < surface.vertex_count(); ++v) result.push_back(field.at(v));
    return result;
}

SearchSpace search_space(const Surface& surface, const Contour& contour, const Options& options, const Wishes& wishes,
                         const Scales* scales) {
    const Contour checked = checked_input(surface, contour, options, wishes, scales);
    const Setting setting(surface, checked, options, wishes.attractors, scales);
    SearchSpace space;
    space.patch = make_patch(surface, checked, options.width);
    space.band = grow_band(surface, space.patch, options, wishes);
    space.flow = make_flow(space.patch, space.band, options);
    space.graph = make_graph(surface, space.patch, space.band, space.flow, setting.energy, options, wishes, options.refinement);
    return space;
}

}  // namespace mrc
