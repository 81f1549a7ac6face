// SPDX-License-Identifier: BSD-3-Clause
// Preconditioned conjugate gradients within the affine space of balanced forces { lambda : G lambda = e }, with full
// reorthogonalisation of the directions, which the few iterations of a FETI solve can afford.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/limits.hpp"

namespace delam {

// The largest part of a load's resultant that may be left unbalanced before a floating part counts as not held.
// (Measured by verify/bench/constants.py on 250 random scenes: half and twice decide alike.)
inline constexpr double unbalanced_part = 1e-8;

struct ProjectedSystem {
    std::function<void(std::span<const double>, std::span<double>)> apply;         // y = A x
    std::function<void(std::span<const double>, std::span<double>)> precondition;  // z = M r
    std::function<void(std::span<double>)> balance;             // lambda <- nearest with G lambda = e
    std::function<void(std::span<double>)> project;             // lambda <- P lambda
    std::function<void(std::span<double>)> project_transposed;  // r <- P^T r
};

struct CgGoal {
    double tolerance;
    double floor;        // of sqrt(r^T z): what rounding leaves
    std::int64_t limit;  // iterations
    const Limits& limits;
};

struct CgResult {
    std::int64_t iterations = 0;
    double residual = 0.0;  // sqrt(r^T P M P^T r) over the energy norm of the solution
    bool converged = false;
};

// lambda: start in, balanced solution out. Stops at sqrt(r^T z) <= tolerance * sqrt(lambda^T A lambda) for the true
// residual: the recursion is restarted until a newly computed residual agrees. Where rounding (sqrt(r^T z) <= floor)
// ends the descent first, that is the solution: a structure in pieces moves without any force, and no relative measure
// of forces applies. A descent that rounding ends within limits.feti_slack times either bound counts as converged too;
// the residual says so.
CgResult projected_cg(const ProjectedSystem& system, std::span<const double> b, std::span<double> lambda,
                      const CgGoal& goal, const std::function<void(std::int64_t)>& each_iteration);

}  // namespace delam
