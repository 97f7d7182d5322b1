// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_cholesky.h"

#include <vector>

namespace mrc {

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& matrix, const Beat& beat) {
    CholMatrixType storage(matrix.cols(), matrix.cols());
    ConstCholMatrixPtr ordered = nullptr;
    ordering(matrix, ordered, storage);
    if (beat) beat();
    analyzePattern_preordered(*ordered, true);
    if (beat) beat();
    factorize(*ordered, beat);
}

/// Row by row of L: its pattern from the elimination tree, then a sparse triangular solve (T. Davis, LDL).
void SparseCholesky::factorize(const CholMatrixType& ordered, const Beat& beat) {
    const int size = static_cast<int>(ordered.rows());
    const int* first = m_matrix.outerIndexPtr();
    int* rows = m_matrix.innerIndexPtr();
    double* values = m_matrix.valuePtr();
    std::vector<double> y(size, 0.0);
    std::vector<int> pattern(size), visited(size, -1);
    m_diag.resize(size);
    m_info = Eigen::Success;
    std::size_t work = 0;  // multiplications since the last beat
    for (int k = 0; k < size && m_info == Eigen::Success; ++k) {
        int top = size;
        visited[k] = k;
        m_nonZerosPerCol[k] = 0;
        for (CholMatrixType::InnerIterator entry(ordered, k); entry; ++entry) {
            int i = static_cast<int>(entry.index());
            if (i > k) continue;
            y[i] += entry.value();
            int length = 0;
            for (; visited[i] != k; i = m_parent[i]) {
                pattern[length++] = i;
                visited[i] = k;
            }
            while (length > 0) pattern[--top] = pattern[--length];
        }
        double pivot = y[k];
        y[k] = 0.0;
        for (; top < size; ++top) {
            const int i = pattern[top];
            const double solved = y[i], entry = solved / m_diag[i];
            y[i] = 0.0;
            const int end = first[i] + m_nonZerosPerCol[i]++;
            for (int p = first[i]; p < end; ++p) y[rows[p]] -= values[p] * solved;
            pivot -= entry * solved;
            rows[end] = k;
            values[end] = entry;
            work += static_cast<std::size_t>(end - first[i]);
        }
        m_diag[k] = pivot;
        if (pivot == 0.0) m_info = Eigen::NumericalIssue;
        if (beat && work > 1'000'000) {
            work = 0;
            beat();
        }
    }
    m_factorizationIsOk = true;
}

}  // namespace mrc
