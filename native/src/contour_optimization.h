// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "graph.h"
#include "partition.h"
#include "region.h"
#include "search_context.h"

#include <mrc/optimize.h>
#include "exclusion.h"
#include "ratio.h"

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mrc {

/// Adds up the seconds of stages by name.
class Stopwatch {
  public:
    explicit Stopwatch(std::map<std::string, double>& seconds) : seconds_(seconds) {}

    template <class Stage>
    auto time(const char* name, Stage&& stage) {
        const Lap lap(seconds_[name]);
        return stage();
    }

  private:
    /// Adds the time of its own life.
    class Lap {
      public:
        explicit Lap(double& seconds) : seconds_(seconds) {}
        ~Lap() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
        Lap(const Lap&) = delete;
        Lap& operator=(const Lap&) = delete;

      private:
        double& seconds_;
        const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    };

    std::map<std::string, double>& seconds_;
};

/// The optimization of one contour, in steps that several contours of a mesh take together: for each phase begin_phase, then for
/// each iteration cut_out, grow and search; finally finish.
class ContourOptimization {
  public:
    /// `contour` must be checked; surface, options and constraints must outlive the object.
    ContourOptimization(const Surface& surface, const Contour& contour, const Options& options, const Constraints& constraints,
                        const std::optional<Scales>& scales, const Beat& beat = {});

    /// Replaces the constraints, before the first iteration; these too must outlive the object.
    void constrain(const Constraints& constraints) { constraints_ = &constraints; }
    /// Iterations with one k, measured with its Steiner points: a segment of the history.
    void begin_phase(int steiner);
    /// Begins an iteration by making its patch.
    void cut_out(const Beat& beat = {});
    void grow(Partition* partition, int number, const Beat& beat = {});
    /// Finds the best contour of the band and takes it where it is better than the one so far.
    void search(Partition* partition, int number, const Beat& beat);
    Result finish();
    /// After an error: it goes back to its given place and stays there.
    void settle_where_given();
    /// A cancelled call changes nothing.
    Result cancelled() const;

    /// True where another iteration of this phase could find something, going by this contour alone.
    bool moving() const { return moving_; }
    /// The last iteration moved it.
    bool moved() const { return moved_; }
    /// Searches again, since a neighbor that kept it back has moved.
    void wake() { moving_ = !featureless(); }
    const Contour& given() const { return given_; }
    const Contour& current() const { return result_.contour; }
    const std::vector<int>& held_back_by() const { return result_.held_back_by; }
    Patch* patch() { return patch_ ? &*patch_ : nullptr; }
    const Band& band() const { return band_; }

  private:
    const Surface& surface_;
    const Options& options_;
    Options phase_options_;  // with the width of the current phase
    const Constraints* constraints_;
    const Contour given_;
    Result result_;
    Stopwatch stopwatch_;
    bool feasible_;  // the contour reached so far has all required elements
    std::unique_ptr<SearchContext> context_;
    Measure current_;  // of the contour reached so far
    int steiner_ = 0;  // k of the current phase
    bool moving_ = false, moved_ = false;
    double best_found_ = 0.0;     // the least objective that this phase found, or began with where that was found before
    bool searched_ = false;       // some iteration found a contour
    double enclosed_ = 0.0;       // the change of the region term's integral so far
    std::optional<Patch> patch_;  // of the current iteration
    Band band_;
    Exclusion exclusion_;

    void prepare_curvature(const Patch& patch, const Beat& beat) const;
    bool below(double a, double b) const;
    void accept(const Contour& found, const std::optional<EdgeForm>& region);
    RatioOptions search_options(const Beat& beat) const;
    std::optional<EdgeForm> make_region_form(const Patch& patch, const Flow& flow, const Beat& beat) const;
    bool featureless() const;
    void explain(const RatioResult& best);
    void explain_featureless();
    void because(Reason code, std::string words);
    void keep_given();
    void keep_on_part();
    std::vector<int> irregular_vertices() const;
    void count(const ContourGraph& graph, const RatioResult& best);
};

}  // namespace mrc
