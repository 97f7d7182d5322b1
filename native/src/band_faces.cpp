// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/band.h>

#include "band.h"
#include "patch.h"
#include "progress_monitor.h"

#include <algorithm>
#include <utility>

namespace mrc {
namespace {

BandFaces faces_of(const Patch& patch, const Band& band) {
    std::vector<std::pair<int, int8_t>> found;
    found.reserve(band.polygons.size());
    for (std::size_t i = 0; i < band.polygons.size(); ++i) {
        found.emplace_back(patch.polygon_face[band.polygons[i]], static_cast<int8_t>(band.polygon_side[i]));
    }
    std::ranges::sort(found);
    BandFaces result;
    for (const auto& [face, side] : found) {
        result.faces.push_back(face);
        result.sides.push_back(side);
    }
    return result;
}

}  // namespace

BandFaces band(const Surface& surface, const Contour& contour, const Options& options, const Progress& progress) {
    options.check();
    const Contour checked = checked_contour(surface, contour);
    BandFaces result;
    with_monitor(progress, [&](ProgressMonitor& monitor) {
        const Beat beat = [&] { monitor.beat(); };
        const Patch patch = make_patch(surface, checked, options.width, beat);
        result = faces_of(patch, grow_band(surface, patch, options, {}, {}, beat));
    });
    return result;
}

}  // namespace mrc
