// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "beat.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace mrc {

/// Eigen's SimplicialLDLT, number for number, but that the beat is called between the columns: on large bands the factorization
/// is the longest of all stages. The ordering of the columns before it is one call of Eigen's without a beat.
class SparseCholesky : public Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> {
  public:
    SparseCholesky(const Eigen::SparseMatrix<double>& matrix, const Beat& beat);

  private:
    void factorize(const CholMatrixType& ordered, const Beat& beat);
};

}  // namespace mrc
