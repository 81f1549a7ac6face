// SPDX-License-Identifier: BSD-3-Clause
// The work that a step records, checked from the reactions and energies at its ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stability.hpp"

namespace harness {

// Returns by how much the work of a step is wrong. It is that of the trapezoidal rule; or, where contact alone changes,
// that of states on the way: the energy is convex there, so that it lies between the bounds of both ends, and it is the
// change of the energy but for 0.5 %. start, end: energies at the ends, computed from fields, F L.
inline double missed_work(const Result& before, const Result& now, double start, double end) {
    double trapezoid = 0.0, lower = 0.0, upper = 0.0;
    for (std::size_t p = 0; p < now.factor.size(); ++p) {
        const double d = now.factor[p] - before.factor[p];
        trapezoid += 0.5 * d * (now.pattern[p] + before.pattern[p]);
        lower += d * before.pattern[p];
        upper += d * now.pattern[p];
    }
    const double recorded = now.work - before.work, grown = end - start;
    const double size = std::max({std::abs(end), std::abs(grown), std::abs(before.work)});
    const bool integrated = now.dissipated == before.dissipated && recorded >= lower && recorded <= upper &&
                            std::abs(recorded - grown) <= 5e-3 * size && std::abs(trapezoid - grown) > 2e-3 * size;
    return integrated ? 0.0 : recorded - trapezoid;
}

}  // namespace harness
