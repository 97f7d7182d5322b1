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

GeneratedMesh generate_mesh(FuzzedDataProvider& data);

/// Vertex loops around a set of faces that are adjacent or have consecutive numbers, such as a user might select.
std::vector<std::vector<int>> generate_loops(const GeneratedMesh& mesh, FuzzedDataProvider& data);

}  // namespace mrc
