// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients for one right-hand side, preconditioned, with all directions kept conjugate, restarted until the
// true residual agrees with that of the recursion.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/limits.hpp"

namespace delam {

struct Direction {
    std::vector<double> p, ap;
    double pap;
};

struct CgSystem {
    std::function<void(std::span<const double>, std::span<double>)> apply;
    std::function<void(std::span<const double>, std::span<double>)> precondition;  // symmetric, positive
    // Restart: the true residual at x, corrected along directions that are solved for exactly.
    std::function<void(std::span<double> x, std::span<double> residual)> restart;
    // Returns the size of the state, sqrt(2 energy), in whose units the residual is measured.
    std::function<double(std::span<const double> x)> size;
    // Norm, as that of the residual, of what rounding leaves of a residual at x.
    std::function<double(std::span<const double> x)> rounding;
    double rounded = 0.0;  // the same as a part of the size of the state, from an earlier solution; 0: unknown
    // True if this residual of a recursion is the true one at x but for rounding of its terms. Spares the
    // preconditioner once.
    std::function<bool(std::span<const double> x, std::span<const double> residual)> confirm;
    std::function<void(std::int64_t)> each_iteration;
    // Returns a norm that may stay, given the norm of the first residual, where it is more than what the tolerance
    // allows.
    std::function<double(double first)> enough;  // or none
    Limits limits{};
    bool attempt = false;          // the limit is how many iterations are worth while: ends as soon as they will not do
    std::vector<Direction> given;  // conjugate to each other; the residual of restart() is orthogonal to them
};

struct CgOutcome {
    std::int64_t iterations = 0;
    double residual = 0.0;           // sqrt(r^T z) over the size of the state, of the true residual
    double norm = 0.0;               // sqrt(r^T z)
    double first = 0.0;              // the same at the start
    double rounded = 0.0;            // rounding of a residual, as a part of the size of the state; 0: it was not needed
    std::vector<double> correction;  // M r there, no less than rounding leaves: about what is missing
    double least = 1.0;              // least eigenvalue of M A that the iteration has met, at most 1
    bool converged = false;          // to the tolerance, or to what rounding allows
    bool definite = true;            // false: a direction of negative curvature was met; x is where it was met
};

CgOutcome conjugate_gradients(const CgSystem& system, std::span<double> x, double tolerance, std::int64_t limit);

}  // namespace delam
