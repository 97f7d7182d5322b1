// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/errors.h>
#include <mrc/types.h>

namespace mrc {

/// Refuses a graph that would not fit before it is built.
/// @throws TooLarge with the estimate and what to lower, above 2^31 arcs or more memory than is free.
void check_graph_size(double triangles, int steiner);

/// The same where so many bytes are free; `free_bytes` is asked for large graphs alone, as that takes longer than a small search.
void check_graph_size(double triangles, int steiner, double (*free_bytes)());

}  // namespace mrc
