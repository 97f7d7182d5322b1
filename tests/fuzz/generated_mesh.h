// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <fuzzer/FuzzedDataProvider.h>

#include <vector>

namespace mrc {

/// A mesh of at most 200 faces as the fuzzer's bytes want it: a tube, torus, ball, plane or strip with a twist, then spoilt face by face.
struct MadeMesh {
    std::vector<Vec3> positions;
    std::vector<std::vector<int>> faces;
    std::vector<int> hidden;

    Surface surface() const;
};

MadeMesh made_mesh(FuzzedDataProvider& data);

/// Loops of vertices around a set of faces, that lie together in the mesh or in its list: what a user may have selected.
std::vector<std::vector<int>> made_loops(const MadeMesh& mesh, FuzzedDataProvider& data);

}  // namespace mrc
