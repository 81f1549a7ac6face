// SPDX-License-Identifier: BSD-3-Clause
// Constraints E z = 0 on many variables beside a factor M, which they would fill: met exactly by a few stored columns.
//
//   z = M^-1 r - W G^-1 E M^-1 r,    W = M^-1 E^T,  G = E W
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/operator/jump_row.hpp"

namespace delam {

class ConstraintColumns {
public:
    // rows: E, independent. solve: M^-1. False: the rows depend on each other in the eyes of M.
    bool set(std::vector<SparseVector> rows, std::int64_t variables,
             const std::function<void(std::span<const double>, std::span<double>)>& solve, const Poll& poll);
    // z: M^-1 r, then that of the formula.
    void apply(std::span<double> z) const;

private:
    std::vector<SparseVector> rows_;
    DenseMatrix columns_;  // W
    DenseMatrix gram_;     // factor of G
};

}  // namespace delam
