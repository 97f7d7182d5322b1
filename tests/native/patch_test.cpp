// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "distances.h"
#include "patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

namespace mrc {
namespace {

class PatchOf : public testing::Test {
  protected:
    static constexpr int around = 12, row = 5, columns = 9, width = columns + 1;
    const Surface tube = made::tube(around, 10).surface();
    const Surface plate = made::plate(columns, 6).surface();  // vertex j * 10 + i lies at (i, j)
    const Contour loop = made::ring(around, row);

    static std::set<int> faces_of(const Patch& patch) { return {patch.polygon_face.begin(), patch.polygon_face.end()}; }
    /// The faces within so many rings, ring after ring.
    static std::set<int> faces_within(const Surface& surface, std::set<int> vertices, int rings) {
        std::set<int> faces;
        for (int ring = 0; ring < rings; ++ring) {
            for (int f = 0; f < surface.face_count(); ++f) {
                if (!surface.hidden(f) && std::ranges::any_of(surface.face(f), [&](int v) { return vertices.contains(v); }))
                    faces.insert(f);
            }
            for (const int f : faces) vertices.insert(surface.face(f).begin(), surface.face(f).end());
        }
        return faces;
    }
    std::string refusal(const Contour& contour) const {
        try {
            checked_contour(plate, contour);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "";
    }
    std::string refusal(const std::vector<int>& vertices, bool closed) const { return refusal(vertex_contour(vertices, closed)); }
};

TEST_F(PatchOf, a_contour_holds_the_faces_within_its_rings_and_no_hidden_ones) {
    const Surface partly_hidden = made::tube(around, 10).surface({40, 77});
    std::set<int> start;
    for (const SurfacePoint& p : loop.points) start.insert(p.a);
    for (int rings = 0; rings < 7; ++rings) {
        EXPECT_EQ(faces_of(make_patch(tube, loop, rings)), faces_within(tube, start, rings));
        EXPECT_EQ(faces_of(make_patch(partly_hidden, loop, rings)), faces_within(partly_hidden, start, rings));
    }
    EXPECT_EQ(make_patch(tube, loop, {}).polygon_count(), tube.face_count());
}

TEST_F(PatchOf, a_contour_has_maps_that_lead_back_to_the_surface) {
    const Patch patch = make_patch(tube, loop, 3);
    const auto from = [&](int h) { return patch.vertex[patch.mesh.from_vertex_handle(PatchMesh::HalfedgeHandle(h)).idx()]; };
    for (int h = 0; h < static_cast<int>(patch.mesh.n_halfedges()); ++h) {
        const auto face = patch.mesh.face_handle(PatchMesh::HalfedgeHandle(h));
        const int there = patch.halfedge[h];
        ASSERT_EQ(there >= 0, face.is_valid());
        if (there < 0) continue;
        EXPECT_EQ(tube.from(there), from(h));
        EXPECT_EQ(tube.to(there), from(h ^ 1));
        EXPECT_EQ(tube.halfedge_face(there), patch.polygon_face[patch.polygon[face.idx()]]);
        EXPECT_EQ(tube.diagonal(there), patch.diagonal_halfedge(h));
        EXPECT_EQ(tube.edge(patch.edge_halfedge(h / 2)), tube.edge(there));
        EXPECT_EQ(patch.border_edge[h / 2] != 0, tube.twin(there) == Surface::border);
    }
    for (std::size_t v = 0; v < patch.vertex.size(); ++v) {
        const auto& p = patch.mesh.point(PatchMesh::VertexHandle(static_cast<int>(v)));
        EXPECT_EQ(Vec3(p[0], p[1], p[2]), tube.position(patch.vertex[v]));
    }
    for (int p = 0; p < patch.polygon_count(); ++p) EXPECT_EQ(patch.first_face[p + 1] - patch.first_face[p], 2);
}

TEST_F(PatchOf, a_contour_is_numbered_from_it_outwards_and_knows_the_distances) {
    const Patch patch = make_patch(tube, loop, 4);
    const DistanceField field(tube, loop);
    int last = 0;
    for (std::size_t v = 0; v < patch.vertex.size(); ++v) {
        EXPECT_EQ(patch.distance[v], field.at(patch.vertex[v]));
        const int ring = std::abs(patch.vertex[v] / around - row);
        EXPECT_GE(ring, last);
        last = ring;
    }
    for (int i = 0; i < around; ++i) EXPECT_EQ(patch.vertex[patch.contour[i]], loop.points[i].a);
}

TEST_F(PatchOf, a_contour_that_is_simple_takes_it_with_ends_of_edges_written_as_vertices) {
    EXPECT_EQ(checked_contour(plate, {{{11, 12, 0.0}, {12, 13, 0.0}, {22, 12, 0.0}, {11, 21, 1.0}}, true}),
              vertex_contour(std::vector<int>{11, 12, 22, 21}));
    EXPECT_EQ(refusal({{{11, 21, 0.5}, {11, 22, 0.5}, {12, 22, 0.5}}, false}), "");
    EXPECT_EQ(refusal({11, 12, 13}, false), "");
}

TEST_F(PatchOf, a_contour_that_is_not_refuses_it_and_names_what_is_wrong) {
    const auto says = [](const std::string& message, const std::string& words) {
        return message.find(words) != std::string::npos ? testing::AssertionSuccess() : testing::AssertionFailure() << message;
    };
    EXPECT_TRUE(says(refusal({11, 12}, true), "at least 3"));
    EXPECT_TRUE(says(refusal({11}, false), "at least 2"));
    EXPECT_TRUE(says(refusal({11, 12, 99}, false), "contour vertex 99 is out of range"));
    EXPECT_TRUE(says(refusal({11, 12, 22, 12}, false), "passes vertex 12 twice"));
    EXPECT_TRUE(says(refusal({{{11, 21, 0.25}, {11, 22, 0.5}, {21, 11, 0.75}}, false}), "twice"));
    EXPECT_TRUE(says(refusal({11, 22, 21}, true), "vertices 11 and 22 are not joined by an edge"));
    EXPECT_TRUE(says(refusal({1, 2, 12}, false), "edge (1, 2) lies on the border"));
    EXPECT_TRUE(says(refusal({{{11, 21, 1.5}, {11, 22, 0.5}}, false}), "has parameter 1.5"));
    EXPECT_TRUE(says(refusal({{{11, 21, std::numeric_limits<double>::quiet_NaN()}, {11, 22, 0.5}}, false}), "has parameter"));
    EXPECT_TRUE(says(refusal({{{11, 31, 0.5}, {11, 22, 0.5}}, false}), "11 and 31 are not joined"));
    EXPECT_TRUE(says(refusal({{{11, 21, 0.5}, {12, 22, 0.5}}, false}), "leaves the surface"));
    const Contour eight{
        {{11, 21, 0.5}, {11, 22, 0.5}, {21, 22, 0.5}, {21, 32, 0.5}, {21, 31, 0.5}, vertex_point(21), {11, 22, 0.2}}, false};
    EXPECT_TRUE(says(refusal(eight), "crosses itself"));
}

}  // namespace
}  // namespace mrc
