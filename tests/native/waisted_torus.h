// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/optimize.h>
#include <mrc/surface.h>

#include <vector>

namespace mrc_test {

inline constexpr int waists = 4;

/// A torus of quads whose tube has waists, for contours around the tube to find.
mrc::Surface waisted_torus();

/// A jagged loop around the tube, two columns off a waist.
mrc::Contour loop_near(int waist);

/// A task for the loop near each waist.
std::vector<mrc::Task> all_tasks();

}  // namespace mrc_test
