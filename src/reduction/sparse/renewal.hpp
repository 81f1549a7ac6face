// SPDX-License-Identifier: BSD-3-Clause
// A preconditioner at springs of an earlier moment: when a new one pays, and what its solves leave in doubt. The
// library's own iteration (iterated/reanalysis.hpp) and an engine of the host (engine/engine_solver.hpp) share it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace delam {

struct RenewalLimits {
    // Iterations of the first solve with a new preconditioner: those of later solves count as excess beyond them.
    double fewest_first = 4.0;  // so many are blamed on no preconditioner
    double most_first = std::numeric_limits<double>::infinity();
    // Of the tolerance, where the preconditioner takes springs for stiffer than they are and a residual weighs little.
    double cautious = 1e-3;
    // Multiple of the estimated error below which a jump or force is in doubt, and the least eigenvalue of M A that the
    // estimate takes for true.
    double in_doubt = 10.0, softest = 0.01;
};

class Renewal {
public:
    explicit Renewal(const RenewalLimits& limits = {}) : limits_(limits) {}

    const RenewalLimits& limits() const { return limits_; }
    // The preconditioner is new.
    void renewed() { excess_ = first_ = 0.0; }
    // A solve took so many iterations, each of this cost.
    void solved(double iterations, double cost) {
        if (first_ == 0.0) first_ = std::clamp(iterations, limits_.fewest_first, limits_.most_first);
        excess_ += cost * std::max(0.0, iterations - first_);
    }
    // Work that a new preconditioner would have spared.
    void spent(double work) { excess_ += work; }
    // True if solves since the last renewal have cost more, beyond those with a new preconditioner, than the new one.
    bool due(double price) const { return excess_ > price; }
    // True if there was a solve with the present one.
    bool used() const { return first_ > 0.0; }
    double excess() const { return excess_; }
    double first() const { return first_; }
    // Returns the factor from a correction M r to what may be missing: A^-1 r, for the least eigenvalue that was met.
    double doubt(double least) const { return limits_.in_doubt / std::sqrt(std::max(least, limits_.softest)); }

    void restore(double excess, double first) {
        excess_ = excess + 0.0;  // a negative zero would be saved with its sign
        first_ = first + 0.0;
    }
    // True if numbers of a saved state can be those of restore().
    bool allows(double excess, double first) const {
        return excess >= 0.0 && std::isfinite(excess) &&
               (first == 0.0 || (first >= limits_.fewest_first && first <= limits_.most_first));
    }

private:
    RenewalLimits limits_;
    double excess_ = 0.0;  // in the unit of the price
    double first_ = 0.0;   // iterations of the first solve; 0: there was none
};

}  // namespace delam
