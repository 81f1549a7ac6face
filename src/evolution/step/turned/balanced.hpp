// SPDX-License-Identifier: BSD-3-Clause
// Tells when linear steps about the last places have led to forces that balance.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "scene/limits.hpp"

namespace delam {

// Tells whether the forces balance: within the tolerance; or where another linear step would hardly move the bodies; or
// within rounding once linear steps come no nearer.
class Balanced {
public:
    explicit Balanced(const Limits& limits) : limits_(limits) {}
    // off: the unbalanced force over the load. move: by how much the last linear step has moved the bodies, the root of
    // the energy of this move over that of the bodies; infinite: unknown.
    bool operator()(double off, double rounding, double move) {
        // The next one moves them by less, as their forces have come nearer to their balance.
        const double factor = off / off_, next = factor * move;
        off_ = off;
        idle_ = off < 0.5 * least_ ? 0 : idle_ + 1;
        least_ = std::min(least_, off);
        return off <= limits_.turned_balance ||
               (factor < limits_.turned_kept && off <= limits_.turned_loose && next <= limits_.turned_move) ||
               (idle_ >= limits_.minimise_most_idle && off <= rounding);
    }

private:
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    const Limits& limits_;
    double off_ = unknown;
    double least_ = std::numeric_limits<double>::infinity();
    std::int64_t idle_ = 0;
};

}  // namespace delam
