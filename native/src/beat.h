// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace mrc {

/// Called often by a long stage; what it throws ends the stage.
using Beat = std::function<void()>;

}  // namespace mrc
