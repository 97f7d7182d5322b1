// SPDX-License-Identifier: GPL-3.0-or-later
// Moves a ring of a waisted tube into the waist, using only the installed library; fails if it lands elsewhere.
#include "all_headers.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

constexpr int columns = 24, rows = 21, waist = 11;

mrc::Surface waisted_tube() {
    std::vector<double> positions;
    std::vector<int> offsets{0}, corners;
    for (int v = 0; v < rows * columns; ++v) {
        const double angle = 2.0 * std::numbers::pi * (v % columns) / columns, height = 0.2 * (v / columns - waist);
        const double radius = 1.0 - 0.3 * std::exp(-4.0 * height * height);
        positions.insert(positions.end(), {radius * std::cos(angle), radius * std::sin(angle), height});
    }
    for (int f = 0; f < (rows - 1) * columns; ++f) {
        const int row = f / columns * columns, next = row + (f + 1) % columns;
        corners.insert(corners.end(), {f, next, next + columns, f + columns});
        offsets.push_back(static_cast<int>(corners.size()));
    }
    return mrc::Surface({positions, offsets, corners, {}, {}});
}

int main() {
    std::vector<int> ring;
    for (int i = 0; i < columns; ++i) ring.push_back((waist - 4) * columns + i);
    mrc::Options options;
    options.width = 6;
    const mrc::Result result = mrc::optimize(waisted_tube(), mrc::vertex_contour(ring), options);
    int off_waist = 0;
    for (const mrc::SurfacePoint& point : result.contour.points) off_waist += point.a / columns != waist;
    std::printf("%zu points, %d of them off the waist\n", result.contour.points.size(), off_waist);
    return result.status == mrc::Status::improved && off_waist == 0 ? 0 : 1;
}
