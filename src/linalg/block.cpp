// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/block.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*,
            const double*, const int*, const double*, double*, const int*);
}

namespace delam {

namespace {

int narrow(std::int64_t n) {
    if (n > std::numeric_limits<int>::max()) fail(DELAM_ERROR_MEMORY, "a block of ", n, " rows is too large");
    return static_cast<int>(n);
}

}  // namespace

void multiply_rows(const DenseMatrix& s, const DenseMatrix& x, std::int64_t first, DenseMatrix& y) {
    const int n = narrow(s.rows), columns = narrow(x.columns), lds = std::max(1, n), ldx = narrow(x.rows),
              ldy = narrow(y.rows);
    const double alpha = 1.0, beta = 0.0;
    if (n > 0 && columns > 0)
        dgemm_("N", "N", &n, &columns, &n, &alpha, s.value.data(), &lds, x.value.data() + first, &ldx, &beta,
               y.value.data() + first, &ldy);
}

void multiply_columns(const SparseMatrix& a, const DenseMatrix& x, DenseMatrix& y) {
    for (std::int64_t c = 0; c < x.columns; ++c) multiply(a, column(x, c), column(y, c));
}

}  // namespace delam
