// SPDX-License-Identifier: BSD-3-Clause
// Products with several vectors at once, as the columns of a dense block: what a matrix-vector product would wait for
// memory for, a product of matrices reads once.
#pragma once

#include <cstdint>
#include <span>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "linalg/sparse/sparse.hpp"

namespace delam {

// Y = S X on the rows from `first` on, as many as the square S has; the other rows of X and Y are not touched. S is
// full (BLAS dgemm).
void multiply_rows(const DenseMatrix& s, const DenseMatrix& x, std::int64_t first, DenseMatrix& y);
// Y = A X
void multiply_columns(const SparseMatrix& a, const DenseMatrix& x, DenseMatrix& y);

}  // namespace delam
