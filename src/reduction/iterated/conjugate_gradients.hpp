// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients for one right-hand side, preconditioned, with all directions kept conjugate, restarted until the
// true residual agrees with that of the recursion.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace delam {

struct Direction {
    std::vector<double> p, ap;
    double pap;
};

struct CgSystem {
    std::function<void(std::span<const double>, std::span<double>)> apply;
    std::function<void(std::span<const double>, std::span<double>)> precondition;  // symmetric, positive
    // Restart: the true residual at x, corrected along directions that are solved for exactly. Returns the size of the
    // state, sqrt(2 energy), in whose units the residual is measured.
    std::function<double(std::span<double> x, std::span<double> residual)> restart;
    // Norm, as that of the residual, of what rounding leaves of a residual at x.
    std::function<double(std::span<const double> x)> rounding;
    std::function<void(std::int64_t)> each_iteration;
    std::vector<Direction> given;  // conjugate to each other; the residual of restart() is orthogonal to them
};

struct CgOutcome {
    std::int64_t iterations = 0;
    double residual = 0.0;   // sqrt(r^T z) over the size of the state, true
    double norm = 0.0;       // sqrt(r^T z)
    bool converged = false;  // to the tolerance, or to what rounding allows
    bool definite = true;    // false: a direction of negative curvature was met; x is where it was met
};

CgOutcome conjugate_gradients(const CgSystem& system, std::span<double> x, double tolerance, std::int64_t limit);

}  // namespace delam
