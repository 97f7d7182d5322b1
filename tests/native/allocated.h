// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace mrc_test {

/// The bytes that this thread has asked `new` for so far: what grows faster than its work copies too much. Under sanitizers, which
/// have their own `new`, always 0.
std::size_t allocated_bytes();

}  // namespace mrc_test
