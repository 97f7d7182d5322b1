// SPDX-License-Identifier: GPL-3.0-or-later
/// Arrays with any content give a consistent surface or an error.
#include "checks.h"

#include <fuzzer/FuzzedDataProvider.h>

namespace {

std::vector<int32_t> indices(FuzzedDataProvider& data, int most) {
    std::vector<int32_t> values(data.ConsumeIntegralInRange(0, most));
    for (int32_t& value : values) value = data.ConsumeIntegral<int8_t>();
    return values;
}

/// Faces with a few corners, so that some inputs are meshes.
void faces(FuzzedDataProvider& data, std::vector<int32_t>& offsets, std::vector<int32_t>& vertices) {
    const int count = data.ConsumeIntegralInRange(0, 200), last = data.ConsumeIntegralInRange(0, 120);
    offsets.push_back(0);
    for (int f = 0; f < count && data.remaining_bytes() > 0; ++f) {
        for (int corners = data.ConsumeIntegralInRange(2, 9); corners > 0; --corners)
            vertices.push_back(data.ConsumeIntegralInRange(0, last));
        offsets.push_back(static_cast<int32_t>(vertices.size()));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, std::size_t size) {
    FuzzedDataProvider data(bytes, size);
    std::vector<int32_t> offsets, vertices;
    if (data.ConsumeBool()) {
        faces(data, offsets, vertices);
    } else {
        offsets = indices(data, 40);
        vertices = indices(data, 600);
    }
    const std::vector<int32_t> hidden = indices(data, 8);
    const std::vector<int32_t> triangles = data.ConsumeBool() ? indices(data, 300) : std::vector<int32_t>{};
    std::vector<double> positions(3 * data.ConsumeIntegralInRange(0, 121));
    const bool raw = data.ConsumeBool();
    for (double& x : positions) x = raw ? data.ConsumeFloatingPoint<double>() : 0.01 * data.ConsumeIntegral<int8_t>();
    try {
        const mrc::Surface surface({positions, offsets, vertices, triangles, hidden});
        mrc::check_surface(surface);
        for (int v = 0; v < surface.vertex_count(); ++v) mrc::require(surface.average_radius(v) >= 0.0, "radii are not negative");
    } catch (const mrc::InvalidInput&) {  // the right response to bad input
    }
    return 0;
}
