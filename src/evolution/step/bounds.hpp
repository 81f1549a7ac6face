// SPDX-License-Identifier: BSD-3-Clause
// The two-sided energy estimate of a step (Zeman, Kruzik, Gruber, PANM 15 (2010), equation (3)), with a lift that does
// not depend on the mesh.
//
// Taking q = (jump, zeta) and letting u be the energy-minimal extension, E is quadratic in the load parameters theta at
// fixed q:
//   E(theta, q) = 1/2 theta^T A theta + theta^T H j + ...,   A: stiffness of the load patterns with every jump held at
//   zero,
// and its derivative is the conjugate force r = dE/dtheta, which every displacement solve returns. So with d = theta_k
// - theta_{k-1}
//   lower = E(theta_k, q_k) - E(theta_{k-1}, q_k)         = d.r_k     - 1/2 d^T A d
//   upper = E(theta_k, q_{k-1}) - E(theta_{k-1}, q_{k-1}) = d.r_{k-1} + 1/2 d^T A d
// exactly, for any load path. Jumps that constraints prescribe, or bind to others, are not held; their springs
// s_i add s_i J_i J_i^T to A.
#pragma once

#include <span>
#include <vector>

#include "evolution/increment/state.hpp"
#include "linalg/dense.hpp"
#include "reduction/bound_rows.hpp"

namespace delam {

class Lift {
public:
    Lift() = default;
    // One bonded solve for each pattern. bonded: [rows] never come apart; bound: equations among jumps. Throws
    // Error(DELAM_ERROR_PROBLEM) where constraints open bonded rows or a dead force acts on what nothing holds.
    Lift(JumpOperator& op, std::span<const std::uint8_t> bonded, std::span<const BoundRow> bound, std::size_t patterns);
    // 1/2 d^T A d with the springs of `stiffness` [rows] on prescribed jumps.
    double half_quadratic(std::span<const double> d, std::span<const double> stiffness) const;
    // Rows whose jump a load pattern drives by more than `rounding` per unit factor.
    std::vector<std::size_t> driven_rows(double rounding) const;

private:
    DenseMatrix a_;
    std::vector<std::size_t> prescribed_;
    std::vector<std::vector<double>> jump_;  // [prescribed][patterns]
};

}  // namespace delam
