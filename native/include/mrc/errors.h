// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace mrc {

/// Input that cannot be used. The message names the elements and says what to do.
class InvalidInput : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

/// The search would take more memory than there is. The message says what to lower.
class TooLarge : public InvalidInput {
  public:
    using InvalidInput::InvalidInput;
};

/// No contour satisfies the constraints. The message says where the search stops.
class Infeasible : public InvalidInput {
  public:
    using InvalidInput::InvalidInput;
};

}  // namespace mrc
