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
            DiskTensors tensors(surface);
            Symmetric expected = Symmetric::Zero();
            expected[1] = -2.0 * std::atan(slope) * 2.0 * radius / (std::numbers::pi * radius * radius);
            EXPECT_LT((tensors.at(middle, radius, false) - expected).norm(), 1e-9) << slope << " " << radius;
            expected[1] *= (4.0 / 3.0 * radius) / (2.0 * radius) / 0.5;  // the means of 1 - d^2 / r^2 on the fold and on the disk
            EXPECT_LT((tensors.at(middle, radius, true) - expected).norm(), 1e-9) << slope << " " << radius;
        }
    }
}

TEST_F(FoldedPlate, is_flat_where_the_disk_does_not_reach_the_fold) {
    const Surface surface = mesh(1.0).surface();
    EXPECT_LT(DiskTensors(surface).at(beside, 1.9, true).norm(), 1e-12);
    EXPECT_GT(DiskTensors(surface).at(beside, 3.0, true).norm(), 0.01);
}

TEST_F(FoldedPlate, does_not_bend_what_lies_close_by_but_does_not_hang_together_with_it) {
    const made::Mesh flat = made::plate(8, 8).mapped([](const Vec3& p) { return Vec3(p + Vec3(0, 0, 0.01)); });
    const Surface surface = mesh(1.0).beside(flat).surface(), alone = mesh(1.0).surface();
    EXPECT_LT(DiskTensors(surface).at(81 + middle, 3.0, true).norm(), 1e-12);
    EXPECT_EQ(DiskTensors(surface).at(middle, 3.0, true), DiskTensors(alone).at(middle, 3.0, true));
}

TEST_F(FoldedPlate, has_its_angle_negative_in_a_gutter_from_both_sides) {
    for (const double slope : {-1.5, -0.2, 0.0, 0.3, 2.0}) {
        const Surface surface = mesh(slope).surface();
        const int fold = on_fold(surface);
        EXPECT_NEAR(DiskTensors(surface).dihedral(fold), -2.0 * std::atan(slope), 1e-12);
        EXPECT_NEAR(DiskTensors(surface).dihedral(surface.twin(fold)), -2.0 * std::atan(slope), 1e-12);
        EXPECT_EQ(DiskTensors(surface).dihedral(surface.find_halfedge(0, 1)), 0.0);  // at the border
    }
}

TEST_F(FoldedPlate, turns_its_tensor_with_it) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(2, 1, -1).normalized()).toRotationMatrix();
    const Surface one = mesh(0.6).surface(), other = mesh(0.6).mapped([&](const Vec3&p) { return Vec3(turn * p); }).surface();
    DiskTensors tensors(one), turned(other);
    for (const bool soft : {false, true}) {
        for (int v = 0; v < one.vertex_count(); v += 5)
            EXPECT_LT((turn * full(tensors.at(v, 2.3, soft)) * turn.transpose() - full(turned.at(v, 2.3, soft))).norm(), 1e-9);
    }
}

TEST_F(FoldedPlate, has_the_same_tensor_however_its_flat_sides_are_cut_up) {
    // Between the lines x = 3 and x = 5 as it is; beyond them in long strips.
    const auto long_strips = [](const Vec3& p) {
        const double away = std::max(0.0, std::abs(p.x() - 4.0) - 1.0);
        return Vec3(p.x() + (p.x() < 4.0 ? -49.0 : 49.0) * away, p.y(), p.z());
    };
    const Surface fine = mesh(0.0).mapped([](const Vec3& p) { return Vec3(p.x(), p.y(), 0.7 * std::abs(p.x() - 4.0)); }).surface();
    const Surface coarse = mesh(0.0)
                               .mapped(long_strips)
                               .mapped([](const Vec3& p) { return Vec3(p.x(), p.y(), 0.7 * std::abs(p.x() - 4.0)); })
                               .surface();
    for (const bool soft : {false, true}) {
        for (const double radius : {0.5, 1.5, 3.0})
            EXPECT_LT((DiskTensors(fine).at(middle, radius, soft) - DiskTensors(coarse).at(middle, radius, soft)).norm(), 1e-9);
    }
}

TEST_F(FoldedPlate, gives_the_same_tensor_in_whatever_order_it_is_asked) {
    const Surface surface = mesh(0.6).surface();
    DiskTensors forwards(surface);
    std::vector<Symmetric> expected;
    for (int v = 0; v < surface.vertex_count(); ++v) expected.push_back(forwards.at(v, 2.3, true));
    DiskTensors backwards(surface);
    for (int v = surface.vertex_count() - 1; v >= 0; --v) EXPECT_EQ(backwards.at(v, 2.3, true), expected[v]);
}

}  // namespace
}  // namespace mrc
