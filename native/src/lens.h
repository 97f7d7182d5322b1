// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "incumbent.h"
#include "relaxation.h"

#include <cstddef>
#include <vector>

namespace mrc {

/// With a bias, the optimum of a pair may lie above its lower hull in the plane of L and F: in the convex lens between h, the
/// curve of paths as good as the best, and the lines below which the passes at several lambdas found no path.
class Lens {
  public:
    explicit Lens(const Incumbent& incumbent) : incumbent_(incumbent) {}

    /// True where some path that ends as `rest` does, from its node on, may beat the best: where a part of h lies above all
    /// passes' lines, lowered by a potential.
    bool is_open(const std::vector<Pass>& passes, const Terminal& rest, double potential = 0.0);

  private:
    struct Line {
        double slope, height;
    };
    const Incumbent& incumbent_;
    std::vector<Line> lines_;  // scratch of one lens
    // What decided the last lenses is tried first: a path's lens is much like that of the path that it continues.
    std::size_t closing_ = 0;   // the pass that closed one
    double open_length_ = 0.0;  // where one was open

    bool closes(const Line& line) const { return !Incumbent::beats(line.height, incumbent_.threshold(line.slope)); }
    bool rises_above_lines();
    bool open_at(double L);
};

}  // namespace mrc
