// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <fuzzer/FuzzedDataProvider.h>

#include <vector>

namespace mrc {

/// A mesh of at most 200 faces determined by the fuzzer's bytes: a tube, torus, ball, plane or twisted strip, with random damage.
struct GeneratedMesh {
    std::vector<Vec3> positions;
    std::vector<std::vector<int>> faces;
    std::vector<int> hidden;

    Surface surface() const;
};

/// `as_in_files`: also with what else is wrong in people's files.
GeneratedMesh generate_mesh(FuzzedDataProvider& data, bool as_in_files);

/// True where an input's first byte is high, which the provider reads last: inputs that once failed do not change by it.
inline bool as_in_files(const uint8_t* bytes, std::size_t size) { return size > 0 && bytes[0] >= 0xC0; }

/// Vertex loops around a set of faces that are adjacent or have consecutive numbers, such as a user might select.
std::vector<std::vector<int>> generate_loops(const GeneratedMesh& mesh, FuzzedDataProvider& data);

}  // namespace mrc
