// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "petsc/base/communicator.hpp"
#include "petsc/part/part.hpp"

namespace delam::petsc {

// A part from a rank's rows of the assembled stiffness K. With R_p the rows of rank p and zeros in those of the others,
//
//   K = sum_p R_p = sum_p 1/2 (R_p + R_p^T),
//
// because K is symmetric, which is checked. Each term is symmetric, as the stiffness of a part has to be, but has
// negative eigenvalues. Its nodes are those of the rows, then the ghosts that the columns reach. Collective.
Part make_rows(const Communicator& comm, std::int32_t dimension, std::int64_t node_count, const std::int64_t* nodes,
               const double* coordinates, const std::int64_t* row_starts, const std::int64_t* columns,
               const double* values);

}  // namespace delam::petsc
