// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/errors.h>

#include <string>

namespace mrc {

/// How messages name an edge: (3, 8).
inline std::string edge_name(int a, int b) { return "(" + std::to_string(a) + ", " + std::to_string(b) + ")"; }

/// The vertex or the edge that a surface point lies on.
inline Element element_of(const SurfacePoint& p) { return p.is_vertex() ? Element::vertex(p.a) : Element::edge(p.a, p.b); }

}  // namespace mrc
