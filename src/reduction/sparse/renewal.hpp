// SPDX-License-Identifier: BSD-3-Clause
// A preconditioner at springs of an earlier moment: when a new one pays, and what its solves leave in doubt. The
// library's own iteration (iterated/reanalysis.hpp) and an engine of the host (engine/engine_solver.hpp) share it.
#pragma once

#include <algorithm>
#include <cmath>

#include "scene/limits.hpp"

namespace delam {

class Renewal {
public:
    // most_first: iterations of a first solve that count at most.
    Renewal(const Limits& limits, double most_first) : limits_(limits), most_first_(most_first) {}

    const Limits& limits() const { return limits_; }
    // The preconditioner is new.
    void renewed() { excess_ = first_ = 0.0; }
    // A solve took so many iterations, each of this cost.
    void solved(double iterations, double cost) {
        if (first_ == 0.0) first_ = std::clamp(iterations, limits_.renewal_fewest_first, most_first_);
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
    double doubt(double least) const {
        return limits_.renewal_in_doubt / std::sqrt(std::max(least, limits_.renewal_softest));
    }

    void restore(double excess, double first) {
        excess_ = excess + 0.0;  // a negative zero would be saved with its sign
        first_ = first + 0.0;
    }
    // True if numbers of a saved state can be those of restore().
    bool allows(double excess, double first) const {
        return excess >= 0.0 && std::isfinite(excess) &&
               (first == 0.0 || (first >= limits_.renewal_fewest_first && first <= most_first_));
    }

private:
    const Limits& limits_;
    double most_first_;
    double excess_ = 0.0;  // in the unit of the price
    double first_ = 0.0;   // iterations of the first solve; 0: there was none
};

}  // namespace delam
