// SPDX-License-Identifier: BSD-3-Clause
// Solves systems of a few unknowns, where a call of LAPACK would take longer than the work.
#pragma once

#include <cmath>
#include <cstddef>

namespace delam {

// Solves A x = b by Cholesky's method, A [n][stride] symmetric positive definite, of which the lower triangle is read.
// Overwrites that triangle by the factor and b by x.
inline void small_solve(std::size_t n, std::size_t stride, double* a, double* b) {
    for (std::size_t r = 0; r < n; ++r)
        for (std::size_t c = 0; c <= r; ++c) {
            double sum = a[r * stride + c];
            for (std::size_t k = 0; k < c; ++k) sum -= a[r * stride + k] * a[c * stride + k];
            a[r * stride + c] = r == c ? std::sqrt(sum) : sum / a[c * stride + c];
        }
    for (std::size_t r = 0; r < n; ++r) {
        for (std::size_t k = 0; k < r; ++k) b[r] -= a[r * stride + k] * b[k];
        b[r] /= a[r * stride + r];
    }
    for (std::size_t r = n; r-- > 0;) {
        for (std::size_t k = r + 1; k < n; ++k) b[r] -= a[k * stride + r] * b[k];
        b[r] /= a[r * stride + r];
    }
}

}  // namespace delam
