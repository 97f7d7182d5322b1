// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace mrc {

/// A heartbeat: called often by a long stage, which ends when it throws. That is how a caller cancels.
using Beat = std::function<void()>;

/// For the steps of a loop, of which each is short.
inline void beat_at(std::size_t step, const Beat& beat) {
    if (beat && step % 1024 == 0) beat();
}

}  // namespace mrc
