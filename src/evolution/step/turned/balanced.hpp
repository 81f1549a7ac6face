// SPDX-License-Identifier: BSD-3-Clause
// Tells when linear steps about the last places have led to forces that balance.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace delam {

// Tells whether the forces balance: within the tolerance, or within rounding once linearisations come no nearer.
class Balanced {
public:
    Balanced(double tolerance, std::int64_t most_idle) : tolerance_(tolerance), most_idle_(most_idle) {}
    bool operator()(double off, double rounding) {
        idle_ = off < 0.5 * least_ ? 0 : idle_ + 1;
        least_ = std::min(least_, off);
        return off <= tolerance_ || (idle_ >= most_idle_ && off <= rounding);
    }

private:
    double tolerance_;
    std::int64_t most_idle_;
    double least_ = std::numeric_limits<double>::infinity();
    std::int64_t idle_ = 0;
};

}  // namespace delam
