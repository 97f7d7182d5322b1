// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/types.h>

#include <algorithm>
#include <iterator>

namespace mrc {

Contour vertex_contour(std::span<const int> vertices, bool closed) {
    Contour contour{.points = {}, .closed = closed};
    contour.points.reserve(vertices.size());
    std::ranges::transform(vertices, std::back_inserter(contour.points), vertex_point);
    return contour;
}

}  // namespace mrc
