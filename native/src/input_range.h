// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace mrc {

/// The largest coordinate, length or weight accepted: powers and products of such numbers stay finite.
constexpr double largest_input = 1e50;

/// False also for what is no number.
inline bool in_input_range(double value) { return std::abs(value) <= largest_input; }

}  // namespace mrc
