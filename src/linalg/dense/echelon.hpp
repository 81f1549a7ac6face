// SPDX-License-Identifier: BSD-3-Clause
// Linear equations in reduced row echelon form, for the few constraints of a dense system.
#pragma once

#include <cstdint>
#include <vector>

#include "linalg/dense/dense.hpp"

namespace delam {

// operations * Q: row i has a one in column pivot[i] and zeros in the other pivot columns. Dependent rows of Q are
// dropped.
struct Echelon {
    std::vector<std::int64_t> pivot;
    DenseMatrix rows;        // [pivots][columns]
    DenseMatrix operations;  // [pivots][rows of Q]
};
// Complete pivoting, first among the columns below `preferred`, then among the others; entries smaller than `tolerance`
// times the largest of their row of Q count as zero.
Echelon reduced_echelon(DenseMatrix q, std::int64_t preferred, double tolerance);

}  // namespace delam
