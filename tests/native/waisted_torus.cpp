// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace mrc_test {
namespace {

constexpr int around = 64, across = 20;

int vertex(int i, int j) { return (i + around) % around * across + (j + across) % across; }

}  // namespace

mrc::Surface waisted_torus() {
    std::vector<double> positions;
    std::vector<int32_t> offsets{0}, corners;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
            const double tube = 1.0 - 0.3 * std::cos(waists * u), ring = 4.0 + tube * std::cos(v);
            positions.insert(positions.end(), {ring * std::cos(u), ring * std::sin(u), tube * std::sin(v)});
            corners.insert(corners.end(), {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
            offsets.push_back(static_cast<int32_t>(corners.size()));
        }
    }
    return mrc::Surface({positions, offsets, corners, {}, {}});
}

mrc::Contour loop_near(int waist) {
    const auto column = [&](int j) { return waist * around / waists + 2 + j / 3 % 2; };
    std::vector<int> loop;
    for (int j = 0; j < across; ++j) {
        loop.push_back(vertex(column(j), j));
        if (column((j + 1) % across) != column(j)) loop.push_back(vertex(column((j + 1) % across), j));
    }
    return mrc::vertex_contour(loop);
}

std::vector<mrc::Task> all_tasks() {
    std::vector<mrc::Task> tasks(waists);
    for (int waist = 0; waist < waists; ++waist) tasks[waist].contour = loop_near(waist);
    return tasks;
}

}  // namespace mrc_test
