// SPDX-License-Identifier: BSD-3-Clause
// Jump rows that supports bind to other rows. For example, if the mean over the nodes of one face is prescribed and the
// other face is fixed, a combination of jumps is prescribed: j_row = sum of n_k j_k + o(theta).
#pragma once

#include <cstdint>
#include <vector>

#include "reduction/operator/jump_variables.hpp"

namespace delam {

struct BoundRow {
    std::int64_t row;
    std::vector<std::int64_t> others;  // jump rows k
    std::vector<double> offset;        // [patterns] o
};

// One row for each independent equation among the jumps alone; excludes rows that constraints prescribe completely.
std::vector<BoundRow> bound_rows(const JumpVariables& variables);

}  // namespace delam
