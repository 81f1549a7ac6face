// SPDX-License-Identifier: BSD-3-Clause
// One row of the jump in terms of dense unknowns:  j = sum of n_i x_i + O theta.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/numbers.hpp"

namespace delam {

using SparseVector = std::vector<std::pair<std::int64_t, double>>;

struct JumpRow {
    SparseVector unknowns;
    std::vector<double> offset;  // [patterns] O, empty: none
    // The constraints alone determine the jump.
    bool prescribed() const { return unknowns.empty(); }
};

// Jump of a held row, of its offset and the jumps of its unknowns: zero, exactly, but where constraints and other held
// rows leave it no choice. Sums below `rounded` of their terms are rounding. (Measured by verify/bench/constants.py on
// 250 random scenes: from a hundredth to a hundred times all decide alike.)
inline double held_jump(const JumpRow& row, double offset, std::span<const double> x) {
    constexpr double rounded = 1e-9;
    double sum = offset, size = std::abs(offset);
    for (const auto& [i, n] : row.unknowns) {
        const double term = n * x[index(i)];
        sum += term;
        size += std::abs(term);
    }
    return std::abs(sum) > rounded * size ? sum : 0.0;
}

}  // namespace delam
