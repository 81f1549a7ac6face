// SPDX-License-Identifier: BSD-3-Clause
// The rounds that both methods of conjugate gradients of FETI share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "scene/limits.hpp"

namespace delam {

// The rounds of a solve. Each begins with the size of a true residual, because a recursion's own one drifts from it.
class Rounds {
public:
    explicit Rounds(const Limits& limits) : limits_(limits) {}
    // Returns true if no round before began with as small a residual.
    bool begin(double norm) {
        ++round_;
        gained_ = norm <= limits_.restart_gained * best_;
        const bool best = norm < best_;
        if (best) best_ = norm;
        return best;
    }
    std::int64_t begun() const { return round_ + 1; }
    double best() const { return best_; }
    // True if another round would gain nothing, or there were enough.
    bool over() const { return !gained_ || round_ == limits_.feti_rounds; }

private:
    const Limits& limits_;
    std::int64_t round_ = -1;
    double best_ = std::numeric_limits<double>::infinity();
    bool gained_ = true;
};

}  // namespace delam
