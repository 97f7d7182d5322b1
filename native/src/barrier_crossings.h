// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/constraints.h>

namespace mrc {

/// @throws InvalidInput where the contour crosses a barrier, also where it first runs along it.
void check_barriers(const Surface& surface, const Contour& contour, const Constraints& constraints);

}  // namespace mrc
