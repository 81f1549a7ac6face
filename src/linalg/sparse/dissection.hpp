// SPDX-License-Identifier: BSD-3-Clause
// Nested dissection of the leading variables of a symmetric matrix.
#pragma once

#include <cstdint>
#include <vector>

#include "linalg/sparse/sparse.hpp"

namespace delam {

// Variables 0 .. leading-1 in the order of METIS' nested dissection of the graph between them; the others count as
// absent. Variables with equal rows (the displacements of a node) are one vertex of the graph and stay together. Empty
// where METIS' integers are too small for the graph, or the graph for METIS.
std::vector<std::int64_t> dissection_order(const SparseMatrix& matrix, std::int64_t leading);

}  // namespace delam
