// SPDX-License-Identifier: BSD-3-Clause
// Variables with equal rows (the displacements of a node), which an order of elimination keeps together. Their groups
// have a matrix with a quarter of the entries in the plane, a ninth in space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "linalg/sparse/sparse.hpp"

namespace delam {

// Groups of equal rows, in the order of their first members.
struct EqualRows {
    std::vector<std::int64_t> of;      // group of each variable
    std::vector<std::int64_t> member;  // variables, group by group
    std::vector<std::int64_t> start{0};

    std::size_t count() const { return start.size() - 1; }
};

// Variables 0 .. variables-1, the others count as absent; those before `leading` are never in a group with the rest.
// Rows are compared by a checksum of their columns: if two different rows had the same checksum, the order would be
// poorer, but not wrong.
EqualRows equal_rows(const SparseMatrix& m, std::int64_t variables, std::int64_t leading);

// Returns which groups the rows connect: the pattern of a matrix [groups][groups], both triangles, columns not sorted.
SparseMatrix pattern_of_groups(const SparseMatrix& m, const EqualRows& groups);

}  // namespace delam
