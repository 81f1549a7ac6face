// SPDX-License-Identifier: BSD-3-Clause
// One row of the jump in terms of dense unknowns:  j = sum of n_i x_i + O theta.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace delam {

using SparseVector = std::vector<std::pair<std::int64_t, double>>;

struct JumpRow {
    SparseVector unknowns;
    std::vector<double> offset;  // [patterns] O, empty: none
    // The constraints alone determine the jump.
    bool prescribed() const { return unknowns.empty(); }
};

}  // namespace delam
