// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/block.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "linalg/dense/blas.hpp"
#include "linalg/dense/blas_size.hpp"

namespace delam {

void multiply_rows(const DenseMatrix& s, const DenseMatrix& x, std::int64_t first, DenseMatrix& y) {
    const int n = blas_size(s.rows), columns = blas_size(x.columns), lds = std::max(1, n), ldx = blas_size(x.rows),
              ldy = blas_size(y.rows);
    const double alpha = 1.0, beta = 0.0;
    if (n > 0 && columns > 0)
        blas::gemm("N", "N", &n, &columns, &n, &alpha, s.value.data(), &lds, x.value.data() + first, &ldx, &beta,
                   y.value.data() + first, &ldy);
}

void multiply_columns(const SparseMatrix& a, const DenseMatrix& x, DenseMatrix& y) {
    for (std::int64_t c = 0; c < x.columns; ++c) multiply(a, column(x, c), column(y, c));
}

}  // namespace delam
