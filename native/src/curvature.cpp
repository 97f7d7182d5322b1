// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/curvature.h>

#include "curvature_field.h"
#include "progress_monitor.h"

#include <mrc/errors.h>

#include <algorithm>
#include <numeric>

namespace mrc {
std::vector<VertexCurvature> curvature(const Surface& surface, const Options& options, const Progress& progress) {
    options.check();
    std::vector<VertexCurvature> result;
    if (surface.face_count() == 0) return std::vector<VertexCurvature>(surface.vertex_count());
    const CurvatureField field(surface, options);
    std::vector<int> all(surface.vertex_count());
    std::iota(all.begin(), all.end(), 0);
    const bool done = with_monitor(progress, [&](ProgressMonitor& monitor) {
        field.prepare(all, [&] { monitor.beat(); });
        monitor.advance(1.0);
    });
    if (!done) return {};
    if (std::ranges::none_of(all, [&](int v) { return field.scale(v) > 0.0; }))
        throw InvalidInput(ErrorCode::no_length, "every edge of the surface has length 0: there is nothing to measure");
    for (const int v : all) result.push_back(field.at(v));
    return result;
}

}  // namespace mrc
