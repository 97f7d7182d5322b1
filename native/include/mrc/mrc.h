// SPDX-License-Identifier: GPL-3.0-or-later
/// All that a user of the library calls.
///
/// Threads: several threads may call any function at once, also with the same arguments, which are only read. The same holds for
/// const member functions. A progress function is called on the thread that made the call.
#pragma once

#include <mrc/band.h>
#include <mrc/check_contour.h>
#include <mrc/close_contour.h>
#include <mrc/constraints.h>
#include <mrc/curvature.h>
#include <mrc/errors.h>
#include <mrc/measure.h>
#include <mrc/optimize.h>
#include <mrc/options.h>
#include <mrc/scales.h>
#include <mrc/surface.h>
#include <mrc/types.h>
