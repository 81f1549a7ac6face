// SPDX-License-Identifier: BSD-3-Clause
// The order in which a sparse factor eliminates its variables.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/sparse/equal_rows.hpp"
#include "linalg/sparse/sparse.hpp"

namespace delam {

// Returns an order of all variables of a symmetric matrix (both triangles stored). The last `trailing` of them keep
// their place. The others are ordered by constrained minimum degree, or by nested dissection where this is estimated to
// need fewer operations. The variables of a matrix that is nearly full have the shortest rows first. poll: called
// between orders.
std::vector<std::int64_t> elimination_order(const SparseMatrix& matrix, std::int64_t trailing, const Poll& poll);

// Returns the sum of the squares of the columns of the factor in this order, in which members of a group follow one
// another. It uses the groups alone, as if the groups below a column had the average number of members; it is exact if
// all groups have as many. Also puts the leading variables into postorder, which changes no fill and makes columns with
// the same rows neighbours. groups: equal_rows() of all variables; pattern: pattern_of_groups().
double estimated_operations(const EqualRows& groups, const SparseMatrix& pattern, std::int64_t trailing,
                            std::vector<std::int64_t>& order);

}  // namespace delam
