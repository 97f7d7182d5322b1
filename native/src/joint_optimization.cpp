// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/check_contour.h>
#include <mrc/optimize.h>

#include "barrier_crossings.h"
#include "checked_input.h"
#include "contour_optimization.h"
#include "parallel.h"
#include "partition.h"
#include "progress_monitor.h"
#include "segments.h"
#include "surface_point.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace mrc {
namespace {

using Edge = std::array<int, 2>;

/// The real edges that a contour runs along, even if it is not a valid one.
std::vector<Edge> real_edges_along(const Surface& surface, const Contour& contour) {
    const auto exists = [&](const SurfacePoint& p) {
        return std::min(p.a, p.b) >= 0 && std::max(p.a, p.b) < surface.vertex_count();
    };
    std::vector<Edge> edges;
    for (const auto& [p, q] : segments(contour)) {
        if (!exists(p) || !exists(q)) continue;
        const auto edge = shared_edge(p, q);
        if (edge && surface.real_edge(edge->a, edge->b)) edges.push_back({edge->a, edge->b});
    }
    return edges;
}

/// What an error of one contour does: it ends the call, or becomes what that contour gets.
enum class OnError { end, keep };

/// The optimization of several contours of one surface: all take each step before any takes the next, so that the results depend
/// neither on their order nor on the number of threads.
class JointOptimization {
  public:
    JointOptimization(const Surface& surface, std::span<const Task> tasks, const Options& options, const Progress& progress,
                      OnError on_error)
        : surface_(surface),
          options_(options),
          monitor_(progress),
          regular_iterations_(whole_and_refined(options) ? std::max(1, options.regular_iterations) : options.regular_iterations),
          on_error_(on_error),
          tasks_(tasks),
          errors_(tasks.size()),
          contours_(tasks.size()) {}

    std::vector<Outcome> run() {
        try {
            prepare();
            if (regular_iterations_ > 0) run_phase(regular_iterations_, 0, 0);
            run_phase(options_.iterations, options_.refinement, regular_iterations_);
            std::vector<Result> results(contours_.size());
            for_each([&](int i) { results[i] = contours_[i]->finish(); });
            monitor_.advance(1.0);
            return outcomes(std::move(results));
        } catch (const ProgressMonitor::Cancelled&) {
            if (monitor_.failure()) std::rethrow_exception(monitor_.failure());
            return cancelled();
        } catch (const InvalidInput&) {
            // A failure of the caller's function comes first: it may be an interrupt.
            if (monitor_.failure()) std::rethrow_exception(monitor_.failure());
            throw;
        }
    }

  private:
    const Surface& surface_;
    const Options& options_;
    ProgressMonitor monitor_;
    const int regular_iterations_;
    const OnError on_error_;
    const std::span<const Task> tasks_;
    std::vector<Constraints> blocked_;  // the constraints with what refused contours add; empty where none was refused
    std::vector<std::optional<InvalidInput>> errors_;             // of the contours whose errors are kept
    std::vector<std::unique_ptr<ContourOptimization>> contours_;  // null: refused before the first iteration
    int iteration_ = 0;                                           // the current one, counted as if none ended early
    const Beat beat_ = [this] { monitor_.beat(); };

    /// A refined search needs the regular result of the whole surface to begin from.
    static bool whole_and_refined(const Options& options) { return !options.width && options.refinement > 0; }
    int count() const { return static_cast<int>(contours_.size()); }

    /// An iteration has three steps: patches, bands, searches.
    void report(int step) { monitor_.advance((3.0 * iteration_ + step) / (3.0 * regular_iterations_ + 3.0 * options_.iterations)); }

    /// Takes a step with all contours that have no error yet.
    template <class Step>
    void for_each(Step&& step) {
        const auto guarded_step = [&](int i) {
            if (errors_[i]) return;
            try {
                step(i);
            } catch (const InvalidInput& error) {
                fail(i, error);
            }
        };
        parallel_for(count(), options_.threads, guarded_step, [&] { monitor_.idle(); });
    }

    void fail(int i, const InvalidInput& error) {
        if (on_error_ == OnError::end) error.of_contour(i, name(i)).raise();
        errors_[i] = error;
        if (contours_[i]) contours_[i]->settle_where_given();
    }
    std::string name(int i) const { return count() == 1 ? "" : "contour " + std::to_string(i) + ": "; }

    /// Checks the input and measures the given contours, which a cancelled call gives back.
    void prepare() {
        const Beat beat = [this] { monitor_.essential_beat(); };
        for_each([&](int i) {
            const Task& task = tasks_[i];
            const Contour checked = checked_input(surface_, task.contour, options_, task.constraints, task.scales);
            check_barriers(surface_, checked, task.constraints);
            contours_[i] = std::make_unique<ContourOptimization>(surface_, checked, options_, task.constraints, task.scales, beat);
        });
        block_refused();
    }

    /// Where refused contours run along real edges, these are barriers for all others.
    void block_refused() {
        std::vector<Edge> edges;
        for (int i = 0; i < count(); ++i) {
            if (contours_[i]) continue;
            const std::vector<Edge> own = real_edges_along(surface_, tasks_[i].contour);
            edges.insert(edges.end(), own.begin(), own.end());
        }
        if (edges.empty()) return;
        for (const Task& task : tasks_) blocked_.push_back(task.constraints);
        for (int i = 0; i < count(); ++i) {
            std::vector<Edge>& barriers = blocked_[i].barriers;
            barriers.insert(barriers.end(), edges.begin(), edges.end());
            if (contours_[i]) contours_[i]->constrain(blocked_[i]);
        }
    }

    bool moving(int i) const { return !errors_[i] && contours_[i]->moving(); }
    bool several() const {
        return std::ranges::count_if(contours_, [](const auto& contour) { return contour != nullptr; }) > 1;
    }

    /// Iterations with one k, the first of which is counted as iteration `first`.
    void run_phase(int iterations, int steiner, int first) {
        for_each([&](int i) { contours_[i]->begin_phase(steiner); });
        for (int i = 0; i < iterations; ++i) {
            iteration_ = first + i;
            report(0);
            if (!iterate()) break;
        }
    }

    /// One iteration of those that still move; false where none of them will move again.
    bool iterate() {
        std::vector<char> active;
        for (int i = 0; i < count(); ++i) active.push_back(moving(i));
        const auto for_each_active = [&](auto&& step) {
            for_each([&](int i) {
                if (active[i]) step(*contours_[i], i);
            });
        };
        for_each_active([&](ContourOptimization& contour, int) { contour.cut_out(beat_); });
        report(1);
        std::optional<Partition> shared;
        if (several()) share_out(shared.emplace(surface_));
        Partition* partition = shared ? &*shared : nullptr;
        for_each_active([&](ContourOptimization& contour, int i) { contour.grow(partition, i, beat_); });
        for (int i = 0; partition && i < count(); ++i) {
            if (contours_[i] && contours_[i]->patch()) partition->enclose(i, *contours_[i]->patch(), contours_[i]->band());
        }
        report(2);
        for_each_active([&](ContourOptimization& contour, int i) { contour.search(partition, i, beat_); });
        wake_neighbors(active);
        for (int i = 0; i < count(); ++i) {
            if (moving(i)) return true;
        }
        return false;
    }

    void share_out(Partition& partition) {
        for (int i = 0; i < count(); ++i) {
            if (!contours_[i]) continue;
            monitor_.beat();
            partition.occupy(i, contours_[i]->given());
            partition.occupy(i, contours_[i]->current());
            if (contours_[i]->patch()) partition.claim(i, *contours_[i]->patch());
        }
        for (int i = 0; i < count(); ++i) {
            if (contours_[i]) hold_shared_ends(partition, i);
        }
    }

    /// An end that another contour shares does not slide along the border.
    void hold_shared_ends(const Partition& partition, int i) {
        if (!contours_[i]->patch() || contours_[i]->current().closed) return;
        const auto& points = contours_[i]->current().points;
        Patch& patch = *contours_[i]->patch();
        patch.first_end_held = points.front().is_vertex() && partition.shares(i, points.front().a);
        patch.last_end_held = points.back().is_vertex() && partition.shares(i, points.back().a);
    }

    /// A contour that no longer moves is searched again once one that kept it back has moved, or has failed and left its band.
    void wake_neighbors(const std::vector<char>& active) {
        std::vector<char> moved;
        for (int i = 0; i < count(); ++i) moved.push_back(active[i] && (errors_[i] || contours_[i]->moved()));
        for (int i = 0; i < count(); ++i) {
            if (errors_[i]) continue;
            if (std::ranges::any_of(contours_[i]->held_back_by(), [&](int other) { return moved[other] != 0; }))
                contours_[i]->wake();
        }
    }

    std::vector<Outcome> cancelled() const {
        std::vector<Result> results;
        for (int i = 0; i < count(); ++i) results.push_back(errors_[i] ? Result() : contours_[i]->cancelled());
        return outcomes(std::move(results));
    }

    std::vector<Outcome> outcomes(std::vector<Result> results) const {
        std::vector<Outcome> outcomes;
        for (int i = 0; i < count(); ++i) {
            if (errors_[i]) {
                outcomes.emplace_back(*errors_[i]);
            } else {
                outcomes.emplace_back(std::move(results[i]));
            }
        }
        return outcomes;
    }
};

std::vector<Outcome> run(const Surface& surface, std::span<const Task> tasks, const Options& options, const Progress& progress,
                         OnError on_error) {
    options.check();
    return JointOptimization(surface, tasks, options, progress, on_error).run();
}

}  // namespace

std::vector<Result> optimize_all(const Surface& surface, std::span<const Task> tasks, const Options& options,
                                 const Progress& progress) {
    std::vector<Result> results;
    for (Outcome& outcome : run(surface, tasks, options, progress, OnError::end))
        results.push_back(std::get<Result>(std::move(outcome)));
    return results;
}

std::vector<Outcome> optimize_each(const Surface& surface, std::span<const Task> tasks, const Options& options,
                                   const Progress& progress) {
    std::vector<Outcome> outcomes = run(surface, tasks, options, progress, OnError::keep);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (auto* error = std::get_if<InvalidInput>(&outcomes[i])) *error = error->of_contour(static_cast<int>(i));
    }
    return outcomes;
}

Result optimize(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                const std::optional<Scales>& scales, const Progress& progress) {
    const Task task{contour, constraints, scales};
    try {
        return std::move(optimize_all(surface, std::span(&task, 1), options, progress)[0]);
    } catch (const InvalidInput& error) {
        error.of_contour(std::nullopt).raise();
    }
}

std::optional<InvalidInput> check_contour(const Surface& surface, const Contour& contour,
                                          std::span<const std::array<int, 2>> barriers, const Progress& progress) {
    Options options;
    options.iterations = 0;
    Constraints constraints;
    constraints.barriers.assign(barriers.begin(), barriers.end());
    try {
        optimize(surface, contour, options, constraints, std::nullopt, progress);
    } catch (const InvalidInput& error) {
        return error;
    }
    return std::nullopt;
}

}  // namespace mrc
