// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace mrc {

/// A number as messages state it: the same on every system and in every language that the program may have been set to.
std::string number_text(double value, int digits = 6);

}  // namespace mrc
