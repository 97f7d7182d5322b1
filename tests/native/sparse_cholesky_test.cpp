// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_cholesky.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// The Laplacian of a grid with random weights, grounded at one corner.
Matrix grid(int side) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> weight(0.5, 2.0);
    std::vector<Eigen::Triplet<double>> entries;
    const auto join = [&](int a, int b) {
        const double w = weight(random);
        entries.insert(entries.end(), {{a, a, w}, {b, b, w}, {a, b, -w}, {b, a, -w}});
    };
    for (int i = 0; i < side * side; ++i) {
        if (i % side + 1 < side) join(i, i + 1);
        if (i + side < side * side) join(i, i + side);
    }
    entries.emplace_back(0, 0, 1.0);
    Matrix matrix(side * side, side * side);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

TEST(SparseCholesky, SolvesAsEigenDoesToTheLastBit) {
    for (const int side : {1, 2, 9, 60}) {
        const Matrix matrix = grid(side);
        const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(side * side, -1.0, 2.0);
        const mrc::SparseCholesky own(matrix, {});
        const Eigen::SimplicialLDLT<Matrix> theirs(matrix);
        EXPECT_EQ(own.info(), Eigen::Success);
        EXPECT_TRUE((own.solve(right).array() == theirs.solve(right).array()).all());
    }
}

TEST(SparseCholesky, SaysWhereAPivotIsZero) {
    Matrix zero(2, 2);
    EXPECT_EQ(mrc::SparseCholesky(zero, {}).info(), Eigen::NumericalIssue);
}

TEST(SparseCholesky, EndsWhereTheBeatThrows) {
    struct Stop {};
    int beats = 0;
    const Matrix matrix = grid(200);
    mrc::SparseCholesky(matrix, [&] { ++beats; });
    EXPECT_GT(beats, 3);
    EXPECT_THROW(mrc::SparseCholesky(matrix,
                                     [&] {
                                         if (--beats == 1) throw Stop();
                                     }),
                 Stop);
}

}  // namespace
