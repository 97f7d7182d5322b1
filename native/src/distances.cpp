// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/distances.h>

#include <limits>

namespace mrc {

std::vector<std::pair<int, double>> distances_from(const Surface& surface, std::span<const int> vertices, double limit) {
    std::vector<std::pair<int, double>> settled;
    settle_outwards(surface, vertices, [&](int vertex, double distance) {
        if (distance > limit) return false;
        settled.emplace_back(vertex, distance);
        return true;
    });
    return settled;
}

std::vector<int> vertices_within(const Surface& surface, std::span<const int> vertices, int rings) {
    std::vector<int> found(vertices.begin(), vertices.end());
    std::unordered_set<int> seen(found.begin(), found.end());
    for (std::size_t begin = 0; rings > 0; --rings) {
        const std::size_t end = found.size();
        for (; begin < end; ++begin) {
            surface.for_each_real_edge(found[begin], [&](int neighbour, int) {
                if (seen.insert(neighbour).second) found.push_back(neighbour);
            });
        }
    }
    return found;
}

}  // namespace mrc
