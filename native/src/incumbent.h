// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mrc {

/// A path from a source to a destination, with the sums of its weights.
struct Path {
    std::vector<int> nodes;
    double f = 0.0, g = 0.0;
};

/// The best path found so far, over all sources, and the lambda that it sets: Dinkelbach's step [5].
class Incumbent {
  public:
    explicit Incumbent(const RatioOptions& options) : objective_(options.objective) {
        const Terminal guess = options.guess.value_or(Terminal{-1, 0.0, 1.0});
        lambda_ = objective_.slope(objective_.value(guess.f, guess.g), guess.g);
    }

    /// Takes a path where it is the best so far.
    bool offer(Path path) {
        const double value = objective_.value(path.f, path.g);
        if (found_ && !(value < value_)) return false;
        found_ = true;
        path_ = std::move(path);
        value_ = value;
        lambda_ = objective_.slope(value, path_.g);
        ++steps_;
        return true;
    }

    bool found() const { return found_; }
    const Path& path() const { return path_; }
    const Objective& objective() const { return objective_; }
    double value() const { return value_; }
    /// The slope of h, the curve of paths as good as the best, at the best path's length.
    double lambda() const { return lambda_; }
    /// How often the best path was replaced.
    int steps() const { return steps_; }

    /// What a path's F - lambda L must be below to beat the best.
    double threshold(double lambda) const {
        return found_ ? objective_.threshold(value_, lambda) : std::numeric_limits<double>::infinity();
    }

    /// Rounding may leave a bound below its threshold by a hair.
    static bool beats(double bound, double threshold) {
        if (threshold == std::numeric_limits<double>::infinity()) return bound < threshold;
        return bound < threshold - 1e-14 * (1.0 + std::abs(threshold));
    }

  private:
    const Objective objective_;
    Path path_;
    double value_ = 0.0;
    double lambda_ = 0.0;
    int steps_ = 0;
    bool found_ = false;
};

}  // namespace mrc
