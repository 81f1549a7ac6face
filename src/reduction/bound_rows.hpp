// SPDX-License-Identifier: BSD-3-Clause
// Jump rows that supports bind to other rows: prescribing a mean over the nodes of one face while the other face is
// held, say, fixes a combination of jumps, j_row = sum of n_k j_k + o(theta).
#pragma once

#include <cstdint>
#include <vector>

#include "scene/problem.hpp"

namespace delam {

struct BoundRow {
    std::int64_t row;
    std::vector<std::int64_t> others;  // jump rows k
    std::vector<double> offset;        // [patterns] o
};

// One row of each independent equation among the jumps alone; rows that the device prescribes outright are not among
// them.
std::vector<BoundRow> bound_rows(const Problem& problem);

}  // namespace delam
