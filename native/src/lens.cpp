// SPDX-License-Identifier: GPL-3.0-or-later
#include "lens.h"

#include <algorithm>

namespace mrc {

bool Lens::is_open(const std::vector<Pass>& passes, const Terminal& rest, double potential) {
    const auto line = [&](const Pass& pass) { return Line{pass.lambda, pass.bound(rest) - potential}; };
    if (closing_ < passes.size() && closes(line(passes[closing_]))) return false;
    lines_.resize(passes.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
        lines_[i] = line(passes[i]);
        if (closes(lines_[i])) {
            closing_ = i;
            return false;
        }
    }
    return rises_above_lines();
}

/// A convex lens is open where it is at the peak of h above a line or where two lines meet.
bool Lens::rises_above_lines() {
    if (!incumbent_.found()) return true;
    // At the origin, which no path reaches, h is 0; the best may have improved so far since the passes that no peak is beyond it.
    if (std::ranges::all_of(lines_, [](const Line& line) { return line.height < 0.0; })) return true;
    if (open_at(open_length_)) return true;
    const Objective& objective = incumbent_.objective();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        if (open_at(objective.peak(incumbent_.value(), lines_[i].slope))) return true;
        for (std::size_t j = 0; j < i; ++j) {
            if (open_at((lines_[i].height - lines_[j].height) / (lines_[j].slope - lines_[i].slope))) return true;
        }
    }
    return objective.floor > 0.0 && open_at(objective.floor);
}

bool Lens::open_at(double L) {
    const Objective& objective = incumbent_.objective();
    const double h = objective.scale * L * (incumbent_.value() - objective.bias * std::max(L, objective.floor));
    const bool open = L > 0.0 && std::ranges::all_of(lines_, [&](const Line& line) { return line.slope * L + line.height < h; });
    if (open) open_length_ = L;
    return open;
}

}  // namespace mrc
