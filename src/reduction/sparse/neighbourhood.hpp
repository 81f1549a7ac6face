// SPDX-License-Identifier: BSD-3-Clause
// Parts of a sparse matrix about some of its variables.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/sparse/sparse.hpp"

namespace delam {

// [variables] Number of rings of elements to the nearest seed, not through barred variables; margin + 1: beyond.
// barred: [variables]
std::vector<std::int64_t> rings(const SparseMatrix& matrix, std::span<const std::int64_t> seeds,
                                std::span<const std::uint8_t> barred, std::int64_t margin);

// Rows and columns of these variables, ascending.
SparseMatrix submatrix(const SparseMatrix& matrix, std::span<const std::int64_t> variables);

// Adds these entries of the matrix's pattern.
void add_entries(SparseMatrix& matrix, std::span<const Triplet> entries);

}  // namespace delam
