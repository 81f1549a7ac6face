// SPDX-License-Identifier: BSD-3-Clause
// Linear equations in reduced row echelon form, for the few constraints of a dense system.
#pragma once

#include <cstdint>
#include <vector>

#include "linalg/dense.hpp"

namespace delam {

// operations * Q: row i has a one in column pivot[i], and zeros in the other pivot columns. Rows of Q that depend on
// others are gone.
struct Echelon {
    std::vector<std::int64_t> pivot;
    DenseMatrix rows;        // [pivots][columns]
    DenseMatrix operations;  // [pivots][rows of Q]
};
// Complete pivoting, first among the columns below `preferred`, then among the others; what is smaller than `tolerance`
// times the largest entry of its row of Q counts as zero.
Echelon reduced_echelon(DenseMatrix q, std::int64_t preferred, double tolerance);

}  // namespace delam
