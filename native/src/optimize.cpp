// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/optimize.h>

#include <mrc/contour.h>
#include <mrc/ratio.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mrc {
namespace {

/// Scales, curvature and energy, made once for a call.
struct Setting {
    Setting(const Surface& surface, const Contour& contour, const Options& options, const Scales* given)
        : field(surface, given ? given->h : mean_edge_length(surface, contour), options),
          scales(given ? *given : contour_scales(surface, field, mean_edge_length(surface, contour), contour, options)),
          energy(surface, field, scales, options) {}
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

/// True where a is below b by more than rounding.
bool below(double a, double b) { return a < b - 1e-12 * std::max(std::abs(a), std::abs(b)); }

class Optimization {
  public:
    Optimization(const Surface& surface, const Contour& contour, const Options& options, const Scales* scales, const Progress& progress)
        : surface_(surface), options_(options), progress_(progress), stopwatch_(result_.statistics.seconds), given_(contour) {
        setting_ = stopwatch_.time("curvature", [&] { return std::make_unique<Setting>(surface, contour, options, scales); });
    }

    Result run() {
        const Measure first = mrc::measure(surface_, setting_->energy, given_);
        result_.scales = setting_->scales;
        result_.contour = given_;
        result_.ratio = result_.initial_ratio = first.ratio;
        result_.objective = result_.initial_objective = first.objective;
        result_.lower_bound = first.objective;
        result_.salience = -first.ratio / setting_->scales.K;
        result_.history.push_back(first.objective);
        for (int i = 0; i < options_.iterations; ++i) {
            if (!report(static_cast<double>(i) / options_.iterations)) return cancelled();
            if (!iterate()) break;
        }
        if (!report(1.0)) return cancelled();
        return std::move(result_);
    }

  private:
    const Surface& surface_;
    const Options& options_;
    const Progress& progress_;
    Result result_;
    Stopwatch stopwatch_;
    const Contour& given_;
    std::unique_ptr<Setting> setting_;

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

    /// One iteration; false where the contour did not move.
    bool iterate() {
        const Contour& current = result_.contour;
        const Patch patch = stopwatch_.time("patch", [&] { return make_patch(surface_, current, options_.width); });
        const Band band = stopwatch_.time("band", [&] { return grow_band(patch, options_); });
        const Flow flow = stopwatch_.time("flow", [&] { return make_flow(surface_, patch, band, options_); });
        const ContourGraph graph = stopwatch_.time("graph", [&] { return make_graph(surface_, patch, band, flow, setting_->energy); });
        const RatioResult best = stopwatch_.time("ratio", [&] { return minimum_ratio(graph.search); });
        count(band, graph, best);
        ++result_.statistics.iterations;
        const double before = result_.objective;
        result_.lower_bound = best.found ? std::min(best.lower_bound, before) : before;
        result_.gap = 0.0;
        if (best.found) {
            const Contour found = trace_contour(graph, patch, flow, best.nodes);
            const Measure measured = mrc::measure(surface_, setting_->energy, found);
            accept(found, measured);
        }
        result_.history.push_back(result_.objective);
        explain(band, best);
        return below(result_.objective, before);
    }

    void accept(const Contour& found, const Measure& measured) {
        result_.salience = -measured.ratio / setting_->scales.K;
        result_.gap = std::max(0.0, measured.objective - result_.lower_bound);
        if (!below(measured.objective, result_.objective)) {
            result_.gap = std::max(0.0, result_.objective - result_.lower_bound);
            return;
        }
        result_.contour = found;
        result_.ratio = measured.ratio;
        result_.objective = measured.objective;
        result_.status = Status::improved;
    }

    void explain(const Band& band, const RatioResult& best) {
        result_.reason.clear();
        if (result_.status == Status::improved) return;
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

Result optimize(const Surface& surface, const Contour& contour, const Options& options, const Scales* scales, const Progress& progress) {
    options.check();
    check_contour(surface, contour);
    return Optimization(surface, contour, options, scales, progress).run();
}

Measure measure(const Surface& surface, const Contour& contour, const Options& options, const Scales* scales) {
    options.check();
    check_contour(surface, contour);
    const Setting setting(surface, contour, options, scales);
    return measure(surface, setting.energy, contour);
}

std::vector<VertexCurvature> curvature(const Surface& surface, const Options& options, const Scales* scales) {
    options.check();
    std::vector<VertexCurvature> result;
    if (surface.face_count() == 0) return std::vector<VertexCurvature>(surface.vertex_count());
    const CurvatureField field(surface, scales ? scales->h : whole_mean_edge_length(surface), options);
    for (int v = 0; v < surface.vertex_count(); ++v) result.push_back(field.at(v));
    return result;
}

SearchSpace search_space(const Surface& surface, const Contour& contour, const Options& options, const Scales* scales) {
    options.check();
    check_contour(surface, contour);
    const Setting setting(surface, contour, options, scales);
    SearchSpace space;
    space.patch = make_patch(surface, contour, options.width);
    space.band = grow_band(space.patch, options);
    space.flow = make_flow(surface, space.patch, space.band, options);
    space.graph = make_graph(surface, space.patch, space.band, space.flow, setting.energy);
    return space;
}

}  // namespace mrc
