// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/optimize.h>

#include "barriers.h"
#include "checked_input.h"
#include "contour_optimization.h"
#include "parallel.h"
#include "partition.h"
#include "progress_monitor.h"

#include <algorithm>
#include <memory>
#include <string>

namespace mrc {
namespace {

/// Several contours of one surface on their way together: all take each step before any takes the next, so that what one finds
/// depends neither on their order nor on the number of threads.
class JointOptimization {
  public:
    JointOptimization(const Surface& surface, std::span<const Task> tasks, const Options& options, const Progress& progress)
        : surface_(surface),
          options_(options),
          monitor_(progress),
          regular_iterations_(whole_and_refined(options) ? std::max(1, options.regular_iterations) : options.regular_iterations),
          contours_(tasks.size()) {
        for_each([&](int i) {
            const Task& task = tasks[i];
            const Scales* scales = task.scales ? &*task.scales : nullptr;
            const Contour checked = checked_input(surface, task.contour, options, task.constraints, scales);
            check_barriers(surface, checked, task.constraints);
            contours_[i] = std::make_unique<ContourOptimization>(surface, checked, options, task.constraints, scales);
        });
    }

    std::vector<Result> run() {
        try {
            if (regular_iterations_ > 0) run_phase(regular_iterations_, 0, 0);
            run_phase(options_.iterations, options_.refinement, regular_iterations_);
            std::vector<Result> results(contours_.size());
            for_each([&](int i) { results[i] = contours_[i]->finish(); });
            monitor_.advance(1.0);
            return results;
        } catch (const ProgressMonitor::Cancelled&) {
            if (monitor_.failure()) std::rethrow_exception(monitor_.failure());
            return cancelled();
        }
    }

  private:
    const Surface& surface_;
    const Options& options_;
    ProgressMonitor monitor_;
    const int regular_iterations_;
    std::vector<std::unique_ptr<ContourOptimization>> contours_;
    int iteration_ = 0;  // the one under way, counted as if none ended early

    /// A refined search needs the regular result of the whole surface to begin from.
    static bool whole_and_refined(const Options& options) { return !options.width && options.refinement > 0; }
    int count() const { return static_cast<int>(contours_.size()); }

    /// An iteration has three steps: patches, bands, searches.
    void report(int step) { monitor_.advance((3.0 * iteration_ + step) / (3.0 * regular_iterations_ + 3.0 * options_.iterations)); }

    template <class Step>
    void for_each(Step&& step) {
        const auto named_step = [&](int i) {
            try {
                step(i);
            } catch (const Infeasible& error) {
                throw Infeasible(name(i) + error.what());
            } catch (const TooLarge& error) {
                throw TooLarge(name(i) + error.what());
            } catch (const InvalidInput& error) {
                throw InvalidInput(name(i) + error.what());
            }
        };
        parallel_for(count(), options_.threads, named_step, [&] { monitor_.idle(); });
    }
    std::string name(int i) const { return count() == 1 ? "" : "contour " + std::to_string(i) + ": "; }

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
        for (const auto& contour : contours_) active.push_back(contour->moving());
        const auto for_each_active = [&](auto&& step) {
            for_each([&](int i) {
                if (active[i]) step(*contours_[i], i);
            });
        };
        for_each_active([](ContourOptimization& contour, int) { contour.cut_out(); });
        report(1);
        std::optional<Partition> shared;
        if (count() > 1) share_out(shared.emplace(surface_));
        Partition* partition = shared ? &*shared : nullptr;
        for_each_active([&](ContourOptimization& contour, int i) { contour.grow(partition, i); });
        for (int i = 0; partition && i < count(); ++i) {
            if (contours_[i]->patch()) partition->enclose(i, *contours_[i]->patch(), contours_[i]->band());
        }
        report(2);
        const Beat beat = [&] { monitor_.beat(); };
        for_each_active([&](ContourOptimization& contour, int i) { contour.search(partition, i, beat); });
        wake_neighbors(active);
        return std::ranges::any_of(contours_, [](const auto& contour) { return contour->moving(); });
    }

    void share_out(Partition& partition) {
        for (int i = 0; i < count(); ++i) {
            partition.occupy(i, contours_[i]->given());
            partition.occupy(i, contours_[i]->current());
            if (contours_[i]->patch()) partition.claim(i, *contours_[i]->patch());
        }
        for (int i = 0; i < count(); ++i) hold_shared_ends(partition, i);
    }

    /// An end that another contour shares does not slide along the border.
    void hold_shared_ends(const Partition& partition, int i) {
        if (!contours_[i]->patch() || contours_[i]->current().closed) return;
        const auto& points = contours_[i]->current().points;
        Patch& patch = *contours_[i]->patch();
        patch.first_end_held = points.front().is_vertex() && partition.shares(i, points.front().a);
        patch.last_end_held = points.back().is_vertex() && partition.shares(i, points.back().a);
    }

    /// A contour that has settled sets off again where one that kept it back has moved.
    void wake_neighbors(const std::vector<char>& active) {
        std::vector<char> moved;
        for (int i = 0; i < count(); ++i) moved.push_back(active[i] && contours_[i]->moved());
        for (const auto& contour : contours_) {
            if (std::ranges::any_of(contour->held_back_by(), [&](int other) { return moved[other] != 0; })) contour->wake();
        }
    }

    std::vector<Result> cancelled() const {
        std::vector<Result> results;
        for (const auto& contour : contours_) results.push_back(contour->cancelled());
        return results;
    }
};

}  // namespace

std::vector<Result> optimize_all(const Surface& surface, std::span<const Task> tasks, const Options& options,
                                 const Progress& progress) {
    options.check();
    return JointOptimization(surface, tasks, options, progress).run();
}

Result optimize(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                const Scales* scales, const Progress& progress) {
    const Task task{contour, constraints, scales ? std::optional(*scales) : std::nullopt};
    return std::move(optimize_all(surface, std::span(&task, 1), options, progress)[0]);
}

}  // namespace mrc
