// SPDX-License-Identifier: BSD-3-Clause
// Projected conjugate gradients for several right-hand sides at once: each column has its own step lengths, but all
// take their steps together, so that the boundary blocks are read once for all of them. A block of columns gives the
// same bits whenever it is solved.
#pragma once

#include <cstdint>
#include <functional>

#include "reduction/feti/dual/dual_operator.hpp"
#include "scene/limits.hpp"

namespace delam {

// Solves (F + C) lambda = right + G^T alpha, G lambda = resultant, at the springs that `op` has.
// resultant: [coarse][columns]; lambda: [rows][columns], the first guess on entry. Each column ends at
// sqrt(r^T z) <= tolerance * sqrt(lambda^T (F + C) lambda) of its true residual. Returns false where some column ends,
// by rounding or after too many iterations, above limits.feti_slack times that, or nothing can balance its resultant.
bool lockstep_cg(const DualOperator& op, Team& team, const DenseMatrix& right, const DenseMatrix& resultant,
                 double tolerance, const Limits& limits, DenseMatrix& lambda,
                 const std::function<void(std::int64_t)>& each_iteration);

}  // namespace delam
