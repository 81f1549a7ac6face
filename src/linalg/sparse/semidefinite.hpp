// SPDX-License-Identifier: BSD-3-Clause
// Gram matrices G Q G^T of a sparse G whose rows may depend on each other.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "linalg/sparse/cholesky.hpp"
#include "linalg/sparse/sparse.hpp"

namespace delam {

// G diag(weight) G^T with the pattern of G G^T, whatever weights are zero. gt: G^T.
SparseMatrix weighted_gram(const SparseMatrix& g, const SparseMatrix& gt, std::span<const double> weight);

// A largest independent set of rows of G diag(carries)^1/2, ascending; carries: 1 or 0 for each column. A row counts as
// dependent on those before it (in an order of little fill) if the square of the sine of the angle to their span is at
// most `tolerance`.
std::vector<std::int64_t> independent_rows(const SparseMatrix& g, const SparseMatrix& gt,
                                           std::span<const double> carries, double tolerance);

// Cholesky factor of the principal block of a positive semi-definite matrix on an independent set of rows. solve()
// returns the solution of a consistent system that is zero in all other rows: a generalised inverse.
class SemidefiniteFactor {
public:
    SemidefiniteFactor() = default;
    // Analyses the block of a pattern. rows: ascending.
    SemidefiniteFactor(const SparseMatrix& pattern, std::span<const std::int64_t> rows);
    // A matrix of the analysed pattern.
    void factorise(const SparseMatrix& a);
    void solve(std::span<double> x) const;

private:
    SparseMatrix block_;
    std::vector<std::int64_t> source_;  // entries of the whole matrix that are in the block
    std::vector<double> scale_;         // to a unit diagonal
    std::vector<std::int64_t> rows_;
    std::unique_ptr<SparseCholesky> factor_;
};

}  // namespace delam
