// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "disk_tensor.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace mrc {
namespace {

/// A plate of unit squares, folded along the line x = 4: a gutter for slopes above 0, a roof below.
class FoldedPlate : public testing::Test {
  protected:
    static constexpr int middle = 4 * 9 + 4, beside = middle + 2;  // on the fold, and two squares off it

    static made::Mesh mesh(double slope) {
        return made::plate(8, 8).mapped([&](const Vec3& p) { return Vec3(p.x(), p.y(), slope * std::abs(p.x() - 4.0)); });
    }
    static int on_fold(const Surface& surface) { return surface.find_halfedge(middle, middle + 9); }
};

TEST_F(FoldedPlate, bends_by_its_angle_over_the_width_of_the_disk_and_along_its_fold) {
    for (const double slope : {-1.5, -0.2, 0.0, 0.3, 2.0}) {
        for (const double radius : {0.4, 1.0, 1.7, 3.1}) {
            const Surface surface = mesh(slope).surface();
            DiskTensors tensors(surface, radius);
            Symmetric expected = Symmetric::Zero();
            expected[1] = -2.0 * std::atan(slope) * 2.0 * radius / (std::numbers::pi * radius * radius);
            EXPECT_LT((tensors.at(middle) - expected).norm(), 1e-9) << slope << " " << radius;
        }
    }
}

TEST_F(FoldedPlate, is_flat_where_the_disk_does_not_reach_the_fold) {
    const Surface surface = mesh(1.0).surface();
    EXPECT_LT(DiskTensors(surface, 1.9).at(beside).norm(), 1e-12);
    EXPECT_GT(DiskTensors(surface, 3.0).at(beside).norm(), 0.01);
}

TEST_F(FoldedPlate, does_not_bend_what_lies_close_by_but_does_not_hang_together_with_it) {
    const made::Mesh flat = made::plate(8, 8).mapped([](const Vec3& p) { return Vec3(p + Vec3(0, 0, 0.01)); });
    const Surface surface = mesh(1.0).beside(flat).surface();
    EXPECT_LT(DiskTensors(surface, 3.0).at(81 + middle).norm(), 1e-12);
    EXPECT_EQ(DiskTensors(surface, 3.0).at(middle), DiskTensors(mesh(1.0).surface(), 3.0).at(middle));
}

TEST_F(FoldedPlate, has_its_angle_negative_in_a_gutter_from_both_sides) {
    for (const double slope : {-1.5, -0.2, 0.0, 0.3, 2.0}) {
        const Surface surface = mesh(slope).surface();
        const int fold = on_fold(surface);
        EXPECT_NEAR(DiskTensors(surface, 1.0).dihedral(fold), -2.0 * std::atan(slope), 1e-12);
        EXPECT_NEAR(DiskTensors(surface, 1.0).dihedral(surface.twin(fold)), -2.0 * std::atan(slope), 1e-12);
        EXPECT_EQ(DiskTensors(surface, 1.0).dihedral(surface.find_halfedge(0, 1)), 0.0);  // at the border
    }
}

TEST_F(FoldedPlate, turns_its_tensor_with_it) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(2, 1, -1).normalized()).toRotationMatrix();
    const Surface one = mesh(0.6).surface(), other = mesh(0.6).mapped([&](const Vec3&p) { return Vec3(turn * p); }).surface();
    DiskTensors tensors(one, 2.3), turned(other, 2.3);
    for (int v = 0; v < one.vertex_count(); v += 5)
        EXPECT_LT((turn * full(tensors.at(v)) * turn.transpose() - full(turned.at(v))).norm(), 1e-9);
}

TEST_F(FoldedPlate, gives_the_same_tensor_in_whatever_order_it_is_asked) {
    const Surface surface = mesh(0.6).surface();
    DiskTensors forwards(surface, 2.3);
    std::vector<Symmetric> expected;
    for (int v = 0; v < surface.vertex_count(); ++v) expected.push_back(forwards.at(v));
    DiskTensors backwards(surface, 2.3);
    for (int v = surface.vertex_count() - 1; v >= 0; --v) EXPECT_EQ(backwards.at(v), expected[v]);
}

}  // namespace
}  // namespace mrc
