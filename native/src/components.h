// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <mutex>
#include <vector>

namespace mrc {

/// The connected components of a surface, made when they are first asked for.
struct Surface::Components {
    std::once_flag once;
    std::vector<int> component;  // of each vertex
    std::vector<double> radius;  // of each component

    void make(const Surface& surface);
};

}  // namespace mrc
