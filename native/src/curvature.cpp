// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/curvature.h>

#include "curvature_field.h"
#include "progress_monitor.h"

#include <mrc/errors.h>

#include <numeric>

namespace mrc {
namespace {

double whole_mean_edge_length(const Surface& surface) {
    double sum = 0.0;
    int count = 0;
    for (int h = 0; h < surface.halfedge_count(); ++h) {
        if (surface.diagonal(h) || surface.twin(h) > h) continue;
        sum += (surface.position(surface.to(h)) - surface.position(surface.from(h))).norm();
        ++count;
    }
    if (!(sum > 0.0))
        throw InvalidInput(ErrorCode::no_length, "every edge of the surface has length 0: there is nothing to measure");
    return sum / count;
}

}  // namespace

std::vector<VertexCurvature> curvature(const Surface& surface, const Options& options, const std::optional<Scales>& scales,
                                       const Progress& progress) {
    options.check();
    std::vector<VertexCurvature> result;
    if (surface.face_count() == 0) return std::vector<VertexCurvature>(surface.vertex_count());
    const CurvatureField field(surface, scales ? scales->h : whole_mean_edge_length(surface), options);
    std::vector<int> all(surface.vertex_count());
    std::iota(all.begin(), all.end(), 0);
    const bool done = with_monitor(progress, [&](ProgressMonitor& monitor) {
        field.prepare(all, [&] { monitor.beat(); });
        monitor.advance(1.0);
    });
    if (!done) return {};
    for (const int v : all) result.push_back(field.at(v));
    return result;
}

}  // namespace mrc
